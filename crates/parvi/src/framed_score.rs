//! The score as a body force in the coordinates of the frame.

use mpm_core::{BodyForce, MpmError};
use parvi_targets::{Frame, Target};

/// Scores of `target` pulled back to frame coordinates: x = μ + L z, s_z = Lᵀ ∇ log p(x), times α.
pub(crate) struct FramedScore<'a, const D: usize> {
    pub target: &'a (dyn Target<D> + 'a),
    pub frame: &'a Frame<D>,
    /// Points evaluated so far.
    pub evaluations: u64,
    points: Vec<[f64; D]>,
}

impl<'a, const D: usize> FramedScore<'a, D> {
    pub fn new(target: &'a (dyn Target<D> + 'a), frame: &'a Frame<D>) -> Self {
        Self {
            target,
            frame,
            evaluations: 0,
            points: Vec::new(),
        }
    }

    /// Scores at `zs`.
    pub fn evaluate(&mut self, zs: &[[f64; D]], out: &mut [[f64; D]]) -> Result<(), MpmError> {
        self.points.clear();
        self.points.extend(zs.iter().map(|z| self.frame.to_target(z)));
        self.target.scores(&self.points, out);
        self.evaluations += zs.len() as u64;
        for (index, score) in out.iter_mut().enumerate() {
            if !score.iter().all(|c| c.is_finite()) {
                return Err(MpmError::BodyForceNotFinite {
                    index,
                    position: self.points[index].to_vec(),
                    value: score.to_vec(),
                });
            }
            *score = self.frame.pull_back_score(score);
        }
        Ok(())
    }

    /// −E[log p(x)] over equally weighted points.
    pub fn potential_energy(&self, zs: &[[f64; D]]) -> f64 {
        let sum: f64 = zs
            .iter()
            .map(|z| self.target.log_density(&self.frame.to_target(z)))
            .sum();
        -sum / zs.len() as f64
    }
}

/// A body force that is a score, times a factor α that a schedule may change.
pub(crate) trait ScoreForce<'a, const D: usize>: BodyForce<D> {
    /// Set α.
    fn set_alpha(&mut self, alpha: f64);

    /// The score behind the force.
    fn score(&mut self) -> &mut FramedScore<'a, D>;
}

impl<'a, const D: usize> ScoreForce<'a, D> for ScoreAtParticles<'a, D> {
    fn set_alpha(&mut self, alpha: f64) {
        self.alpha = alpha;
    }

    fn score(&mut self) -> &mut FramedScore<'a, D> {
        &mut self.score
    }
}

impl<'a, const D: usize> ScoreForce<'a, D> for ScoreAtNodes<'a, D> {
    fn set_alpha(&mut self, alpha: f64) {
        self.alpha = alpha;
    }

    fn score(&mut self) -> &mut FramedScore<'a, D> {
        &mut self.score
    }
}

/// The score at the particles, as a force per unit mass (paper, Eq. 5).
pub(crate) struct ScoreAtParticles<'a, const D: usize> {
    pub score: FramedScore<'a, D>,
    /// Factor α.
    pub alpha: f64,
}

impl<const D: usize> BodyForce<D> for ScoreAtParticles<'_, D> {
    const AT_PARTICLES: bool = true;
    const AT_NODES: bool = false;

    fn at_particles(&mut self, positions: &[[f64; D]], accelerations: &mut [[f64; D]]) -> Result<(), MpmError> {
        self.score.evaluate(positions, accelerations)?;
        if self.alpha != 1.0 {
            for acceleration in accelerations {
                *acceleration = acceleration.map(|c| self.alpha * c);
            }
        }
        Ok(())
    }
}

/// The score at the nodes (paper, Eq. 3): f_i = α s(x_i), or m_i α s(x_i) with `mass_weighted`.
pub(crate) struct ScoreAtNodes<'a, const D: usize> {
    pub score: FramedScore<'a, D>,
    /// Factor α.
    pub alpha: f64,
    /// Multiply by the nodal mass, which makes α s a force per unit mass.
    pub mass_weighted: bool,
    /// Nodes lighter than this receive no force.
    pub mass_floor: f64,
}

impl<const D: usize> BodyForce<D> for ScoreAtNodes<'_, D> {
    const AT_PARTICLES: bool = false;
    const AT_NODES: bool = true;

    fn at_nodes(
        &mut self,
        positions: &[[f64; D]],
        masses: impl Fn(usize) -> f64,
        forces: &mut [[f64; D]],
    ) -> Result<(), MpmError> {
        self.score.evaluate(positions, forces)?;
        for (node, force) in forces.iter_mut().enumerate() {
            let mass = masses(node);
            let scale = if mass <= self.mass_floor {
                0.0
            } else if self.mass_weighted {
                self.alpha * mass
            } else {
                self.alpha
            };
            *force = force.map(|c| scale * c);
        }
        Ok(())
    }
}
