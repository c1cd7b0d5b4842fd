//! One step of the reduced dynamics, phase by phase (Chen et al. 2023, Algorithm 2).

use mpm_tensor::vector;

use super::coordinates::Coordinates;
use super::eulerian::Eulerian;
use super::instant::Instant;
use super::lagrangian::Lagrangian;
use super::nodes::Nodes;
use super::quadrature::QuadraturePoints;
use super::redraw::Redraw;
use super::{OnlineError, Options, Quadrature, ReducedBody, SampleWeights, Update};
use crate::deformation_map::{DeformationMap, MaterialPoints};
use crate::manifold::{Evaluation, Wanted};

/// A body whose motion is that of r coordinates.
pub struct ReducedModel<'a, const D: usize> {
    pub(super) body: ReducedBody<D>,
    pub(super) map: DeformationMap<'a, D>,
    pub(super) options: Options,
    /// Where 𝒫 is drawn anew in every step, what from; and the step that it has been drawn for.
    pub(super) redraw: Option<Redraw>,
    pub(super) drawn_for: u64,
    /// Numbers of the sample points 𝒫 and what the map needs of them.
    pub(super) sample_numbers: Vec<u32>,
    pub(super) samples: MaterialPoints<D>,
    pub(super) coordinates: Coordinates<D>,
    pub(super) nodes: Nodes<D>,
    pub(super) scheme: Scheme<D>,
    pub(super) quadrature: QuadraturePoints<D>,
    /// The map at the sample points.
    pub(super) evaluation: Evaluation<D>,
    /// x_p and v_p of the sample points at the end of a step, where they are prescribed.
    pub(super) prescribed: Vec<Option<([f64; D], [f64; D])>>,
    /// v_p and x_p of the sample points at the end of a step.
    pub(super) velocities: Vec<[f64; D]>,
    pub(super) moved: Vec<[f64; D]>,
    /// The number of the step under way or taken last.
    pub(super) step: u64,
}

/// The quadrature with its storage.
pub(super) enum Scheme<const D: usize> {
    Lagrangian(Lagrangian<D>),
    Eulerian(Eulerian<D>),
}

/// What a step did.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct StepReport {
    /// |ℐ|.
    pub nodes: usize,
    /// Quadrature points that carried mass.
    pub quadrature_points: usize,
    /// Quadrature points whose F has been limited because of J ≤ 0 since the start, counted in every step.
    pub limited: usize,
    /// How often neighbour lists have been made since the start.
    pub refreshes: u64,
}

