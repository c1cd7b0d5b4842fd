//! Time per particle of a step on an unstructured mesh, and of the search for cells.

use std::time::Instant;

use mpm_core::{Basis, StepControl};
use mpm_mesh::{Gradient, SampleWeight, SimplexMesh};
use parvi_benches::arguments::Arguments;
use parvi_benches::mesh_block::{MeshBlock, block, cube, square};
use parvi_benches::processor_time::processor_time;
use parvi_benches::say;

fn least_and_middle(mut times: Vec<f64>) -> (f64, f64) {
    times.sort_by(f64::total_cmp);
    (times[0], times[times.len() / 2])
}

/// Particles that have moved by three tenths of the shortest edge, in changing directions, from the cells where they were.
fn search<const D: usize>(body: &MeshBlock<D>) {
    let (basis, h) = (&body.basis, body.basis.spacing());
    let step = 0.3 * h / (D as f64).sqrt();
    let sign = |k: usize| if k.is_multiple_of(2) { step } else { -step };
    let moved = body.particles.positions.iter().enumerate();
    let moved: Vec<[f64; D]> = moved
        .map(|(p, x)| std::array::from_fn(|a| x[a] + sign((p * 2_654_435_761) >> (7 + a))))
        .collect();
    let (mut rested, mut went, mut sum) = (Vec::new(), Vec::new(), 0u64);
    for _ in 0..20 {
        for (times, positions) in [(&mut rested, &body.particles.positions), (&mut went, &moved)] {
            let start = Instant::now();
            for (x, &cell) in positions.iter().zip(basis.particle_cells()) {
                sum += basis
                    .search()
                    .locate(x, Some(cell))
                    .map_or(0, |located| u64::from(located.cell));
            }
            times.push(start.elapsed().as_nanos() as f64 / positions.len() as f64);
        }
    }
    let (rested, went) = (least_and_middle(rested), least_and_middle(went));
    say(format_args!(
        "search: unmoved median {:.1} least {:.1}, moved by 0.3 h median {:.1} least {:.1} ns per particle ({sum})",
        rested.1, rested.0, went.1, went.0
    ));
}

/// The two halves of the rebuild, particles where a step has left them.
fn rebuild<const D: usize>(body: &mut MeshBlock<D>, control: &StepControl) {
    let count = body.particles.len() as f64;
    let (mut sort, mut activate) = (Vec::new(), Vec::new());
    for _ in 0..20 {
        body.step(control).expect("a sound state");
        let mut basis = body.basis.clone();
        let start = processor_time();
        basis.sort(&body.particles.positions).expect("inside");
        let middle = processor_time();
        if basis.schedule().keeps_order() {
            basis.activate(&body.particles.positions).expect("few nodes");
            activate.push((processor_time() - middle) / count);
        }
        sort.push((middle - start) / count);
    }
    let (sort, activate) = (least_and_middle(sort), least_and_middle(activate));
    say(format_args!(
        "rebuild: cells and order median {:.1} least {:.1}, nodes and weights median {:.1} least {:.1} ns per particle",
        sort.1, sort.0, activate.1, activate.0
    ));
}

fn time<const D: usize>(mesh: &SimplexMesh<D>, per_cell: usize, steps: usize, exact: bool) {
    let mut body = block(mesh, per_cell);
    if exact {
        let basis = body.basis.with_gradient(Gradient::Exact);
        body.basis = basis.with_sample_weight(SampleWeight::Smooth);
    }
    let count = body.particles.len() as f64;
    let control = StepControl {
        time_step: 1.0,
        courant: 0.4,
        displacement: f64::INFINITY,
        friction: 0.0,
    };
    let (mut wall, mut processor, mut sorts, mut runs) = (Vec::new(), Vec::new(), 0, 0);
    for step in 0..10 + steps {
        let (start, processor_start) = (Instant::now(), processor_time());
        body.step(&control).expect("a sound state");
        if step >= 10 {
            wall.push(start.elapsed().as_nanos() as f64 / count);
            processor.push((processor_time() - processor_start) / count);
            sorts += usize::from(!body.basis.schedule().keeps_order());
            runs += body.basis.schedule().cell_count();
        }
    }
    let (wall, processor) = (least_and_middle(wall), least_and_middle(processor));
    say(format_args!(
        "D = {D}, {} cells, {count} particles: median {:.1} least {:.1} ns per particle-step, processor median {:.1} least {:.1}; {sorts} sorts in {steps} steps, {:.3} cells per particle, largest ring {}",
        mesh.cell_count(),
        wall.1,
        wall.0,
        processor.1,
        processor.0,
        runs as f64 / count / steps as f64,
        body.basis.stencil_size(),
    ));
    search(&body);
    rebuild(&mut body, &control);
}

const USAGE: &str = "\
Time per particle of a step on a mesh of triangles (2) or tetrahedra (3), of the search for cells and of the rebuild; with
RAYON_NUM_THREADS=1 that of one thread.
usage: time_mesh [2|3] [edge of the cells] [particles per cell] [steps] [diffuse|exact]
       unless given: 2, edges of 0.0069 (2) or 0.0616 (3) of the block's, 5 particles, 40 steps, diffuse gradients";

fn main() {
    let arguments = Arguments::of_process(USAGE);
    let (per_cell, steps) = (arguments.number(2, 5), arguments.number(3, 40).max(1));
    let exact = match arguments.word(4, "diffuse") {
        "diffuse" => false,
        "exact" => true,
        other => arguments.refuse(other),
    };
    match arguments.word(0, "2") {
        "2" => time(&square(arguments.number(1, 0.0069)), per_cell, steps, exact),
        "3" => time(&cube(arguments.number(1, 0.0616)), per_cell, steps, exact),
        other => arguments.refuse(other),
    }
}
