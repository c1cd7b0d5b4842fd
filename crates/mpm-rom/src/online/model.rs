//! A reduced model: how it is made, and what it says of the body.

use super::coordinates::Coordinates;
use super::eulerian::Eulerian;
use super::lagrangian::Lagrangian;
use super::nodes::Nodes;
use super::quadrature::QuadraturePoints;
use super::step::Scheme;
use super::{
    Inverted, OnlineError, Options, Quadrature, ReducedBody, ReducedModel, SampleChoice, SampleWeights, StepReport,
    Update,
};
use crate::deformation_map::{DeformationMap, MaterialPoints};
use crate::manifold::{Evaluation, Wanted};

impl<'a, const D: usize> ReducedModel<'a, D> {
    /// The model at t = 0: x̂ = x̂₀, v̂ = 0.
    ///
    /// # Errors
    /// [`OnlineError::Option`]; those of [`SampleChoice::choose`](super::SampleChoice::choose).
    pub fn new(body: ReducedBody<D>, map: DeformationMap<'a, D>, options: Options) -> Result<Self, OnlineError> {
        let numbers = options
            .samples
            .choose(&body.reference, map.coordinates(), &body.kinematics)?;
        Self::with_samples(body, map, options, numbers)
    }

    /// A model that is not run, but [read](Self::reading) at the points with these numbers: kinematic regions need have none of them.
    ///
    /// # Errors
    /// [`OnlineError::Option`].
    pub(crate) fn to_read(
        body: ReducedBody<D>,
        map: DeformationMap<'a, D>,
        numbers: Vec<u32>,
        quadrature: Quadrature,
    ) -> Result<Self, OnlineError> {
        let options = Options {
            samples: SampleChoice::Given(numbers.clone()),
            weights: SampleWeights::Equal,
            quadrature,
            update: Update::VelocityOnly,
            inverted: Inverted::Refuse,
        };
        Self::with_samples(body, map, options, numbers)
    }

    fn with_samples(
        body: ReducedBody<D>,
        map: DeformationMap<'a, D>,
        options: Options,
        sample_numbers: Vec<u32>,
    ) -> Result<Self, OnlineError> {
        options.quadrature.check()?;
        let own = options.samples.weights()?;
        let weights = own.unwrap_or_else(|| options.weights.of(&body.reference, &sample_numbers));
        let samples = map.prepare(&body.reference_of(&sample_numbers));
        let points = body.reference.len();
        let redraw = options.samples.redraw(points, map.coordinates(), &body.kinematics)?;
        let scheme = match options.quadrature {
            Quadrature::Lagrangian { search } => {
                Scheme::Lagrangian(Lagrangian::new(search, map.prepare(&body.reference)))
            }
            Quadrature::Eulerian { per_axis } => Scheme::Eulerian(Eulerian::tabulated(per_axis, &map, &body)),
        };
        Ok(Self {
            coordinates: Coordinates::new(map.rest().to_vec(), weights),
            nodes: Nodes::new(body.grid),
            body,
            map,
            options,
            redraw,
            drawn_for: 1,
            sample_numbers,
            samples,
            scheme,
            quadrature: QuadraturePoints::default(),
            evaluation: Evaluation::default(),
            prescribed: Vec::new(),
            velocities: Vec::new(),
            moved: Vec::new(),
            step: 0,
        })
    }

    /// All steps up to a time that is a whole number of them; the report is that of the last.
    ///
    /// # Errors
    /// As [`step`](Self::step).
    pub fn advance_to(&mut self, time: f64) -> Result<StepReport, OnlineError> {
        let mut report = StepReport::default();
        while self.time() < time - 0.5 * self.body.time_step {
            report = self.step()?;
        }
        Ok(report)
    }

    /// The body.
    pub fn body(&self) -> &ReducedBody<D> {
        &self.body
    }

    /// x̂.
    pub fn latent(&self) -> &[f64] {
        &self.coordinates.latent
    }

    /// v̂.
    pub fn rates(&self) -> &[f64] {
        &self.coordinates.rates
    }

    /// t.
    pub fn time(&self) -> f64 {
        self.time_at(self.step)
    }

    /// Steps taken.
    pub fn steps(&self) -> u64 {
        self.step
    }

    /// Numbers of the sample points, ascending; where every step has its own, those of the step [taken](Self::step), tried or [read](Self::reading) last, and before all steps those of the first.
    pub fn samples(&self) -> &[u32] {
        &self.sample_numbers
    }

    /// Points of the body for [`evaluate`](Self::evaluate), by their reference positions: its own, or others (super-resolution).
    pub fn prepare(&self, reference: &[[f64; D]]) -> MaterialPoints<D> {
        self.map.prepare(reference)
    }

    /// g, F and ∂g/∂x̂ at prepared points now.
    pub fn evaluate(&self, points: &MaterialPoints<D>, wanted: Wanted, out: &mut Evaluation<D>) {
        self.map.evaluate(points, &self.coordinates.latent, wanted, out);
    }
}
