//! What is asked of the defaults on a target.

use parvi_targets::target_info;

use crate::CommandError;
use crate::options::TargetSpecification;

/// A class of targets with the same bound on ED² relative to independent draws.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Requirement {
    /// One mode, light tails, d ≤ 4.
    SmoothLow,
    /// One mode, light tails, d ≥ 5.
    SmoothHigh,
    /// The funnel, Student's t, mixtures, and what may be any of these: random targets and the eggbox.
    Difficult,
}

impl Requirement {
    /// All classes.
    pub const ALL: [Self; 3] = [Self::SmoothLow, Self::SmoothHigh, Self::Difficult];

    /// The class of a target.
    pub fn of(target: &TargetSpecification) -> Result<Self, CommandError> {
        let difficult = matches!(target.name.as_str(), "funnel" | "student-t" | "random" | "eggbox");
        Ok(if difficult || target_info(&target.name)?.modes > 1 {
            Self::Difficult
        } else if target.dimension()? <= 4 {
            Self::SmoothLow
        } else {
            Self::SmoothHigh
        })
    }

    /// The largest ED² relative to independent draws that meets it.
    pub fn bound(self) -> f64 {
        match self {
            Self::SmoothLow => 0.3,
            Self::SmoothHigh => 0.5,
            Self::Difficult => 1.0,
        }
    }

    /// The class in words.
    pub fn in_words(self) -> &'static str {
        match self {
            Self::SmoothLow => "one mode, light tails, d ≤ 4",
            Self::SmoothHigh => "one mode, light tails, d ≥ 5",
            Self::Difficult => "funnel, Student t, mixtures",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::options::Dimension;

    #[test]
    fn every_target_has_its_bound() {
        let bound = |name: &str, dim: Option<i64>| {
            let dim = dim.and_then(Dimension::new);
            Requirement::of(&TargetSpecification::plain(name, dim)).unwrap().bound()
        };
        assert_eq!(bound("gaussian", Some(4)), 0.3);
        assert_eq!(bound("gaussian", Some(5)), 0.5);
        assert_eq!(bound("wells-small", Some(6)), 0.5);
        assert_eq!(bound("ring", None), 0.3);
        assert_eq!(bound("mixture-4", None), 1.0);
        assert_eq!(bound("mixture-3", Some(6)), 1.0);
        assert_eq!(bound("funnel", Some(2)), 1.0);
        assert_eq!(bound("student-t", Some(1)), 1.0);
    }
}
