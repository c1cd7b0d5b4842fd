//! Counters of a fixed scene, so that no change of the grid or of the step goes unnoticed.

use mpm_core::{Apic, Basis, Mpm, Particles, Pic, SimplexLattice, SplineGrid, UniformBasis};
use mpm_kernels::Quadratic;
use mpm_materials::IsothermalGas;
use rand::RngExt;

use crate::scenes::{Pull, dot, free, gaussian_cloud, generator, neo_hookean};

#[derive(Debug, PartialEq)]
struct Counters {
    active_nodes: usize,
    /// Runs of particles in one tile or cell of the grid; particles are not sorted in every step.
    cells: usize,
    parts: usize,
    /// Mean of |x|², to nine digits.
    mean_square: String,
}

/// 2000 particles under the score of N(0, I), ten steps with a moving grid.
fn scene<const D: usize, B: UniformBasis<D>>(mut basis: B, h: f64) -> Counters {
    let count = 2000;
    let start = gaussian_cloud::<D>(count, 2024)
        .iter()
        .map(|x| x.map(|c| 0.6 * c + 0.7))
        .collect();
    basis.place([0.0; D], h).unwrap();
    let mut mpm = Mpm::new(
        Particles::at_rest(start, 1.0),
        basis,
        Pic,
        IsothermalGas::CALIBRATED,
        Pull::well(),
    );
    let mut control = free(0.4 * h);
    (control.displacement, control.friction, control.courant) = (0.5, 1.5, 1.0);
    for step in 0..10 {
        mpm.basis.place([0.618_033_988_75 * h * f64::from(step); D], h).unwrap();
        mpm.step(&control).unwrap();
    }
    let schedule = mpm.basis.schedule();
    let squares: f64 = mpm.particles.positions.iter().map(|x| dot(x, x)).sum();
    Counters {
        active_nodes: mpm.basis.node_count(),
        cells: schedule.cell_count(),
        parts: schedule.parts().len(),
        mean_square: format!("{:.8e}", squares / count as f64),
    }
}

#[test]
fn counters_are_those_committed() {
    let golden = |active_nodes, cells, parts, mean_square: &str| Counters {
        active_nodes,
        cells,
        parts,
        mean_square: mean_square.to_owned(),
    };
    let counted = [
        scene(grid::<1>(), 0.1),
        scene(grid::<2>(), 0.3),
        scene(grid::<3>(), 0.6),
        scene(grid::<6>(), 1.6),
        scene(lattice::<1>(), 0.1),
        scene(lattice::<2>(), 0.3),
        scene(lattice::<3>(), 0.6),
        scene(lattice::<6>(), 1.6),
    ];
    let committed = [
        golden(48, 2, 1, "8.73645522e-1"),
        golden(336, 10, 1, "1.92538171e0"),
        golden(1232, 30, 1, "2.95200131e0"),
        golden(26431, 573, 4, "5.53939865e0"),
        golden(46, 2000, 1, "8.73837599e-1"),
        golden(263, 2000, 1, "1.94596707e0"),
        golden(635, 2000, 1, "3.00356964e0"),
        golden(1540, 2000, 1, "5.47100052e0"),
    ];
    assert_eq!(counted, committed);
}

fn grid<const D: usize>() -> SplineGrid<Quadratic, 3, D> {
    SplineGrid::new([0.0; D], 1.0).unwrap()
}

fn lattice<const D: usize>() -> SimplexLattice<D> {
    SimplexLattice::permutohedral([0.0; D], 1.0).unwrap()
}

/// An elastic block that turns and is stretched, 30 steps of APIC: how often its particles are sorted, and how many tiles are looked up in
/// all. Both decide what a step costs, and show in no result.
#[test]
fn a_block_is_sorted_now_and_then() {
    let mut random = generator(8);
    let mut positions = Vec::new();
    for place in 0..16usize.pow(3) {
        let octant = [place / 256, place / 16 % 16, place % 16];
        positions.push(octant.map(|c| 0.5 * (c as f64 + random.random::<f64>())));
    }
    let count = positions.len();
    let mut particles = Particles::at_rest(positions, 0.125 * count as f64).with_elastic_state(vec![0.125; count]);
    for (x, v) in particles.positions.iter().zip(&mut particles.velocities) {
        let [x, y, z] = x.map(|c| 0.02 * (c - 4.0));
        *v = [0.2 * x - y, x - 0.2 * y, 0.1 * z];
    }
    let mut mpm = Mpm::new(particles, grid::<3>(), Apic, neo_hookean(1.0), Pull::none());
    let (mut sorts, mut cells) = (0, 0);
    for _ in 0..30 {
        mpm.step(&free(0.4)).unwrap();
        sorts += usize::from(!mpm.basis.schedule().keeps_order());
        cells += mpm.basis.schedule().cell_count();
    }
    assert_eq!((sorts, cells), (1, 976));
}
