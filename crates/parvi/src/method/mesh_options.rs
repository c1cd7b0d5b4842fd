use std::path::PathBuf;

use parvi_body::NonFiniteScores;
use parvi_targets::Target;

use super::Settling;
use super::with_defaults::with_defaults;
use crate::{Observer, Run, SampleError, Samples};

/// The calibrated sampler on the mesh of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct OnMesh {
    /// A .msh file of Gmsh.
    pub file: PathBuf,
    /// How it is sampled.
    pub options: MeshOptions,
}

impl OnMesh {
    /// As `MeshOptions::sample`, on the mesh of the file.
    ///
    /// # Errors
    /// [`SampleError`]: without the cargo feature `mesh` always [`SampleError::NotBuilt`]; [`SampleError::MeshFile`] for a file that is no mesh of
    /// this dimension, and in other dimensions than 2 and 3.
    pub fn sample<const D: usize>(
        &self,
        target: &dyn Target<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        #[cfg(feature = "mesh")]
        return crate::on_mesh::sample_on(self, target, run, observer);
        #[cfg(not(feature = "mesh"))]
        {
            let _ = (target, run, observer);
            Err(SampleError::NotBuilt {
                method: "mpm on a mesh",
                feature: "mesh",
            })
        }
    }
}

with_defaults! {
    /// Options of the calibrated sampler on the hat functions of a mesh; `None` means: chosen by the rule beside.
    #[derive(Clone, Debug, PartialEq)]
    pub struct MeshOptions {
        /// Steps in all, settling included; ≥ 1. Default: such that the gas could cross the mesh four times before settling begins, and those of
        /// [`crate::defaults::steps`] at least.
        pub steps: Option<usize> = None,
        /// Time step Δt in units of the frame; > 0. Default: [`crate::defaults::time_step`] for the mean edge; shortened where the target is stiff.
        pub time_step: Option<f64> = None,
        /// Friction γ ≥ 0 (v ← v e^{−γΔt}). Default [`crate::defaults::FRICTION`].
        pub friction: Option<f64> = None,
        /// Move the inner vertices at random from step to step; the boundary stays.
        pub shifts: bool = true,
        /// How the run ends.
        pub settling: Settling = Settling::default(),
        /// What is done about a particle whose score is not finite.
        pub non_finite_scores: NonFiniteScores = NonFiniteScores::default(),
        /// Largest displacement per step in units of the mean edge; > 0.
        pub displacement_limit: f64 = 1.0,
        /// Measure residual and energy every so many steps (0: only at the end).
        pub trace_every: usize = 0,
    }
}
