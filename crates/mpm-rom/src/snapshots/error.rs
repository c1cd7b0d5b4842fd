use std::fmt::{self, Display, Formatter};

/// What is wrong with snapshots.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotsError {
    /// There is nothing to learn from.
    #[error("snapshots without {what}")]
    Empty {
        /// What is missing: points, runs or frames.
        what: &'static str,
    },
    /// A number is outside its range.
    #[error("{place}{field} = {value}: must be {expected}")]
    Value {
        /// Where it stands.
        place: Place,
        /// What it is a number of: a field or a parameter.
        field: String,
        /// The number.
        value: f64,
        /// What is allowed.
        expected: &'static str,
    },
    /// A list has another length than the body asks for.
    #[error("{place}the number of {field} is {found}, not {expected}")]
    Length {
        /// Where it stands.
        place: Place,
        /// The list.
        field: &'static str,
        /// Its length.
        found: usize,
        /// The number of parameters or points of the body.
        expected: usize,
    },
}

/// A place in snapshots, as far as there is one; all counted from 0.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The run.
    pub run: Option<usize>,
    /// The frame.
    pub frame: Option<usize>,
    /// The point; the one behind the last is the centroid.
    pub point: Option<usize>,
}

impl Place {
    /// The error of a number here.
    pub(super) fn refuse(self, field: impl Into<String>, value: f64, expected: &'static str) -> SnapshotsError {
        SnapshotsError::Value {
            place: self,
            field: field.into(),
            value,
            expected,
        }
    }

    /// Whether a list here is as long as it should be.
    pub(super) fn require_length(
        self,
        field: &'static str,
        found: usize,
        expected: usize,
    ) -> Result<(), SnapshotsError> {
        let error = SnapshotsError::Length {
            place: self,
            field,
            found,
            expected,
        };
        (found == expected).then_some(()).ok_or(error)
    }
}

impl Display for Place {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        let numbers = [("run", self.run), ("frame", self.frame), ("point", self.point)];
        let known = numbers.iter().filter_map(|(name, number)| Some((name, (*number)?)));
        let words: Vec<String> = known.map(|(name, number)| format!("{name} {number}")).collect();
        match words.is_empty() {
            true => Ok(()),
            false => write!(formatter, "{}: ", words.join(", ")),
        }
    }
}
