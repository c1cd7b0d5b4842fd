//! Γ at half integers.

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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_gamma_function_has_its_known_values() {
        assert!((log_gamma_of_half(10) - 24f64.ln()).abs() < 1e-13);
        assert!((log_gamma_of_half(5) - (0.75 * std::f64::consts::PI.sqrt()).ln()).abs() < 1e-13);
    }
}
