//! What a sampler is called with.

use parvi_targets::{Frame, Target};

use crate::{Observer, Run, SampleError};

/// A density, and the run that is to sample it.
pub(crate) struct Task<'a, const D: usize> {
    pub target: &'a dyn Target<D>,
    /// What is known of the target's place and scales, and the unit of the run's start law.
    pub frame: &'a Frame<D>,
    pub run: &'a Run,
    pub observer: &'a mut dyn Observer,
}

impl<'a, const D: usize> Task<'a, D> {
    pub fn new(target: &'a dyn Target<D>, frame: &'a Frame<D>, run: &'a Run, observer: &'a mut dyn Observer) -> Self {
        Self {
            target,
            frame,
            run,
            observer,
        }
    }

    /// Its fields.
    pub fn parts(self) -> (&'a dyn Target<D>, &'a Frame<D>, &'a Run, &'a mut dyn Observer) {
        (self.target, self.frame, self.run, self.observer)
    }

    /// The same of another target.
    pub fn of<'b>(self, target: &'b dyn Target<D>) -> Task<'b, D>
    where
        'a: 'b,
    {
        let (_, frame, run, observer) = self.parts();
        Task::new(target, frame, run, observer)
    }

    /// Refuses a target of which only the score is known, to a `method` that weighs.
    pub fn needs_log_density(&self, method: &'static str) -> Result<(), SampleError> {
        match self.target.has_log_density() {
            true => Ok(()),
            false => Err(SampleError::ScoreOnly { method }),
        }
    }
}

/// The public way to sample with a method's options: `sample`, which hands a [`Task`] to a function.
macro_rules! sampler {
    ($(#[$meta:meta])* $options:ident => $function:expr) => {
        impl $options {
            $(#[$meta])*
            pub fn sample<const D: usize>(
                &self,
                target: &dyn parvi_targets::Target<D>,
                frame: &parvi_targets::Frame<D>,
                run: &$crate::Run,
                observer: &mut dyn $crate::Observer,
            ) -> Result<$crate::Samples<D>, $crate::SampleError> {
                $function(self, $crate::task::Task::new(target, frame, run, observer))
            }
        }
    };
}
pub(crate) use sampler;
