use std::ops::Range;

use mpm_materials::Law;
use mpm_tensor::Matrix;

use super::{Medium, StressWork};
use crate::largest::larger_or_nan;
use crate::{MpmError, Particles};

/// A continuum with a constitutive law: τ_p from F_p, internal variables and, for laws that depend on it, the velocity
/// gradient.
#[derive(Clone, Copy, Debug)]
pub struct Continuum<L> {
    /// The constitutive law.
    pub law: L,
}

/// Particles of one piece of work.
const CHUNK: usize = 1 << 12;

/// Share of an energy that rounding may change.
const ROUNDING: f64 = 1e-9;

/// Particles that a law is asked for at once.
const GROUP: usize = 32;

impl<L> Continuum<L> {
    /// The largest wave speed c of the particles of a range.
    fn largest_wave_speed<const D: usize>(&self, particles: &Particles<D, L::State>, range: Range<usize>) -> f64
    where
        L: Law<D>,
    {
        let (mut densities, mut speeds) = ([0.0; GROUP], [0.0; GROUP]);
        let mut largest = 0.0;
        let mut start = range.start;
        while start < range.end {
            let group = start..range.end.min(start + GROUP);
            let (densities, speeds) = (&mut densities[..group.len()], &mut speeds[..group.len()]);
            for (density, particle) in densities.iter_mut().zip(group.clone()) {
                *density = self.density(particles, particle);
            }
            let (deformations, states) = (&particles.deformation_gradients, &particles.states);
            self.law
                .wave_speeds(&deformations[group.clone()], &states[group.clone()], densities, speeds);
            for (&speed, density) in speeds.iter().zip(densities.iter()) {
                // Without a volume nothing is stiff, and any step would do.
                largest = larger_or_nan(largest, if density.is_finite() { speed } else { f64::NAN });
            }
            start = group.end;
        }
        largest
    }

    /// m_p / V⁰_p.
    #[inline(always)]
    fn density<const D: usize>(&self, particles: &Particles<D, L::State>, particle: usize) -> f64
    where
        L: Law<D>,
    {
        particles.masses.get(particle) / particles.reference_volumes[particle]
    }

    /// Why a particle has no finite wave speed.
    fn fault<const D: usize>(&self, particles: &Particles<D, L::State>, particle: usize) -> MpmError
    where
        L: Law<D>,
    {
        match self.law.check(&particles.deformation_gradients[particle]) {
            Err(source) => MpmError::Deformation { particle, source },
            Ok(()) => MpmError::WaveSpeed {
                particle,
                wave_speed: self.largest_wave_speed(particles, particle..particle + 1),
                mass: particles.masses.get(particle),
                reference_volume: particles.reference_volumes[particle],
            },
        }
    }
}

impl<const D: usize, L: Law<D>> Medium<D> for Continuum<L> {
    type Impulse = Matrix<D>;
    type State = L::State;
    const DEFORMS: bool = true;

    fn rate_dependent(&self) -> bool {
        self.law.rate_dependent()
    }

    #[inline]
    fn impulse(&self, particles: &Particles<D, L::State>, particle: usize, time_step: f64) -> Matrix<D> {
        let rate = particles.velocity_gradients.get(particle).unwrap_or(&Matrix::ZERO);
        let (deformation, state) = (&particles.deformation_gradients[particle], &particles.states[particle]);
        let stress = self.law.kirchhoff_stress(deformation, state, rate);
        stress * (-time_step * particles.reference_volumes[particle])
    }

    fn impulses(
        &self,
        particles: &Particles<D, L::State>,
        range: Range<usize>,
        time_step: f64,
        impulses: &mut Vec<Matrix<D>>,
    ) {
        impulses.resize(range.len(), Matrix::ZERO);
        let rates = particles.velocity_gradients.get(range.clone()).unwrap_or(&[]);
        let (deformations, states) = (&particles.deformation_gradients, &particles.states);
        self.law
            .kirchhoff_stresses(&deformations[range.clone()], &states[range.clone()], rates, impulses);
        for (impulse, volume) in impulses.iter_mut().zip(&particles.reference_volumes[range]) {
            *impulse *= -time_step * volume;
        }
    }

    #[inline]
    fn advance(&self, trial: &Matrix<D>, state: &mut L::State) -> Matrix<D> {
        self.law.advance(trial, state)
    }

    #[inline(never)]
    fn stress_work(
        &self,
        [from, to]: [&Matrix<D>; 2],
        way: &Matrix<D>,
        state: &L::State,
        velocity_gradient: &Matrix<D>,
    ) -> StressWork {
        let stored = self.law.energy_density(to, state) - self.law.energy_density(from, state);
        let work = self.law.kirchhoff_stress(from, state, velocity_gradient).contract(way);
        if !self.law.rate_dependent() {
            return StressWork {
                stored_beyond: stored - work,
                viscous: 0.0,
            };
        }
        let at_rest = self.law.kirchhoff_stress(from, state, &Matrix::ZERO).contract(way);
        StressWork {
            stored_beyond: stored - at_rest,
            viscous: work - at_rest,
        }
    }

    #[inline(never)]
    fn yields(&self, deformations: [&Matrix<D>; 2], state: &L::State) -> bool {
        let [trial, kept] = deformations.map(|deformation| self.law.energy_density(deformation, state));
        trial - kept > ROUNDING * trial.abs()
    }

    #[inline]
    fn volume_ratio(&self, deformation_gradient: &Matrix<D>, state: &L::State) -> f64 {
        self.law.volume_ratio(deformation_gradient, state)
    }

    /// A law gives a wave speed that is not finite wherever it has no stress, so the check costs nothing.
    fn wave_speed(&self, particles: &Particles<D, L::State>) -> Result<f64, MpmError> {
        let range = |chunk: usize| chunk * CHUNK..particles.len().min((chunk + 1) * CHUNK);
        let of_chunk = |chunk| self.largest_wave_speed(particles, range(chunk));
        let chunks = mpm_parallel::map(0..particles.len().div_ceil(CHUNK), &of_chunk);
        let largest = chunks.into_iter().fold(0.0, larger_or_nan);
        if largest.is_finite() {
            return Ok(largest);
        }
        let finite = |p: usize| self.largest_wave_speed(particles, p..p + 1).is_finite();
        let at_fault = (0..particles.len()).find(|&particle| !finite(particle));
        at_fault.map_or(Ok(0.0), |particle| Err(self.fault(particles, particle)))
    }
}
