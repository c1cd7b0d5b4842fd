//! What is asked of the defaults on a target.

use parvi_options::TargetSpecification;
use parvi_targets::target_info;

use crate::CommandError;

/// A class of targets with the same bound on ED² relative to independent draws.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Requirement {
    /// The class in words.
    pub class: &'static str,
    /// The largest ED² relative to independent draws that meets it.
    pub bound: f64,
}

const fn class(class: &'static str, bound: f64) -> Requirement {
    Requirement { class, bound }
}

const SMOOTH_LOW: Requirement = class("one mode, light tails, d ≤ 4", 0.3);
const SMOOTH_HIGH: Requirement = class("one mode, light tails, d ≥ 5", 0.5);
/// And what may be any of these: random targets, the eggbox and programs.
const DIFFICULT: Requirement = class("funnel, Student t, mixtures", 1.0);

impl Requirement {
    /// All classes.
    pub const ALL: [Self; 3] = [SMOOTH_LOW, SMOOTH_HIGH, DIFFICULT];

    /// The class of a target.
    ///
    /// # Errors
    /// A target that there is not.
    pub fn of(target: &TargetSpecification) -> Result<Self, CommandError> {
        let difficult = matches!(
            target.name.as_str(),
            "funnel" | "student-t" | "random" | "eggbox" | "program"
        );
        Ok(if difficult || target_info(&target.name)?.modes > 1 {
            DIFFICULT
        } else if target.dimension()? <= 4 {
            SMOOTH_LOW
        } else {
            SMOOTH_HIGH
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use parvi_options::Dimension;

    #[test]
    fn every_target_has_its_bound() {
        let bound = |name: &str, dim: Option<i64>| {
            let dim = dim.and_then(Dimension::new);
            Requirement::of(&TargetSpecification::plain(name, dim)).unwrap().bound
        };
        assert_eq!(bound("gaussian", Some(4)), 0.3);
        assert_eq!(bound("gaussian", Some(5)), 0.5);
        assert_eq!(bound("wells-small", Some(6)), 0.5);
        assert_eq!(bound("ring", None), 0.3);
        assert_eq!(bound("mixture-4", None), 1.0);
        assert_eq!(bound("mixture-3", Some(6)), 1.0);
        assert_eq!(bound("funnel", Some(2)), 1.0);
        assert_eq!(bound("student-t", Some(1)), 1.0);
        assert_eq!(bound("program", Some(2)), 1.0);
    }
}
