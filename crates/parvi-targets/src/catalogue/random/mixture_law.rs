//! Mixtures of any laws.

use mpm_tensor::vector;

use crate::error::{finite, positive};
use crate::{BoxedLaw, Target, TargetError, UnitCubeTransport};

/// p = Σ_k π_k p_k, with log p by log-sum-exp and the score Σ_k r_k s_k of the responsibilities r_k = π_k p_k / p.
#[derive(Debug)]
pub struct MixtureLaw<const D: usize> {
    /// Masses π_k and laws p_k.
    parts: Vec<(f64, BoxedLaw<D>)>,
}

impl<const D: usize> MixtureLaw<D> {
    /// The mixture of laws with masses, which may be any positive weights and are divided by their sum.
    ///
    /// # Errors
    /// [`TargetError::Empty`] without laws; [`TargetError::NotFinite`] or [`TargetError::OutOfRange`] for a mass.
    pub fn new(mut parts: Vec<(f64, BoxedLaw<D>)>) -> Result<Self, TargetError> {
        if parts.is_empty() {
            return Err(TargetError::Empty {
                field: "the list of laws of a mixture".to_owned(),
            });
        }
        for (mass, _) in &parts {
            positive("the mass of a law", *mass)?;
        }
        let total = finite("the sum of the masses", parts.iter().map(|(mass, _)| mass).sum())?;
        parts.iter_mut().for_each(|(mass, _)| *mass /= total);
        Ok(Self { parts })
    }

    /// log π_k + log p_k(x).
    fn log_terms(&self, x: &[f64; D]) -> Vec<f64> {
        let term = |(mass, law): &(f64, BoxedLaw<D>)| mass.ln() + law.log_density(x);
        self.parts.iter().map(term).collect()
    }
}

/// The largest term; below every number if there is none.
fn largest(terms: &[f64]) -> f64 {
    terms.iter().copied().fold(f64::NEG_INFINITY, f64::max)
}

impl<const D: usize> Target<D> for MixtureLaw<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let terms = self.log_terms(x);
        let top = largest(&terms);
        if top == f64::NEG_INFINITY {
            return top;
        }
        top + terms.iter().map(|term| (term - top).exp()).sum::<f64>().ln()
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let terms = self.log_terms(x);
        let top = largest(&terms);
        let (mut score, mut total) = ([0.0; D], 0.0);
        for (term, (_, law)) in terms.iter().zip(&self.parts) {
            let responsibility = (term - top).exp();
            // What is far away says nothing, and its score may be huge.
            if responsibility > 0.0 {
                total += responsibility;
                vector::accumulate(&mut score, responsibility, &law.score(x));
            }
        }
        score.map(|component| component / total)
    }
}

impl<const D: usize> UnitCubeTransport<D> for MixtureLaw<D> {
    /// One coordinate more than the largest of the parts: the first selects the part.
    fn cube_dimension(&self) -> usize {
        let most = self.parts.iter().map(|(_, law)| law.cube_dimension()).max();
        1 + most.unwrap_or(0)
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        let mut level = u.first().copied().unwrap_or(0.5);
        let rest = u.get(1..).unwrap_or(&[]);
        let last = self.parts.len() - 1;
        for (mass, law) in &self.parts[..last] {
            if level < *mass {
                return law.transport(rest);
            }
            level -= mass;
        }
        self.parts[last].1.transport(rest)
    }
}
