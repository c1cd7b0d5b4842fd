//! Γ at half integers, and quantiles of Γ(m, 1) for integer shapes.

use parvi_targets::normal_quantile;

/// log Γ(n/2), n ≥ 1, by Γ(x + 1) = x Γ(x) from Γ(1/2) = √π or Γ(1) = 1.
pub(super) fn log_gamma_of_half(n: u32) -> f64 {
    let (mut sum, mut x) = if n % 2 == 1 {
        (0.5 * std::f64::consts::PI.ln(), 0.5)
    } else {
        (0.0, 1.0)
    };
    while x < 0.5 * f64::from(n) {
        sum += x.ln();
        x += 1.0;
    }
    sum
}

/// Quantiles of Γ(m, 1).
pub(super) struct GammaQuantile {
    m: u32,
    /// log (m − 1)! and log m!.
    log_factorials: [f64; 2],
}

impl GammaQuantile {
    /// For the shape m ≥ 1.
    pub fn new(m: u32) -> Self {
        Self {
            m,
            log_factorials: [log_gamma_of_half(2 * m), log_gamma_of_half(2 * m + 2)],
        }
    }

    /// The root x of 1 − e^{−x} Σ_{j<m} x^j/j! = u, by Newton steps in log x from the approximation of Wilson and Hilferty.
    pub fn at(&self, u: f64) -> f64 {
        let shape = f64::from(self.m);
        let cube_root = 1.0 - 1.0 / (9.0 * shape) + normal_quantile(u) / (3.0 * shape.sqrt());
        let mut x = if cube_root > 0.3 {
            shape * cube_root.powi(3)
        } else {
            // In the far lower tail P ≈ x^m / m!.
            ((u.ln() + self.log_factorials[1]) / shape).exp()
        };
        for _ in 0..30 {
            // The smaller of the two tails, which keeps its digits.
            let (tail, wanted, sign) = if u > 0.5 {
                (self.upper_tail(x), 1.0 - u, 1.0)
            } else {
                (self.lower_tail(x), u, -1.0)
            };
            // Newton in (log tail, log x): d log tail / d log x = ∓ x p(x) / tail.
            let density = (shape * x.ln() - x - self.log_factorials[0]).exp();
            let step = sign * (tail / wanted).ln() * tail / density;
            if !step.is_finite() {
                break;
            }
            x *= step.clamp(-1.0, 1.0).exp();
            // The next step would be of the order of its square.
            if step.abs() < 1e-7 {
                break;
            }
        }
        x
    }

    /// e^{−x} Σ_{j<m} x^j/j!.
    fn upper_tail(&self, x: f64) -> f64 {
        let (mut term, mut sum) = ((-x).exp(), 0.0);
        for j in 0..self.m {
            sum += term;
            term *= x / f64::from(j + 1);
        }
        sum
    }

    /// e^{−x} Σ_{j≥m} x^j/j!.
    fn lower_tail(&self, x: f64) -> f64 {
        let rest = 1.0 - self.upper_tail(x);
        if rest > 1e-3 {
            return rest;
        }
        let mut term = (f64::from(self.m) * x.ln() - x - self.log_factorials[1]).exp();
        let mut sum = 0.0;
        let mut j = f64::from(self.m);
        while term > 1e-17 * sum && j < 1000.0 {
            sum += term;
            j += 1.0;
            term *= x / j;
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_invert_the_distribution_function() {
        for m in [1, 2, 4, 8, 15] {
            let quantile = GammaQuantile::new(m);
            for u in [
                1e-12,
                1e-5,
                9e-4,
                0.0011,
                0.01,
                0.3,
                0.5,
                0.500_001,
                0.9,
                0.999,
                1.0 - 1e-10,
            ] {
                let x = quantile.at(u);
                let back = if u > 0.5 {
                    1.0 - quantile.upper_tail(x)
                } else {
                    quantile.lower_tail(x)
                };
                assert!((back - u).abs() <= 1e-11 * u, "{m} {u}: {x} {back}");
            }
        }
        assert!((GammaQuantile::new(1).at(0.3) + 0.7_f64.ln()).abs() < 1e-13);
    }

    #[test]
    fn the_gamma_function_has_its_known_values() {
        assert!((log_gamma_of_half(10) - 24f64.ln()).abs() < 1e-13);
        assert!((log_gamma_of_half(5) - (0.75 * std::f64::consts::PI.sqrt()).ln()).abs() < 1e-13);
    }
}
