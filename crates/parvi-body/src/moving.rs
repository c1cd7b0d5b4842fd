//! A body on a basis of whatever type, as the loop around its steps sees it: what is behind is called once per step and compiled once per
//! basis, transfer and medium, the loop once per dimension.

use mpm_core::{Medium, Mpm, MpmError, Particles, StepReport, Transfer, UniformBasis};

use mpm_materials::Memory;

use crate::framed_score::ScoreForce;
use crate::grid_density::grid_densities;
use crate::planned_step::PlannedStep;
use crate::residual::{Residual, galerkin_stein_residual};

/// Particles of whatever medium; internal variables only where it has some.
pub type Cloud<const D: usize> = Particles<D, Memory>;

/// Particles that a score moves.
pub trait Moving<'a, const D: usize> {
    /// Their state.
    fn particles(&mut self) -> &mut Cloud<D>;

    /// What pulls at them.
    fn force(&mut self) -> &mut ScoreForce<'a, D>;

    /// Turn the basis as a step asks for.
    fn turn(&mut self, planned: &PlannedStep<D>);

    /// Place the basis and make the step.
    ///
    /// # Errors
    /// [`MpmError`]: a force, a velocity or a place that is not finite.
    fn step(&mut self, planned: &PlannedStep<D>) -> Result<StepReport, MpmError>;

    /// Where every particle was before the last sort ([`Schedule::order`](mpm_core::Schedule::order)).
    fn order(&self) -> &[u32];

    /// The residual of the particles with these scores, on a basis of spacing h that they were not moved on: half a cell off the origin of
    /// a step.
    ///
    /// # Errors
    /// [`MpmError`]: a particle that has no place on the basis, or no score.
    fn residual(&mut self, origin: &[f64; D], spacing: f64, scores: &[[f64; D]]) -> Result<Residual, MpmError>;

    /// ρ_h(x_p) = Σ_i w_ip m_i / h^D, the density on the grid of spacing h with a node at the origin, in the present order.
    ///
    /// # Errors
    /// [`MpmError`]: a particle that has no place on the basis.
    fn grid_densities(&mut self, spacing: f64) -> Result<Vec<f64>, MpmError>;

    /// Bytes held.
    fn storage_bytes(&self) -> usize;
}

/// A body and a second basis like its own, for residuals.
pub(crate) struct OnBasis<'a, const D: usize, B, T: Transfer<D>, M: Medium<D>> {
    pub body: Mpm<D, B, T, M, ScoreForce<'a, D>>,
    pub certificate: B,
}

impl<'a, const D: usize, B, T, M> Moving<'a, D> for OnBasis<'a, D, B, T, M>
where
    B: UniformBasis<D>,
    T: Transfer<D>,
    M: Medium<D, State = Memory>,
{
    fn particles(&mut self) -> &mut Cloud<D> {
        &mut self.body.particles
    }

    fn force(&mut self) -> &mut ScoreForce<'a, D> {
        &mut self.body.body_force
    }

    fn turn(&mut self, planned: &PlannedStep<D>) {
        if let Some(rotation) = &planned.rotation {
            self.body.basis.turn(rotation);
        }
    }

    fn step(&mut self, planned: &PlannedStep<D>) -> Result<StepReport, MpmError> {
        let point = self.body.basis.cell_point(&planned.origin, planned.spacing);
        self.body.basis.place(point, planned.spacing)?;
        self.body.body_force.stand_on(&planned.origin, planned.spacing);
        self.body.step(&planned.control)
    }

    fn order(&self) -> &[u32] {
        self.body.basis.schedule().order()
    }

    fn residual(&mut self, origin: &[f64; D], spacing: f64, scores: &[[f64; D]]) -> Result<Residual, MpmError> {
        residual_on(
            &mut self.certificate,
            &self.body.particles.positions,
            origin,
            spacing,
            scores,
        )
    }

    fn grid_densities(&mut self, spacing: f64) -> Result<Vec<f64>, MpmError> {
        self.certificate.place([0.0; D], spacing)?;
        let particles = &self.body.particles;
        grid_densities(&mut self.certificate, &particles.positions, &particles.masses)
    }

    fn storage_bytes(&self) -> usize {
        self.body.storage_bytes()
    }
}

/// [`Moving::residual`], which neither transfer nor medium matter to.
#[inline(never)]
fn residual_on<const D: usize, B: UniformBasis<D>>(
    certificate: &mut B,
    positions: &[[f64; D]],
    origin: &[f64; D],
    spacing: f64,
    scores: &[[f64; D]],
) -> Result<Residual, MpmError> {
    let point = certificate.cell_point(&origin.map(|c| (c + 0.5).fract()), spacing);
    certificate.place(point, spacing)?;
    galerkin_stein_residual(certificate, positions, scores)
}
