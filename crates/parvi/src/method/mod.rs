//! The methods and their options: a method is a file, or two, and a line of `methods!` below.

mod ais_options;
mod annealing;
mod mesh_options;
mod mpm_options;
mod nuts_options;
mod paper_body;
mod paper_material;
mod paper_options;
mod schedule;
mod stein_thinning_options;
mod support_points_options;
mod svgd_options;
mod watch;
mod with_defaults;

pub use ais_options::{AisOptions, Condensation};
pub use annealing::Annealing;
pub use mesh_options::{MeshOptions, OnMesh};
pub use mpm_options::{MomentCorrection, MpmOptions};
pub use nuts_options::NutsOptions;
pub use paper_body::PaperBody;
pub use paper_material::PaperMaterial;
pub use paper_options::{Coordinates, Guards, PaperOptions, ReferenceVolumes};
pub use schedule::{Settling, SpacingSchedule};
pub use stein_thinning_options::{SampleSource, SteinThinningOptions};
pub use support_points_options::SupportPointsOptions;
pub use svgd_options::SvgdOptions;
pub use watch::{Monitor, Watch};
pub(crate) use with_defaults::with_defaults;

use parvi_targets::{CatalogueTarget, Frame};

use crate::{Observer, Run, SampleError, Samples, SmcOptions, independent_draws, sobol_points};

/// What is known of a method, in one place: its variant of [`Method`], and how it samples a target of the catalogue in the target's frame.
macro_rules! methods {
    (($target:ident, $frame:ident, $run:ident, $observer:ident);
        $($(#[$meta:meta])* $variant:ident $(($options:ident: $type:ty))? => $sample:expr;)*) => {
        /// A method together with its options.
        #[derive(Clone, Debug, PartialEq)]
        pub enum Method {
            $($(#[$meta])* $variant $(($type))?,)*
        }

        impl Method {
            /// Sample with it.
            pub(crate) fn sample<const D: usize>(
                &self,
                $target: &dyn CatalogueTarget<D>,
                $frame: &Frame<D>,
                $run: &Run,
                $observer: &mut dyn Observer,
            ) -> Result<Samples<D>, SampleError> {
                match self {
                    $(Self::$variant $(($options))? => $sample,)*
                }
            }
        }
    };
}

methods! {
    (target, frame, run, observer);
    /// Calibrated isothermal gas (the default).
    Mpm(options: MpmOptions) => options.sample(target, frame, run, observer);
    /// Adaptive importance sampling, condensed.
    Ais(options: AisOptions) => options.sample(target, frame, run, observer);
    /// Tempered sequential Monte Carlo.
    Smc(options: SmcOptions) => options.sample(target, frame, run, observer);
    /// Calibrated isothermal gas within a mesh, in 2 and 3 dimensions.
    OnMesh(on_mesh: OnMesh) => on_mesh.sample(target, run, observer);
    /// Algorithms 1 (PIC) and 2 (APIC) of the MPM-ParVI paper.
    Paper(options: PaperOptions) => options.sample(target, frame, run, observer);
    /// Stein variational gradient descent.
    Svgd(options: SvgdOptions) => options.sample(target, frame, run, observer);
    /// Independent exact draws.
    Iid => independent_draws(target, run);
    /// Scrambled Sobol points through the target's map from the unit cube.
    Sobol => sobol_points(target, run);
    /// The No-U-Turn sampler, a Markov chain; needs the cargo feature `nuts`.
    Nuts(options: NutsOptions) => options.sample(target, frame, run, observer);
    /// The M draws of a bigger sample with the least kernel Stein discrepancy, by a greedy choice.
    SteinThinning(options: SteinThinningOptions) => options.sample(target, frame, run, observer);
    /// The M points with the least energy distance to a bigger sample.
    SupportPoints(options: SupportPointsOptions) => options.sample(target, frame, run, observer);
}
