//! Where samplers are called: those of the dimensions whose features `d1`…`d8` are on are compiled in this crate, once for all crates that call
//! them, so that a program that samples a density of its own is built in a second or two.

use parvi_targets::{CatalogueTarget, Frame, Target};

use crate::task::{Task, sampler};
use crate::{Method, MpmOptions, Observer, PaperBody, PaperOptions, Run, SampleError, Samples, mpm, paper};

/// Sample a catalogue target with any method, in the target's own frame.
///
/// # Errors
/// [`SampleError`].
pub fn sample<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError> {
    sample_in(target, &target.frame(), method, run, observer)
}

/// As [`sample`], in a frame that says what else is known of the target's place and scales; [`Frame::identity`]: nothing.
///
/// # Errors
/// As [`sample`].
pub fn sample_in<const D: usize>(
    target: &dyn CatalogueTarget<D>,
    frame: &Frame<D>,
    method: &Method,
    run: &Run,
    observer: &mut dyn Observer,
) -> Result<Samples<D>, SampleError> {
    (Compiled::of().sample)(target, frame, method, run, observer)
}

sampler! {
    /// Sample `target`; `frame` is what is known of its place and scales, and the unit of the run's start law.
    ///
    /// # Errors
    /// [`SampleError`]: an option out of range, a score that is not finite, or the observer's stop.
    MpmOptions => |options, task| (Compiled::of().mpm)(options, task)
}

sampler! {
    /// Run the paper's algorithm on `target`; `frame` is the unit of everything, unless the options want the target's own coordinates.
    ///
    /// Masses are 1/M, velocities 0 and reference volumes those of the options, unless [`Run::given`] has others.
    ///
    /// # Errors
    /// [`SampleError`]: without the cargo feature `paper` always [`SampleError::NotBuilt`]; an option or a given particle out of range, a score or a deformation that is not finite, or the observer's stop.
    PaperOptions => |options, task| (Compiled::of().paper)(options, &PaperBody::default(), task)
}

impl PaperOptions {
    /// As [`sample`](Self::sample), with a material and a schedule of α of one's own.
    ///
    /// # Errors
    /// As [`sample`](Self::sample).
    pub fn sample_body<const D: usize>(
        &self,
        body: &PaperBody<D>,
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
        observer: &mut dyn Observer,
    ) -> Result<Samples<D>, SampleError> {
        (Compiled::of().paper)(self, body, Task::new(target, frame, run, observer))
    }
}

/// What is compiled for a dimension.
struct Compiled<const D: usize> {
    sample: Sample<D>,
    mpm: SampleByMpm<D>,
    paper: SampleByPaper<D>,
}

impl<const D: usize> Compiled<D> {
    const HERE: Self = Self {
        sample: |target, frame, method, run, observer| method.sample(target, frame, run, observer),
        mpm: mpm::sample,
        paper: paper::sample,
    };
}

mpm_parallel::compiled_ahead!(Compiled);

/// [`sample_in`].
type Sample<const D: usize> =
    fn(&dyn CatalogueTarget<D>, &Frame<D>, &Method, &Run, &mut dyn Observer) -> Result<Samples<D>, SampleError>;

/// [`MpmOptions::sample`].
type SampleByMpm<const D: usize> = fn(&MpmOptions, Task<'_, D>) -> Result<Samples<D>, SampleError>;

/// [`PaperOptions::sample_body`].
type SampleByPaper<const D: usize> = fn(&PaperOptions, &PaperBody<D>, Task<'_, D>) -> Result<Samples<D>, SampleError>;
