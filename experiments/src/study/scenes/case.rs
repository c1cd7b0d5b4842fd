//! One run of a family.

use super::axis::Combination;
use super::family::Family;
use crate::CommandError;
use crate::study::checks::refusal;
use crate::study::definition;

/// A combination of the choices of a family.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its family, with what that takes over from others.
    pub family: Family,
    /// What it changes beside the family's own changes.
    pub combination: Combination,
}

impl Case {
    /// A case.
    pub fn new(family: &Family, combination: Combination) -> Self {
        Self {
            family: family.clone(),
            combination,
        }
    }

    /// The error for a case that cannot be run.
    pub fn refuse(&self, message: impl Into<String>) -> CommandError {
        refusal(
            &format!("families.{}, case `{}`", self.family.name, self.combination.name),
            message,
        )
    }
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("{}: {}", self.family.name, self.combination.name)
    }
}
