//! Rows beside others that are alike.

use super::{Row, Rows};

/// How many rows are better than, as good as and worse than the others that they are alike with, and of how many pairs both have nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Contest {
    /// The smaller number.
    pub better: usize,
    /// No number is more than the tie's factor times the other.
    pub ties: usize,
    /// The larger number, or none.
    pub worse: usize,
    /// Neither has a number.
    pub neither: usize,
}

impl Contest {
    /// All pairs.
    pub fn pairs(self) -> usize {
        self.better + self.ties + self.worse + self.neither
    }
}

impl Rows<'_> {
    /// Holds the numbers of a column against those of the first of the others that is alike in some columns; a row without a number is worse than any other, and
    /// two numbers are equal if neither is more than so many times the other.
    pub fn against(&self, others: &Rows<'_>, (column, alike): (&str, &[&str]), tie: f64) -> Contest {
        let mut contest = Contest::default();
        for row in self.iter() {
            let is_alike = |other: &Row| alike.iter().all(|column| row.value(column) == other.value(column));
            let Some(other) = others.iter().find(|other| is_alike(other)) else {
                continue;
            };
            let count = match (row.number(column), other.number(column)) {
                (None, None) => &mut contest.neither,
                (None, Some(_)) => &mut contest.worse,
                (Some(_), None) => &mut contest.better,
                (Some(own), Some(theirs)) if own * tie < theirs => &mut contest.better,
                (Some(own), Some(theirs)) if own <= theirs * tie => &mut contest.ties,
                (Some(_), Some(_)) => &mut contest.worse,
            };
            *count += 1;
        }
        contest
    }
}
