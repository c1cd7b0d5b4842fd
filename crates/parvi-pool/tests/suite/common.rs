//! Runs from the identity frame.

use std::ops::ControlFlow;

use parvi_pool::{Beginning, Pool, PoolError, PoolOptions, Report, explore};
use parvi_targets::{Frame, Target};

pub fn pool_of<const D: usize>(target: &dyn Target<D>, particles: usize, seed: u64) -> Result<Pool<D>, PoolError> {
    pool_with(target, particles, seed, &PoolOptions::default())
}

pub fn pool_with<const D: usize>(
    target: &dyn Target<D>,
    particles: usize,
    seed: u64,
    options: &PoolOptions,
) -> Result<Pool<D>, PoolError> {
    let go_on = &mut |_: &Report<'_>| ControlFlow::Continue(());
    let frame = Frame::identity();
    explore(
        target,
        Beginning::in_frame(&frame).with_seed(seed),
        particles,
        options,
        go_on,
    )
}
