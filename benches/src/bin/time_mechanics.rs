//! Median time per particle-step of an elastic block.

use std::time::Instant;

use mpm_core::{Apic, Basis, Flip, Mls, Pic, Transfer};
use parvi_benches::arguments::Arguments;
use parvi_benches::elastic_block::{Order, block, control};
use parvi_benches::processor_time::processor_time;
use parvi_benches::say;

fn time<T: Transfer<3>>(transfer: T, order: Order, [cells, warm_up, steps]: [usize; 3]) {
    let mut mpm = block(cells, order, transfer);
    let particles = mpm.particles.len() as f64;
    let (mut wall, mut processor, mut sorts, mut runs) = (Vec::new(), Vec::new(), 0, 0);
    for step in 0..warm_up + steps {
        let (start, processor_start) = (Instant::now(), processor_time());
        mpm.step(&control()).expect("a sound state");
        if step >= warm_up {
            wall.push(start.elapsed().as_nanos() as f64 / particles);
            processor.push((processor_time() - processor_start) / particles);
            sorts += usize::from(!mpm.basis.schedule().keeps_order());
            runs += mpm.basis.schedule().cell_count();
        }
    }
    let mean = wall.iter().sum::<f64>() / steps as f64;
    let middle = |times: &mut Vec<f64>| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    };
    say(format_args!(
        "{order:?}, {cells}^3 cells: median {:.1} mean {mean:.1} least {:.1} ns per particle-step, processor {:.1}; {sorts} sorts in {steps} steps, {:.3} cells per particle",
        middle(&mut wall),
        wall[0],
        middle(&mut processor),
        runs as f64 / particles / steps as f64,
    ));
}

const USAGE: &str = "\
Median time per particle-step of an elastic block of 8 particles per cell; with RAYON_NUM_THREADS=1 that of one thread.
usage: time_mechanics [apic|mls|pic|flip] [sorted|shuffled] [cells per edge] [warm-up steps] [steps]
       unless given: apic, sorted, 50 cells, 10 and 20 steps";

fn main() {
    let arguments = Arguments::of_process(USAGE);
    let order = match arguments.word(1, "sorted") {
        "sorted" => Order::Sorted,
        "shuffled" => Order::Shuffled,
        other => arguments.refuse(other),
    };
    let sizes = [
        arguments.number(2, 50),
        arguments.number(3, 10),
        arguments.number(4, 20).max(1),
    ];
    match arguments.word(0, "apic") {
        "apic" => time(Apic, order, sizes),
        "mls" => time(Mls, order, sizes),
        "pic" => time(Pic, order, sizes),
        "flip" => time(Flip::blend(0.95), order, sizes),
        other => arguments.refuse(other),
    }
}
