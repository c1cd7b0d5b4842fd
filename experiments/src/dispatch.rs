//! From a dimension known at run time to a type parameter, once.

use parvi_targets::TargetError;

use crate::CommandError;

/// Work in a dimension known at run time: `in_dimension!(name, d, D => …)` is the work, which gives a result, with `D` as a constant; an error calls the target by the name.
macro_rules! in_dimension {
    ($name:expr, $dimension:expr, $D:ident => $work:expr) => {
        $crate::dispatch::in_dimension!($name, $dimension, $D => $work; 2 5, 1 3 4 6 7 8)
    };
    ($name:expr, $dimension:expr, $D:ident => $work:expr; $($always:literal)+, $($seldom:literal)+) => {
        match $dimension {
            $($always => {
                const $D: usize = $always;
                $work
            })+
            $(#[cfg(feature = "every-dimension")]
            $seldom => {
                const $D: usize = $seldom;
                $work
            })+
            dimension => Err($crate::dispatch::refused($name, dimension)),
        }
    };
}
pub(crate) use in_dimension;

/// Work on a target in its own dimension: `on_target!(specification, target, D => …)`, in a function that gives a result.
macro_rules! on_target {
    ($specification:expr, $target:ident, $D:ident => $work:expr) => {{
        let specification: &parvi_options::TargetSpecification = $specification;
        $crate::dispatch::in_dimension!(&specification.name, specification.dimension()?, $D => {
            let $target = specification.build::<$D>()?;
            $work
        })
    }};
}
pub(crate) use on_target;

/// The error for a dimension that this build does not have.
pub fn refused(target: &str, dimension: usize) -> CommandError {
    match dimension {
        1..=8 => CommandError::LeftOut {
            asked: "targets of other than 2 and 5 dimensions",
            feature: "every-dimension",
        },
        _ => CommandError::Target(TargetError::DimensionNotAllowed {
            target: target.to_owned(),
            dimension,
            allowed: "1 to 8 dimensions".to_owned(),
        }),
    }
}