impl<const D: usize> ReducedModel<'_, D> {
    /// One step of length Δt, from t_n to t_{n+1}.
    ///
    /// # Errors
    /// [`OnlineError`] with the number of the step; x̂ and the time are then those of t_n.
    pub fn step(&mut self) -> Result<StepReport, OnlineError> {
        self.step += 1;
        let found = self.find_velocities();
        let moved = found.and_then(|report| self.move_coordinates().map(|()| report));
        if moved.is_err() {
            self.step -= 1;
        }
        moved
    }

    /// (1) to (4): the velocities of the sample points.
    pub(super) fn find_velocities(&mut self) -> Result<StepReport, OnlineError> {
        self.draw_samples();
        self.place_samples();
        self.activate_nodes()?;
        let mut report = self.place_quadrature()?;
        self.sum_at_nodes();
        self.move_samples()?;
        report.nodes = self.nodes.places.len();
        report.quadrature_points = self.quadrature.len();
        Ok(report)
    }

    /// (1) 𝒫 of this step, where every step has its own, with what hangs on it.
    fn draw_samples(&mut self) {
        let Some(redraw) = self.redraw.as_mut().filter(|_| self.drawn_for != self.step) else {
            return;
        };
        self.drawn_for = self.step;
        self.sample_numbers = redraw.of_step(self.step);
        let numbers = &self.sample_numbers;
        match &self.scheme {
            Scheme::Lagrangian(scheme) => scheme.select(numbers, &mut self.samples),
            Scheme::Eulerian(_) => self.samples = self.map.prepare(&self.body.reference_of(numbers)),
        }
        let weights = self.options.weights;
        if weights != SampleWeights::Equal {
            self.coordinates.weigh(weights.of(&self.body.reference, numbers));
        }
    }

    /// (1) x_p = g(X_p, x̂_n) of the sample points, with ∂g/∂x̂ for (5).
    fn place_samples(&mut self) {
        let wanted = Wanted {
            gradients: matches!(self.options.quadrature, Quadrature::Eulerian { .. }),
            jacobians: true,
        };
        let latent = &self.coordinates.latent;
        self.map.evaluate(&self.samples, latent, wanted, &mut self.evaluation);
    }

    /// (2) ℐ: the nodes that sample points touch, those aside whose motion is prescribed, since they take nothing from nodes.
    fn activate_nodes(&mut self) -> Result<(), OnlineError> {
        let end = self.time_at(self.step);
        let numbers = self.sample_numbers.iter();
        self.prescribed.clear();
        self.prescribed
            .extend(numbers.map(|&point| self.body.prescribed(point as usize, end)));
        let samples = self.evaluation.positions.iter().enumerate();
        let free = samples.filter(|&(sample, _)| self.prescribed[sample].is_none());
        self.nodes.activate(free, self.step)
    }

    /// (3) The quadrature points with x_q, v_q, F_q, m_q / ρ₀ and their stresses.
    fn place_quadrature(&mut self) -> Result<StepReport, OnlineError> {
        let now = Instant {
            latent: &self.coordinates.latent,
            rates: &self.coordinates.rates,
            step: self.step,
            reference: &self.samples.reference,
            samples: &self.evaluation,
            redrawn: self.redraw.as_ref().map(|_| &*self.sample_numbers),
            inverted: self.options.inverted,
        };
        let (body, nodes, out) = (&self.body, &self.nodes, &mut self.quadrature);
        let mut report = StepReport::default();
        match &mut self.scheme {
            Scheme::Lagrangian(scheme) => {
                scheme.place(body, &self.map, nodes, &now, out)?;
                report.refreshes = scheme.refreshes;
            }
            Scheme::Eulerian(scheme) => {
                scheme.place(body, &self.map, nodes, &now, out)?;
            }
        }
        report.limited = self.quadrature.limited;
        self.quadrature.update_stresses(&*self.body.material);
        Ok(report)
    }

    /// (4) m_i = Σ N_i m_q, m_i v_i = Σ N_i m_q v_q, f_i = Σ (J_q / ρ₀) m_q (b N_i − σ_q ∇N_i), v_i ← v_i + Δt f_i / m_i, with
    /// (J_q / ρ₀) m_q σ_q = (m_q / ρ₀) τ_q and (J_q / ρ₀) b = g the force per mass; held nodes
    /// take their velocity (ours: as in the full-order run).
    fn sum_at_nodes(&mut self) {
        let (dt, density) = (self.body.time_step, self.body.density);
        for (x, v, volume, stress) in self.quadrature.iter() {
            let mass = density * volume;
            let pulled = vector::add_scaled(v, dt, &self.body.gravity);
            let momentum = vector::scale(&pulled, mass);
            self.nodes.add(x, mass, &momentum, &(*stress * (dt * volume)));
        }
        self.nodes.divide();
        self.nodes.hold(&self.body, self.time_at(self.step - 1));
    }

    /// (4) v_p = Σ N_i v_i and x_p ← x_p + Δt v_p; kinematic points take what is prescribed for t_{n+1}.
    fn move_samples(&mut self) -> Result<(), OnlineError> {
        let dt = self.body.time_step;
        self.velocities.clear();
        self.moved.clear();
        for (sample, (x, prescribed)) in self.evaluation.positions.iter().zip(&self.prescribed).enumerate() {
            let (position, velocity) = match *prescribed {
                Some(prescribed) => prescribed,
                None => {
                    let missing = OnlineError::NoMass {
                        step: self.step,
                        sample,
                    };
                    let velocity = self.nodes.velocity_at(x).ok_or(missing)?;
                    (vector::add_scaled(x, dt, &velocity), velocity)
                }
            };
            self.velocities.push(velocity);
            self.moved.push(position);
        }
        Ok(())
    }

    /// Kinematic points take the velocity that leads from g(X_p, x̂_n) to their prescribed position (ours): velocities alone know no positions, and what they miss would add up.
    fn lead_prescribed(&mut self) {
        let per_time = 1.0 / self.body.time_step;
        for (sample, _) in self
            .prescribed
            .iter()
            .enumerate()
            .filter(|(_, prescribed)| prescribed.is_some())
        {
            let way = vector::subtract(&self.moved[sample], &self.evaluation.positions[sample]);
            self.velocities[sample] = vector::scale(&way, per_time);
        }
    }

    /// (5) v̂_{n+1} and x̂_{n+1}.
    fn move_coordinates(&mut self) -> Result<(), OnlineError> {
        let (step, dt) = (self.step, self.body.time_step);
        if self.options.update == Update::VelocityOnly {
            self.lead_prescribed();
        }
        let failed = |source| OnlineError::Coordinates { step, source };
        self.coordinates
            .find_rates(&self.evaluation, &self.velocities)
            .map_err(failed)?;
        self.coordinates
            .advance(&self.map, &self.samples, &self.moved, dt, self.options.update)
            .map_err(failed)
    }

    /// t after so many steps.
    pub(super) fn time_at(&self, step: u64) -> f64 {
        step as f64 * self.body.time_step
    }
}
