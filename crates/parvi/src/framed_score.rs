//! The score as a body force in the coordinates of the frame.

use mpm_core::{BodyForce, ForceLocation, MpmError, Sites};
use parvi_targets::{Frame, Target};

use crate::stiffness::Stiffness;
use crate::{NonFiniteScores, ScoreLocation};

/// Scores of `target` pulled back to frame coordinates: x = μ + L z, s_z = Lᵀ ∇ log p(x).
pub(crate) struct FramedScore<'a, const D: usize> {
    pub target: &'a (dyn Target<D> + 'a),
    pub frame: &'a Frame<D>,
    /// Points evaluated so far.
    pub evaluations: u64,
    /// What is done about a score that is not finite.
    pub non_finite: NonFiniteScores,
    /// Scores that were not finite and have been replaced.
    pub replaced: u64,
    points: Vec<[f64; D]>,
}

impl<'a, const D: usize> FramedScore<'a, D> {
    pub fn new(target: &'a (dyn Target<D> + 'a), frame: &'a Frame<D>) -> Self {
        Self {
            target,
            frame,
            evaluations: 0,
            non_finite: NonFiniteScores::Report,
            replaced: 0,
            points: Vec::new(),
        }
    }

    /// Scores at `zs`; one that is not finite is replaced or an error, as `non_finite` says.
    pub fn evaluate(&mut self, zs: &[[f64; D]], out: &mut [[f64; D]]) -> Result<(), MpmError> {
        self.points.clear();
        self.points.extend(zs.iter().map(|z| self.frame.to_target(z)));
        self.target.scores(&self.points, out);
        self.evaluations += zs.len() as u64;
        for (index, score) in out.iter_mut().enumerate() {
            if !score.iter().all(|c| c.is_finite()) {
                if self.non_finite == NonFiniteScores::PullBack {
                    *score = zs[index].map(|c| -c);
                    self.replaced += 1;
                    continue;
                }
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

    /// −E\[log p(x)\] over equally weighted points.
    pub fn potential_energy(&self, zs: &[[f64; D]]) -> f64 {
        let sum: f64 = zs
            .iter()
            .map(|z| self.target.log_density(&self.frame.to_target(z)))
            .sum();
        -sum / zs.len() as f64
    }
}

/// The score as the force of a step, times a factor α that a schedule may change.
pub(crate) struct ScoreForce<'a, const D: usize> {
    /// The score.
    pub score: FramedScore<'a, D>,
    /// Factor α.
    pub alpha: f64,
    /// At the particles as a force per unit mass (paper, Eq. 5), or at the nodes (Eq. 3).
    pub location: ScoreLocation,
    /// At the nodes: f_i = m_i α s(x_i), a force per unit mass, instead of α s(x_i).
    pub mass_weighted: bool,
    /// At the nodes: those lighter than this receive no force.
    pub mass_floor: f64,
    /// Where it is to be known (at the particles), how stiff the target is.
    pub stiffness: Option<Stiffness<D>>,
}

impl<'a, const D: usize> ScoreForce<'a, D> {
    /// At the particles, as it is.
    pub fn at_particles(score: FramedScore<'a, D>) -> Self {
        Self {
            score,
            alpha: 1.0,
            location: ScoreLocation::Particles,
            mass_weighted: true,
            mass_floor: 0.0,
            stiffness: None,
        }
    }
}

impl<const D: usize> BodyForce<D> for ScoreForce<'_, D> {
    fn location(&self) -> ForceLocation {
        match self.location {
            ScoreLocation::Particles => ForceLocation::Particles,
            ScoreLocation::Nodes => ForceLocation::Nodes,
        }
    }

    fn at_particles(&mut self, sites: &Sites<D>, accelerations: &mut [[f64; D]]) -> Result<(), MpmError> {
        self.score.evaluate(sites.positions, accelerations)?;
        if let Some(stiffness) = &mut self.stiffness {
            stiffness.record(sites.positions, accelerations);
        }
        if self.alpha != 1.0 {
            for acceleration in accelerations {
                *acceleration = acceleration.map(|c| self.alpha * c);
            }
        }
        Ok(())
    }

    fn at_nodes(
        &mut self,
        positions: &[[f64; D]],
        masses: &dyn Fn(usize) -> f64,
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
