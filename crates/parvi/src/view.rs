//! What an observer sees of the particles.

use std::fmt::{self, Debug, Formatter};

use mpm_core::{Masses, Particles};
use mpm_tensor::Matrix;
use parvi_targets::Frame;

use crate::{Observer, SampleError};

/// Particles on their way, in any dimension: everything is computed when it is asked for, and nothing otherwise.
///
/// Particle p has the same place in every list at every step: that in which the particles were started, and in which a run returns them.
#[derive(Clone, Copy)]
pub struct ParticleView<'a> {
    /// Which body of the run moves, from 0: every round of the calibrated sampler begins a new one where the last one came to its end. Other methods have one.
    pub body: usize,
    /// Steps that this body has made; 0: where it begins.
    ///
    /// It falls where a run goes back to an earlier state, and what was seen of later ones is void. A run that goes on from a checkpoint begins with the
    /// step of that.
    pub step: usize,
    /// Steps in all that this body makes, at most.
    pub steps: usize,
    /// Steps of the bodies before it.
    pub earlier_steps: usize,
    /// Pseudo-time Σ Δt of this body; the number of the step for methods without one.
    pub time: f64,
    state: &'a dyn State,
}

impl ParticleView<'_> {
    /// D.
    pub fn dimension(&self) -> usize {
        self.state.dimension()
    }

    /// M.
    pub fn particles(&self) -> usize {
        self.state.particles()
    }

    /// x_p in the target's own coordinates, M × D, row by row.
    pub fn positions(&self) -> Vec<f64> {
        self.state.positions()
    }

    /// v_p in the target's own coordinates, L v of the frame x = μ + L z, M × D, row by row; length of x per pseudo-time. `None` for methods without velocities.
    pub fn velocities(&self) -> Option<Vec<f64>> {
        self.state.velocities()
    }

    /// F_p in the target's own coordinates, L F L⁻¹ of the frame x = μ + L z, M × D × D, row by row: the deformation since the body began, dx = F dX. `None` for media
    /// that have none, as a gas.
    pub fn deformation_gradients(&self) -> Option<Vec<f64>> {
        self.state.deformation_gradients()
    }

    /// m_p, M of them; `None` where all are the same.
    pub fn masses(&self) -> Option<Vec<f64>> {
        self.state.masses()
    }
}

impl Debug for ParticleView<'_> {
    fn fmt(&self, formatter: &mut Formatter<'_>) -> fmt::Result {
        formatter
            .debug_struct("ParticleView")
            .field("body", &self.body)
            .field("step", &self.step)
            .field("steps", &self.steps)
            .field("earlier_steps", &self.earlier_steps)
            .field("time", &self.time)
            .field("dimension", &self.dimension())
            .field("particles", &self.particles())
            .finish()
    }
}

/// What a view looks at, without its dimension.
trait State {
    fn dimension(&self) -> usize;
    fn particles(&self) -> usize;
    fn positions(&self) -> Vec<f64>;

    fn velocities(&self) -> Option<Vec<f64>> {
        None
    }

    fn deformation_gradients(&self) -> Option<Vec<f64>> {
        None
    }

    fn masses(&self) -> Option<Vec<f64>> {
        None
    }
}

/// A body in coordinates of its frame, in whatever order.
struct InFrame<'a, const D: usize, S> {
    particles: &'a Particles<D, S>,
    frame: &'a Frame<D>,
}

impl<const D: usize, S: Copy + Send + Sync> State for InFrame<'_, D, S> {
    fn dimension(&self) -> usize {
        D
    }

    fn particles(&self) -> usize {
        self.particles.len()
    }

    fn positions(&self) -> Vec<f64> {
        let positions = self.particles.in_creation_order(&self.particles.positions);
        positions.iter().flat_map(|z| self.frame.to_target(z)).collect()
    }

    fn velocities(&self) -> Option<Vec<f64>> {
        let velocities = self.particles.in_creation_order(&self.particles.velocities);
        let factor = self.frame.factor();
        Some(velocities.iter().flat_map(|v| factor.apply(v)).collect())
    }

    fn deformation_gradients(&self) -> Option<Vec<f64>> {
        let gradients = &self.particles.deformation_gradients;
        if gradients.is_empty() {
            return None;
        }
        let gradients = self.particles.in_creation_order(gradients);
        let turned = gradients.iter().map(|gradient| in_target(gradient, self.frame));
        Some(turned.flat_map(|gradient| gradient.0.into_iter().flatten()).collect())
    }

    fn masses(&self) -> Option<Vec<f64>> {
        match &self.particles.masses {
            Masses::Equal(_) => None,
            Masses::Each(masses) => Some(self.particles.in_creation_order(masses)),
        }
    }
}

