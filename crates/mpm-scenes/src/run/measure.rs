//! A row of the time series.

use mpm_core::Particles;
use mpm_tensor::vector;

use super::budget::{self, Budget};
use super::energies::Energies;
use super::motion::Motion;
use super::probe::{AXES, Probe};
use crate::law::LawState;

/// Axes a, b of x_a v_b − x_b v_a, for every component of the angular momentum.
fn rotations<const D: usize>() -> &'static [(usize, usize)] {
    match D {
        2 => &[(0, 1)],
        3 => &[(1, 2), (2, 0), (0, 1)],
        _ => &[],
    }
}

fn axis_names<const D: usize>(name: &str) -> impl Iterator<Item = String> {
    AXES.iter().take(D).map(move |axis| format!("{name}_{axis}"))
}

/// The names of the columns, as [`Series`](crate::Series) lists them.
pub(super) fn columns<const D: usize>(
    motion: &dyn Motion<D>,
    probes: &[Probe<D>],
    budget: Option<&Budget>,
) -> Vec<String> {
    let mut columns = vec!["time".to_owned()];
    columns.extend(axis_names::<D>("centre"));
    columns.push("kinetic_energy".to_owned());
    if motion.is_affine() {
        columns.push("affine_energy".to_owned());
    }
    columns.extend(["strain_energy", "potential_energy"].map(str::to_owned));
    if motion.loads().barrier.is_some() {
        columns.push("barrier_energy".to_owned());
    }
    if budget.is_some() {
        columns.extend(budget::COLUMNS.map(str::to_owned));
    }
    columns.extend(axis_names::<D>("momentum"));
    match D {
        2 => columns.push("angular_momentum".to_owned()),
        3 => columns.extend(axis_names::<D>("angular_momentum")),
        _ => {}
    }
    for axis in AXES.iter().take(D) {
        columns.extend([format!("lower_{axis}"), format!("upper_{axis}")]);
    }
    for probe in probes {
        columns.extend(probe.columns());
    }
    columns.extend(budget.map(|_| budget::TRACTION_WORK.to_owned()));
    columns
}

/// The values of the columns now.
pub(super) fn row<const D: usize>(motion: &dyn Motion<D>, probes: &[Probe<D>], budget: Option<&Budget>) -> Vec<f64> {
    let particles = motion.particles();
    let sums = Sums::of(particles);
    let mut row = vec![motion.time()];
    row.extend(sums.moment.map(|c| c / sums.mass));
    let energies = Energies::of(motion);
    row.push(energies.kinetic);
    if motion.is_affine() {
        row.push(energies.affine);
    }
    row.extend([energies.strain, energies.potential]);
    if motion.loads().barrier.is_some() {
        row.push(energies.barrier);
    }
    if let Some(budget) = budget {
        row.extend(budget.row(motion, &energies));
    }
    row.extend(sums.momentum);
    row.extend(rotations::<D>().iter().map(|&pair| particles.angular_momentum(pair)));
    for a in 0..D {
        row.extend([sums.lower[a], sums.upper[a]]);
    }
    let places = places(particles);
    for probe in probes {
        row.extend(probe.measure(motion, &places));
    }
    row.extend(budget.map(|_| Budget::traction_work(motion)));
    row
}

/// Place of every particle in the present order, by its number.
fn places<const D: usize>(particles: &Particles<D, LawState>) -> Vec<usize> {
    let order: Vec<usize> = (0..particles.len()).collect();
    particles.in_creation_order(&order)
}

/// Σ m, Σ m x, Σ m v and the bounding box.
struct Sums<const D: usize> {
    mass: f64,
    moment: [f64; D],
    momentum: [f64; D],
    lower: [f64; D],
    upper: [f64; D],
}

impl<const D: usize> Sums<D> {
    fn of(particles: &Particles<D, LawState>) -> Self {
        let mut sums = Self {
            mass: 0.0,
            moment: [0.0; D],
            momentum: [0.0; D],
            lower: [f64::INFINITY; D],
            upper: [f64::NEG_INFINITY; D],
        };
        for (p, (x, v)) in particles.positions.iter().zip(&particles.velocities).enumerate() {
            let mass = particles.masses.get(p);
            sums.mass += mass;
            vector::accumulate(&mut sums.moment, mass, x);
            vector::accumulate(&mut sums.momentum, mass, v);
            for a in 0..D {
                sums.lower[a] = sums.lower[a].min(x[a]);
                sums.upper[a] = sums.upper[a].max(x[a]);
            }
        }
        sums
    }
}
