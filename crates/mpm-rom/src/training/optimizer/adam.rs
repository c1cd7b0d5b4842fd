//! Adam (D. P. Kingma, J. Ba 2015, Algorithm 1).

const FIRST_DECAY: f64 = 0.9;
const SECOND_DECAY: f64 = 0.999;
const SMALLEST: f64 = 1e-8;

/// m ← β₁ m + (1 − β₁) g, s ← β₂ s + (1 − β₂) g², θ ← θ − rate · m̂ / (√ŝ + ε) with m̂ = m / (1 − β₁ᵗ), ŝ = s / (1 − β₂ᵗ), β₁ = 0.9,
/// β₂ = 0.999, ε = 1e-8.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::training) struct Adam {
    /// m.
    first: Vec<f64>,
    /// s.
    second: Vec<f64>,
}

impl Adam {
    pub fn new(parameters: usize) -> Self {
        Self {
            first: vec![0.0; parameters],
            second: vec![0.0; parameters],
        }
    }

    /// What to add to θ in step t, counted from 1.
    pub fn change(&mut self, gradient: &[f64], rate: f64, step: u64) -> Vec<f64> {
        let power = step as f64;
        let first_scale = 1.0 / (1.0 - FIRST_DECAY.powf(power));
        let second_scale = 1.0 / (1.0 - SECOND_DECAY.powf(power));
        let moments = self.first.iter_mut().zip(&mut self.second);
        let change = |(gradient, (first, second)): (&f64, (&mut f64, &mut f64))| {
            *first = FIRST_DECAY * *first + (1.0 - FIRST_DECAY) * gradient;
            *second = SECOND_DECAY * *second + (1.0 - SECOND_DECAY) * gradient * gradient;
            -rate * (*first * first_scale) / ((*second * second_scale).sqrt() + SMALLEST)
        };
        gradient.iter().zip(moments).map(change).collect()
    }

    /// m and s.
    pub fn numbers(&mut self) -> impl Iterator<Item = &mut f64> {
        self.first.iter_mut().chain(&mut self.second)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_step_is_the_rate_against_the_sign() {
        let change = Adam::new(3).change(&[5.0, -1e-3, 0.0], 0.1, 1);
        assert!((change[0] + 0.1).abs() < 1e-8);
        assert!((change[1] - 0.1).abs() < 1e-5);
        assert_eq!(change[2], 0.0);
    }

    #[test]
    fn a_quadratic_is_minimised() {
        let (mut parameters, mut adam) = ([3.0, -2.0], Adam::new(2));
        for step in 1..=10_000 {
            let gradient = [2.0 * (parameters[0] - 1.0), 200.0 * parameters[1]];
            let change = adam.change(&gradient, 1e-2 * 0.999f64.powi(step - 1), step as u64);
            parameters = [parameters[0] + change[0], parameters[1] + change[1]];
        }
        assert!(
            (parameters[0] - 1.0).abs() < 1e-3 && parameters[1].abs() < 1e-3,
            "{parameters:?}"
        );
    }
}
