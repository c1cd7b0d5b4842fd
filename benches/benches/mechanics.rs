//! Time per particle of one step of an elastic block (quadratic B-splines, Neo-Hookean, d = 3): time step, rebuild and sorting
//! included.
//!
//! One thread unless `RAYON_NUM_THREADS` says otherwise. `src/bin/time_mechanics.rs` tells the median of few steps, without
//! building parvi.

mod support;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group};
use mpm_core::{Apic, Flip, Mls, Pic, Transfer};
use parvi_benches::elastic_block::{Order, block, control};

/// Cells per axis: 10⁶ particles.
const CELLS: usize = 50;

fn bench_transfer<T: Transfer<3>>(c: &mut Criterion, name: &str, transfer: T, order: Order) {
    let mut mpm = block(CELLS, order, transfer);
    for _ in 0..10 {
        mpm.step(&control()).expect("a sound state");
    }
    let mut group = c.benchmark_group("elastic block");
    group.sample_size(20);
    group.throughput(Throughput::Elements(mpm.particles.len() as u64));
    group.bench_function(
        BenchmarkId::new(format!("{name}, {order:?}"), mpm.particles.len()),
        |b| {
            b.iter(|| mpm.step(&control()).expect("a sound state"));
        },
    );
    group.finish();
}

fn benches(c: &mut Criterion) {
    bench_transfer(c, "APIC", Apic, Order::Sorted);
    bench_transfer(c, "APIC", Apic, Order::Shuffled);
    bench_transfer(c, "MLS", Mls, Order::Sorted);
    bench_transfer(c, "PIC", Pic, Order::Sorted);
    bench_transfer(c, "FLIP", Flip::blend(0.95), Order::Sorted);
}

fn main() {
    support::one_thread_unless_told();
    mechanics();
    Criterion::default().configure_from_args().final_summary();
}

criterion_group!(mechanics, benches);
