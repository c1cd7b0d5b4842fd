//! Steps of the sampler's gas in a Gaussian well, on a grid that moves in every step, for `benches/instructions.sh`.

use mpm_core::{BodyForce, ForceLocation, Mpm, MpmError, Particles, Pic, Sites, StepControl};
use mpm_core::{SimplexLattice, SplineGrid, UniformBasis};
use mpm_kernels::Quadratic;
use mpm_materials::IsothermalGas;
use parvi_benches::arguments::Arguments;
use rand::{RngExt, SeedableRng, rngs::ChaCha8Rng};

/// g = −x: the score of N(0, I).
struct Well;

impl<const D: usize> BodyForce<D> for Well {
    fn location(&self) -> ForceLocation {
        ForceLocation::Particles
    }

    fn at_particles(&mut self, sites: &Sites<D>, out: &mut [[f64; D]]) -> Result<(), MpmError> {
        for (x, g) in sites.positions.iter().zip(out) {
            *g = x.map(|c| -c);
        }
        Ok(())
    }
}

/// Particles at random in a cube of edge 4, about four in a cube of edge `h`.
fn run<B: UniformBasis<D>, const D: usize>(new: impl FnOnce(f64) -> Result<B, MpmError>, particles: usize, steps: u32) {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let positions: Vec<[f64; D]> = (0..particles)
        .map(|_| std::array::from_fn(|_| 4.0 * random.random::<f64>() - 2.0))
        .collect();
    let h = 4.0 * (4.0 / particles as f64).powf(1.0 / D as f64);
    let basis = new(h).expect("a spacing");
    let mut gas = Mpm::new(
        Particles::at_rest(positions, 1.0),
        basis,
        Pic,
        IsothermalGas::CALIBRATED,
        Well,
    );
    let control = StepControl {
        time_step: 0.1 * h,
        courant: f64::INFINITY,
        displacement: 0.5,
        friction: 1.5,
    };
    for step in 0..steps {
        let shift = (f64::from(step) * 0.618_033_988_749_894_9).fract() * h;
        gas.basis.place([shift; D], h).expect("finite");
        gas.step(&control).expect("a sound state");
    }
}

const USAGE: &str = "\
Steps of the sampler's gas in a Gaussian well, quietly: for counts of instructions.
usage: step_gas [grid2|grid3|lattice3|lattice8] [particles] [steps]
       unless given: lattice3, 10000 particles, 10 steps";

fn main() {
    let arguments = Arguments::of_process(USAGE);
    let (particles, steps) = (arguments.number(1, 10_000), arguments.number(2, 10));
    match arguments.word(0, "lattice3") {
        "grid2" => run(|h| SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], h), particles, steps),
        "grid3" => run(|h| SplineGrid::<Quadratic, 3, 3>::new([0.0; 3], h), particles, steps),
        "lattice3" => run(|h| SimplexLattice::<3>::permutohedral([0.0; 3], h), particles, steps),
        "lattice8" => run(|h| SimplexLattice::<8>::permutohedral([0.0; 8], h), particles, steps),
        other => arguments.refuse(other),
    }
}
