//! Adam (D. P. Kingma, J. Ba 2015, Algorithm 1).

const FIRST_DECAY: f64 = 0.9;
const SECOND_DECAY: f64 = 0.999;
const SMALLEST: f64 = 1e-8;

/// m ← β₁ m + (1 − β₁) g, s ← β₂ s + (1 − β₂) g², θ ← θ − rate · m̂ / (√ŝ + ε) with m̂ = m / (1 − β₁ᵗ), ŝ = s / (1 − β₂ᵗ), β₁ = 0.9,
/// β₂ = 0.999, ε = 1e-8.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Adam {
    /// m.
    pub first: Vec<f64>,
    /// s.
    pub second: Vec<f64>,
    /// t, steps taken.
    pub steps: u64,
}

impl Adam {
    pub fn new(parameters: usize) -> Self {
        Self {
            first: vec![0.0; parameters],
            second: vec![0.0; parameters],
            steps: 0,
        }
    }

    /// One step; `parameters` yields θ in the order of `gradient`.
    pub fn step<'a>(&mut self, parameters: impl Iterator<Item = &'a mut f64>, gradient: &[f64], rate: f64) {
        self.steps += 1;
        let power = self.steps as f64;
        let (first_scale, second_scale) = (
            1.0 / (1.0 - FIRST_DECAY.powf(power)),
            1.0 / (1.0 - SECOND_DECAY.powf(power)),
        );
        let moments = self.first.iter_mut().zip(&mut self.second);
        for ((parameter, gradient), (first, second)) in parameters.zip(gradient).zip(moments) {
            *first = FIRST_DECAY * *first + (1.0 - FIRST_DECAY) * gradient;
            *second = SECOND_DECAY * *second + (1.0 - SECOND_DECAY) * gradient * gradient;
            *parameter -= rate * (*first * first_scale) / ((*second * second_scale).sqrt() + SMALLEST);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_step_is_the_rate_against_the_sign() {
        let mut parameters = [1.0, 2.0, 3.0];
        Adam::new(3).step(parameters.iter_mut(), &[5.0, -1e-3, 0.0], 0.1);
        assert!((parameters[0] - 0.9).abs() < 1e-8);
        assert!((parameters[1] - 2.1).abs() < 1e-5);
        assert_eq!(parameters[2], 3.0);
    }

    #[test]
    fn a_quadratic_is_minimised() {
        let (mut parameters, mut adam) = ([3.0, -2.0], Adam::new(2));
        for n in 0..10_000 {
            let gradient = [2.0 * (parameters[0] - 1.0), 200.0 * parameters[1]];
            adam.step(parameters.iter_mut(), &gradient, 1e-2 * 0.999f64.powi(n));
        }
        assert!(
            (parameters[0] - 1.0).abs() < 1e-3 && parameters[1].abs() < 1e-3,
            "{parameters:?}"
        );
    }
}
