//! What a judgement says.

use crate::page::Line;

/// One line of the table of judgements.
#[derive(Clone, Debug, PartialEq)]
pub struct Verdict {
    /// What was judged: a series, or one of its points.
    pub of: String,
    /// What was asked.
    pub asked: String,
    /// What was reached.
    pub reached: String,
    /// Whether that is enough. Never where a run of the series ended before its time.
    pub pass: bool,
}

/// The names `of`, `asked` and `reached`, and whether it may `pass`.
impl From<Verdict> for Line<'_> {
    fn from(verdict: Verdict) -> Self {
        let line = Self::default().with("of", verdict.of).with("asked", verdict.asked);
        let line = line.with("reached", verdict.reached);
        line.with("pass", if verdict.pass { "yes" } else { "**no**" })
    }
}

impl Verdict {
    /// That there was nothing to judge.
    pub fn of_nothing(of: String) -> Self {
        Self {
            of,
            asked: "something to judge".to_owned(),
            reached: "none".to_owned(),
            pass: false,
        }
    }
}
