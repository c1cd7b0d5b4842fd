//! A target of which only the score is known.

use crate::Target;

/// A score ∇ log p without log p, as a learned one: any function of the position.
///
/// ```
/// use parvi_targets::{ScoreOnly, Target};
///
/// let normal = ScoreOnly(|x: &[f64; 2]| x.map(|c| -c));
/// assert!(!normal.has_log_density());
/// assert_eq!(normal.score(&[1.0, 2.0]), [-1.0, -2.0]);
/// ```
#[derive(Clone, Copy, Debug)]
pub struct ScoreOnly<S>(pub S);

impl<S, const D: usize> Target<D> for ScoreOnly<S>
where
    S: Fn(&[f64; D]) -> [f64; D] + Sync,
{
    fn log_density(&self, _x: &[f64; D]) -> f64 {
        f64::NAN
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        (self.0)(x)
    }

    fn has_log_density(&self) -> bool {
        false
    }
}
