//! From a dimension known at run time to a type parameter, once.

use parvi_targets::{BoxedTarget, TargetError};

use crate::CommandError;
use crate::options::TargetSpecification;

/// A piece of work on a target whose dimension is a type parameter.
pub trait TargetTask {
    /// What the work gives.
    type Output;

    /// Does it.
    fn run<const D: usize>(self, target: BoxedTarget<D>) -> Result<Self::Output, CommandError>;
}

/// Builds the target and hands it to the task in its own dimension.
pub fn with_target<T: TargetTask>(specification: &TargetSpecification, task: T) -> Result<T::Output, CommandError> {
    match specification.dimension()? {
        1 => build::<1, T>(specification, task),
        2 => build::<2, T>(specification, task),
        3 => build::<3, T>(specification, task),
        4 => build::<4, T>(specification, task),
        5 => build::<5, T>(specification, task),
        6 => build::<6, T>(specification, task),
        #[cfg(feature = "seven-and-eight")]
        7 => build::<7, T>(specification, task),
        #[cfg(feature = "seven-and-eight")]
        8 => build::<8, T>(specification, task),
        #[cfg(not(feature = "seven-and-eight"))]
        7 | 8 => Err(CommandError::LeftOut {
            asked: "a target of 7 or 8 dimensions",
            feature: "seven-and-eight",
        }),
        dimension => Err(CommandError::Target(TargetError::DimensionNotAllowed {
            target: specification.name.clone(),
            dimension,
            allowed: "1 to 8 dimensions".to_owned(),
        })),
    }
}

fn build<const D: usize, T: TargetTask>(
    specification: &TargetSpecification,
    task: T,
) -> Result<T::Output, CommandError> {
    let target = parvi_targets::build::<D>(&specification.name, &specification.parameters.to_catalogue())?;
    task.run::<D>(target)
}