/// L F L⁻¹, by substitution: X = F L⁻¹ solves X L = F, column by column from the last one, since L is lower triangular.
fn in_target<const D: usize>(gradient: &Matrix<D>, frame: &Frame<D>) -> Matrix<D> {
    let l = &frame.factor().0;
    let mut solved = gradient.0;
    for row in &mut solved {
        for j in (0..D).rev() {
            let known: f64 = (j + 1..D).map(|k| row[k] * l[k][j]).sum();
            row[j] = (row[j] - known) / l[j][j];
        }
    }
    *frame.factor() * Matrix(solved)
}

/// Points in the order of their start, each coordinate in a unit of its own or in those of a frame.
struct Points<'a, const D: usize> {
    positions: &'a [[f64; D]],
    to_target: &'a dyn Fn(&[f64; D]) -> [f64; D],
}

impl<const D: usize> State for Points<'_, D> {
    fn dimension(&self) -> usize {
        D
    }

    fn particles(&self) -> usize {
        self.positions.len()
    }

    fn positions(&self) -> Vec<f64> {
        self.positions.iter().flat_map(self.to_target).collect()
    }
}

/// Where in a run particles are seen; the fields are those of [`ParticleView`].
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Moment {
    pub body: usize,
    pub step: usize,
    pub steps: usize,
    pub earlier_steps: usize,
    pub time: f64,
}

impl Moment {
    /// Shows a body in coordinates of a frame.
    pub fn show<const D: usize, S: Copy + Send + Sync>(
        self,
        particles: &Particles<D, S>,
        frame: &Frame<D>,
        observer: &mut dyn Observer,
    ) -> Result<(), SampleError> {
        self.show_state(&InFrame { particles, frame }, observer)
    }

    /// Shows points.
    pub fn show_points<const D: usize>(
        self,
        positions: &[[f64; D]],
        to_target: &dyn Fn(&[f64; D]) -> [f64; D],
        observer: &mut dyn Observer,
    ) -> Result<(), SampleError> {
        self.show_state(&Points { positions, to_target }, observer)
    }

    fn show_state(self, state: &dyn State, observer: &mut dyn Observer) -> Result<(), SampleError> {
        let view = ParticleView {
            body: self.body,
            step: self.step,
            steps: self.steps,
            earlier_steps: self.earlier_steps,
            time: self.time,
            state,
        };
        if observer.see(&view).is_break() {
            return Err(SampleError::Interrupted { step: self.step });
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use mpm_tensor::vector;

    use super::*;

    #[test]
    fn a_body_is_seen_in_coordinates_of_the_target_and_in_the_order_of_creation() {
        let covariance = Matrix([[4.0, 1.8, 0.3], [1.8, 1.0, 0.2], [0.3, 0.2, 9.0]]);
        let frame = Frame::new([1.0, -2.0, 0.5], covariance).expect("a covariance");
        let reference = [[0.3, -1.0, 2.0], [0.0, 0.7, -0.4]];
        let gradients = [
            Matrix([[1.2, 0.3, -0.1], [0.0, 0.8, 0.4], [0.5, -0.2, 1.1]]),
            Matrix([[0.9, 0.0, 0.2], [0.1, 1.0, 0.0], [-0.3, 0.6, 1.4]]),
        ];
        let velocities = [[1.0, 0.5, -2.0], [0.0, 3.0, 1.0]];
        let positions = [0, 1].map(|p| gradients[p].apply(&reference[p])).to_vec();
        // Particle 1 stands first.
        let mut particles = Particles::in_order(
            vec![positions[1], positions[0]],
            vec![velocities[1], velocities[0]],
            Masses::Each(vec![0.75, 0.25]),
            Vec::new(),
            vec![1, 0],
        )
        .expect("particles");
        let state = |particles: &Particles<3>| {
            let state = InFrame {
                particles,
                frame: &frame,
            };
            (state.deformation_gradients(), state.masses())
        };
        assert_eq!(state(&particles), (None, Some(vec![0.25, 0.75])));
        particles.deformation_gradients = vec![gradients[1], gradients[0]];
        let state = InFrame {
            particles: &particles,
            frame: &frame,
        };
        let seen = state.deformation_gradients().expect("an elastic body");
        let (x, v) = (state.positions(), state.velocities().expect("velocities"));
        for p in 0..2 {
            // x − μ = F (X − μ) and x(t + Δt) = x + Δt v, both in the target's coordinates.
            let start = vector::subtract(&frame.to_target(&reference[p]), frame.centre());
            let moved: [f64; 3] = std::array::from_fn(|a| positions[p][a] + 1e-3 * velocities[p][a]);
            let moved = frame.to_target(&moved);
            for a in 0..3 {
                let row = &seen[9 * p + 3 * a..9 * p + 3 * a + 3];
                let along: f64 = row.iter().zip(&start).map(|(f, c)| f * c).sum();
                assert!((x[3 * p + a] - frame.centre()[a] - along).abs() < 1e-13);
                assert!((x[3 * p + a] + 1e-3 * v[3 * p + a] - moved[a]).abs() < 1e-13);
            }
        }
    }
}
