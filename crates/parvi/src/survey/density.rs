//! The target as the survey sees it: in the coordinates of the given frame, point by point, every evaluation counted.

use parvi_targets::{Frame, Target};

/// A point with log p and the score there, in frame coordinates.
#[derive(Clone, Copy, Debug)]
pub(super) struct Valued<const D: usize> {
    pub point: [f64; D],
    pub log_density: f64,
    pub score: [f64; D],
}

/// log q(z) = log p(μ + L z) and its score, up to the constant log det L.
pub(super) struct Density<'a, const D: usize> {
    target: &'a dyn Target<D>,
    frame: &'a Frame<D>,
    /// Points evaluated so far, whether for log p, for the score or for both.
    pub evaluations: u64,
}

impl<'a, const D: usize> Density<'a, D> {
    pub fn new(target: &'a dyn Target<D>, frame: &'a Frame<D>) -> Self {
        Self {
            target,
            frame,
            evaluations: 0,
        }
    }

    /// log q(z); −∞ where it is NaN.
    pub fn log_density(&mut self, z: &[f64; D]) -> f64 {
        self.evaluations += 1;
        let value = self.target.log_density(&self.frame.to_target(z));
        if value.is_nan() { f64::NEG_INFINITY } else { value }
    }

    /// log q and scores at all of `zs`, in one batch each; `None` where one is not finite.
    pub fn values(&mut self, zs: &[[f64; D]]) -> Option<Vec<Valued<D>>> {
        self.evaluations += zs.len() as u64;
        let points: Vec<[f64; D]> = zs.iter().map(|z| self.frame.to_target(z)).collect();
        let (mut log_densities, mut scores) = (vec![0.0; zs.len()], vec![[0.0; D]; zs.len()]);
        self.target.log_densities(&points, &mut log_densities);
        self.target.scores(&points, &mut scores);
        let valued = zs
            .iter()
            .zip(log_densities)
            .zip(&scores)
            .map(|((z, log_density), score)| {
                let score = self.frame.pull_back_score(score);
                let finite = log_density.is_finite() && score.iter().all(|c| c.is_finite());
                finite.then_some(Valued {
                    point: *z,
                    log_density,
                    score,
                })
            });
        valued.collect()
    }

    /// log q and score at z, `None` where either is not finite.
    pub fn value(&mut self, z: &[f64; D]) -> Option<Valued<D>> {
        let log_density = self.log_density(z);
        let score = self.frame.pull_back_score(&self.target.score(&self.frame.to_target(z)));
        let finite = log_density.is_finite() && score.iter().all(|c| c.is_finite());
        finite.then_some(Valued {
            point: *z,
            log_density,
            score,
        })
    }
}
