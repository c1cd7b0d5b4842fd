//! The evidence of an earlier pool.

use parvi_targets::{Frame, Gaussian};

use crate::{Beginning, PoolOptions, explore};

#[test]
fn log_z_of_an_earlier_pool_is_kept_where_it_is_known_better_and_both_agree() {
    let frame = Frame::identity();
    let options = PoolOptions::default();
    let pool = explore(
        &Gaussian::<2>::standard(),
        Beginning::in_frame(&frame).with_seed(1),
        500,
        &options,
        &mut |_| std::ops::ControlFlow::Continue(()),
    )
    .expect("a pool");
    let (log, error) = (pool.log_evidence, pool.log_evidence_error);
    let kept = |earlier| {
        let kept = pool.clone().keeping(earlier);
        (kept.log_evidence, kept.log_evidence_error)
    };
    let near = (log + error, 0.5 * error);
    assert_eq!(kept(near), near);
    assert_eq!(kept((log + error, 2.0 * error)), (log, error));
    assert_eq!(kept((log + 10.0 * error, 0.5 * error)), (log, error));
    assert_eq!(kept((log, f64::NAN)), (log, error));
}
