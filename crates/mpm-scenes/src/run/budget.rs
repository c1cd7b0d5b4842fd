//! The energy budget of a run: what has become of the energy that it began with.

use mpm_core::EnergyBudget;
use mpm_tensor::vector;

use super::energies::Energies;
use super::motion::Motion;
use crate::Kinematics;

/// What the columns of the budget follow from, beside the present energies.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Budget {
    /// Kinetic energy at t = 0, the affine part with it, and what prescribed motions of particles have added.
    kinetic: f64,
    /// Energy of the barrier at t = 0, and what they have added to that.
    barrier: f64,
    /// The work of prescribed motions: what particles gain of kinetic energy, height and nearness to a barrier when they are put where their motion has them.
    prescribed: f64,
    /// The work of all forces on particles that have no potential in the series.
    loads: f64,
    /// What an explicit barrier has stored more than the work of its forces along the motion.
    barrier_integration: f64,
}

/// The names of its columns. Dissipations and works are those since t = 0; `energy_balance` is constant but for what plastic laws dissipate, and what is of second order in the step where they do.
pub(super) const COLUMNS: [&str; 9] = [
    "transfer_dissipation",
    "friction_dissipation",
    "contact_dissipation",
    "damping_dissipation",
    "viscous_dissipation",
    "time_integration_dissipation",
    "boundary_work",
    "load_work",
    "energy_balance",
];

/// A column more, behind all others: the part of `boundary_work` that tractions on facets do.
pub(super) const TRACTION_WORK: &str = "traction_work";

/// Numbers in a checkpoint: those of the nodes, then those of the run.
pub(super) type Saved = [f64; 13];

impl Budget {
    /// At t = 0.
    pub fn begin<const D: usize>(motion: &mut dyn Motion<D>) -> Self {
        *motion.energy_budget_mut() = Some(EnergyBudget::default());
        let energies = Energies::of(motion);
        Self {
            kinetic: energies.kinetic + energies.affine,
            barrier: energies.barrier,
            ..Self::default()
        }
    }

    /// The values of its columns.
    pub fn row<const D: usize>(&self, motion: &dyn Motion<D>, now: &Energies) -> [f64; COLUMNS.len()] {
        let nodes = motion.energy_budget().unwrap_or_default();
        let transfer = self.kinetic + nodes.sum() - (now.kinetic + now.affine);
        let barrier = motion.loads().barrier.as_ref();
        let contact = match barrier.filter(|barrier| barrier.implicit) {
            Some(_) => self.barrier - nodes.contact - now.barrier,
            None => 0.0,
        };
        let (friction, damping) = (0.0 - nodes.friction, 0.0 - nodes.damping);
        let boundary = nodes.boundary + self.prescribed;
        let integration = nodes.time_integration - self.barrier_integration;
        let dissipated = transfer + friction + contact + damping + nodes.viscous + integration;
        let total = now.sum() + dissipated - boundary - self.loads;
        [
            transfer,
            friction,
            contact,
            damping,
            nodes.viscous,
            integration,
            boundary,
            self.loads,
            total,
        ]
    }

    /// The value of the column behind all others.
    pub fn traction_work<const D: usize>(motion: &dyn Motion<D>) -> f64 {
        motion.energy_budget().unwrap_or_default().node_forces
    }

    /// One step by `step`, with the work of the loads in it.
    pub fn over_step<const D: usize, E>(
        &mut self,
        motion: &mut dyn Motion<D>,
        step: impl FnOnce(&mut dyn Motion<D>) -> Result<(), E>,
    ) -> Result<(), E> {
        let loads = motion.loads();
        if !loads.has_more_than_potentials() && !loads.has_explicit_barrier() {
            return step(motion);
        }
        let (time, before) = (motion.time(), in_creation_order(motion));
        step(motion)?;
        let (loads, after) = (motion.loads(), in_creation_order(motion));
        self.loads += loads.work_beside_potentials(time, &before, &after);
        self.barrier_integration += loads.barrier_stored_beyond_work(&before, &after);
        Ok(())
    }

    /// The prescribed motion of particles, with its work.
    pub fn over_prescription<const D: usize>(
        &mut self,
        motion: &mut dyn Motion<D>,
        kinematics: &Kinematics<D>,
        reference: &[[f64; D]],
    ) {
        if kinematics.regions().is_empty() {
            return;
        }
        let energies = |motion: &dyn Motion<D>| {
            let (particles, loads) = (motion.particles(), motion.loads());
            let heights = loads.gravity_energy(particles);
            [particles.kinetic_energy(), loads.barrier_energy(particles), heights]
        };
        let before = energies(motion);
        motion.prescribe(kinematics, reference);
        let [kinetic, barrier, heights] = vector::subtract(&energies(motion), &before);
        self.kinetic += kinetic;
        self.barrier += barrier;
        self.prescribed += kinetic + barrier + heights;
    }

    /// As a checkpoint keeps it.
    pub fn save<const D: usize>(&self, motion: &dyn Motion<D>) -> Saved {
        let nodes = motion.energy_budget().unwrap_or_default();
        [
            nodes.forces,
            nodes.damping,
            nodes.contact,
            nodes.friction,
            nodes.boundary,
            nodes.node_forces,
            nodes.viscous,
            nodes.time_integration,
            self.kinetic,
            self.barrier,
            self.prescribed,
            self.loads,
            self.barrier_integration,
        ]
    }

    /// As it was saved.
    pub fn restore<const D: usize>(saved: &Saved, motion: &mut dyn Motion<D>) -> Self {
        let [
            forces,
            damping,
            contact,
            friction,
            boundary,
            node_forces,
            viscous,
            time_integration,
            kinetic,
            barrier,
            prescribed,
            loads,
            barrier_integration,
        ] = *saved;
        *motion.energy_budget_mut() = Some(EnergyBudget {
            forces,
            damping,
            contact,
            friction,
            boundary,
            node_forces,
            viscous,
            time_integration,
        });
        Self {
            kinetic,
            barrier,
            prescribed,
            loads,
            barrier_integration,
        }
    }
}

fn in_creation_order<const D: usize>(motion: &dyn Motion<D>) -> Vec<[f64; D]> {
    motion.particles().in_creation_order(&motion.particles().positions)
}
