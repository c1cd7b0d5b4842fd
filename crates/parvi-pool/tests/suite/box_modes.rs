//! Four symmetric modes in a box, far beyond which log p falls to -1e9.

use parvi_pool::Objection;
use parvi_targets::Target;

use crate::common::pool_of;

/// Four observations N((θ₁, θ₂), S), S of standard deviations θ₃², θ₄² and correlation tanh θ₅, under a uniform law on (−3, 3)⁵; x = logit((θ + 3)/6).
///
/// G. Papamakarios, D. Sterratt, I. Murray, *Sequential neural likelihood*, AISTATS 2019.
struct BoxModes([[f64; 2]; 4]);

impl BoxModes {
    fn some() -> Self {
        Self([[1.5, 1.52], [0.85, 1.44], [2.75, 1.42], [-8.35, 1.4]])
    }
}

impl Target<5> for BoxModes {
    fn log_density(&self, x: &[f64; 5]) -> f64 {
        let jacobian: f64 = x.iter().map(|z| -z.abs() - 2.0 * (-z.abs()).exp().ln_1p()).sum();
        let theta = x.map(|z| 6.0 / (1.0 + (-z).exp()) - 3.0);
        let (one, other) = (theta[2].powi(2), theta[3].powi(2));
        let free = 1.0 / theta[4].cosh().powi(2);
        let square = |y: &[f64; 2]| {
            let (a, b) = ((y[0] - theta[0]) / one, (y[1] - theta[1]) / other);
            (a * a - 2.0 * theta[4].tanh() * a * b + b * b) / free
        };
        let squares: f64 = self.0.iter().map(square).sum();
        jacobian - 0.5 * squares - 4.0 * (one.ln() + other.ln() + 0.5 * free.ln() + std::f64::consts::TAU.ln())
    }

    fn score(&self, x: &[f64; 5]) -> [f64; 5] {
        std::array::from_fn(|axis| {
            let at = |step: f64| {
                let mut y = *x;
                y[axis] += step;
                self.log_density(&y)
            };
            (at(1e-5) - at(-1e-5)) / 2e-5
        })
    }
}

#[test]
fn symmetric_modes_in_a_box_are_weighed_alike_by_every_seed() {
    let pools = [1, 2].map(|seed| pool_of(&BoxModes::some(), 500, seed).unwrap());
    for pool in &pools {
        assert!(pool.verdict.effective_share > 0.2, "{pool:?}");
        // In coordinates of the box a deviation has a long tail, of whose second moment too little may be known.
        let objection = pool.objection(500);
        let is_sound = matches!(objection, None | Some(Objection::Hanging { .. }));
        assert!(is_sound, "{objection:?} {pool:?}");
        let positive = pool.expectation(|x| f64::from(x[2] > 0.0));
        assert!((positive.value - 0.5).abs() < 0.05, "{positive:?}");
    }
    let apart = pools[0].log_evidence - pools[1].log_evidence;
    let error = pools[0].log_evidence_error.hypot(pools[1].log_evidence_error);
    assert!(apart.abs() < 4.0 * error, "{apart} {error}");
}
