//! The score as a body force in the coordinates of the frame.

use mpm_core::{BodyForce, ForceLocation, Masses, MpmError, Sites};
use mpm_tensor::vector::is_finite;
use parvi_targets::{Frame, Target, scores_in_calls};

use crate::choices::{NonFiniteScores, ScoreLocation};
use crate::node_scores::NodeScores;
use crate::stiffness::Stiffness;

/// Scores of `target` pulled back to frame coordinates: x = μ + L z, s_z = Lᵀ ∇ log p(x).
pub struct FramedScore<'a, const D: usize> {
    /// The target.
    pub target: &'a (dyn Target<D> + 'a),
    /// μ and L.
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
    /// Nothing evaluated yet; a score that is not finite is an error.
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

    /// Scores at `zs`; one that is not finite, in either coordinates, is replaced or an error, as `non_finite` says.
    ///
    /// # Errors
    /// [`MpmError::BodyForceNotFinite`].
    pub fn evaluate(&mut self, zs: &[[f64; D]], out: &mut [[f64; D]]) -> Result<(), MpmError> {
        self.points.clear();
        self.points.extend(zs.iter().map(|z| self.frame.to_target(z)));
        scores_in_calls(self.target, &self.points, out);
        self.evaluations += zs.len() as u64;
        for (index, score) in out.iter_mut().enumerate() {
            let pulled_back = self.frame.pull_back_score(score);
            if is_finite(&pulled_back) {
                *score = pulled_back;
                continue;
            }
            if self.non_finite == NonFiniteScores::PullBack {
                *score = zs[index].map(|c| -c);
                self.replaced += 1;
                continue;
            }
            let value = if is_finite(score) { &pulled_back } else { &*score };
            return Err(MpmError::BodyForceNotFinite {
                index,
                position: self.points[index].to_vec(),
                value: value.to_vec(),
            });
        }
        Ok(())
    }

    /// −E\[log p(x)\] over equally weighted points, where log p is known.
    pub fn potential_energy(&self, zs: &[[f64; D]]) -> Option<f64> {
        if !self.target.has_log_density() {
            return None;
        }
        let sum: f64 = zs
            .iter()
            .map(|z| self.target.log_density(&self.frame.to_target(z)))
            .sum();
        Some(-sum / zs.len() as f64)
    }
}

/// The score as the force of a step, times a factor α that a schedule may change.
pub struct ScoreForce<'a, const D: usize> {
    /// The score.
    pub score: FramedScore<'a, D>,
    /// Factor α.
    pub alpha: f64,
    /// At the particles (the paper, Eq. 5), or at the nodes (Eq. 3).
    pub location: ScoreLocation,
    /// A force per unit mass, m_i α s(x_i) at the nodes and m_p α s(x_p) at the particles, instead of α s(x_i) and α s(x_p).
    pub mass_weighted: bool,
    /// m_p in the order of creation, which a force at particles that is not weighted by mass is divided by.
    pub masses: Masses,
    /// At the nodes: those lighter than this receive no force.
    pub mass_floor: f64,
    /// Scores at the nodes by node, where they are kept.
    pub node_scores: Option<NodeScores<D>>,
    /// Points evaluated for the force of steps, and not to judge the particles.
    pub moving_evaluations: u64,
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
            masses: Masses::Equal(1.0),
            mass_floor: 0.0,
            node_scores: None,
            moving_evaluations: 0,
            stiffness: None,
        }
    }

    /// Tell the force which grid the nodes of the next step are of.
    pub fn stand_on(&mut self, origin: &[f64; D], spacing: f64) {
        if let Some(known) = &mut self.node_scores {
            known.stand_on(origin, spacing);
        }
    }

    /// α s(x_i), or what it is to be instead, from the score s(x_i).
    fn at_node(&self, mass: f64, score: &[f64; D]) -> [f64; D] {
        let scale = if mass <= self.mass_floor {
            0.0
        } else if self.mass_weighted {
            self.alpha * mass
        } else {
            self.alpha
        };
        score.map(|c| scale * c)
    }
}

impl<const D: usize> BodyForce<D> for ScoreForce<'_, D> {
    fn location(&self) -> ForceLocation {
        match self.location {
            ScoreLocation::Particles | ScoreLocation::Cached => ForceLocation::Particles,
            ScoreLocation::Nodes => ForceLocation::Nodes,
        }
    }

    fn at_particles(&mut self, sites: &Sites<D>, accelerations: &mut [[f64; D]]) -> Result<(), MpmError> {
        let before = self.score.evaluations;
        self.score.evaluate(sites.positions, accelerations)?;
        self.moving_evaluations += self.score.evaluations - before;
        if let Some(stiffness) = &mut self.stiffness {
            stiffness.record(sites.positions, accelerations);
        }
        if self.alpha != 1.0 {
            for acceleration in accelerations.iter_mut() {
                *acceleration = acceleration.map(|c| self.alpha * c);
            }
        }
        if !self.mass_weighted {
            for (acceleration, &identity) in accelerations.iter_mut().zip(sites.identities) {
                let mass = self.masses.get(identity as usize);
                *acceleration = acceleration.map(|c| c / mass);
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
        let before = self.score.evaluations;
        let mut evaluate = |zs: &[[f64; D]], out: &mut [[f64; D]]| self.score.evaluate(zs, out);
        match &mut self.node_scores {
            Some(known) => known.evaluate(positions, forces, evaluate)?,
            None => evaluate(positions, forces)?,
        }
        self.moving_evaluations += self.score.evaluations - before;
        for (node, force) in forces.iter_mut().enumerate() {
            *force = self.at_node(masses(node), force);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A target of one score.
    struct Pulling([f64; 2]);

    impl Target<2> for Pulling {
        fn log_density(&self, _: &[f64; 2]) -> f64 {
            0.0
        }

        fn score(&self, _: &[f64; 2]) -> [f64; 2] {
            self.0
        }
    }

    #[test]
    fn a_score_that_a_frame_makes_infinite_is_none() {
        let frame = Frame::from_scales([1.0, 1.0], [4.0, 0.5]).expect("a frame");
        let places = [[0.25, -2.0]];
        for (score, value) in [
            ([1e308, 0.0], vec![f64::INFINITY, 0.0]),
            ([f64::INFINITY, 1.0], vec![f64::INFINITY, 1.0]),
        ] {
            let target = Pulling(score);
            let mut scores = FramedScore::new(&target, &frame);
            let mut out = [[0.0; 2]];
            let error = scores.evaluate(&places, &mut out).expect_err("an infinite score");
            let position = vec![2.0, 0.0];
            assert_eq!(
                error,
                MpmError::BodyForceNotFinite {
                    index: 0,
                    position,
                    value
                }
            );
            scores.non_finite = NonFiniteScores::PullBack;
            scores.evaluate(&places, &mut out).expect("a score in its place");
            assert_eq!((out, scores.replaced), ([[-0.25, 2.0]], 1));
        }
    }
}
