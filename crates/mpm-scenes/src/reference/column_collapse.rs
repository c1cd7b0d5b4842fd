//! Run-out of collapsing columns of grains (Lube, Huppert, Sparks & Freundt 2005; Lajeunesse, Monnier & Homsy 2005).

use super::power_law::{PowerLaw, fit};
use crate::ValidationRow;

/// Run-outs (a, (d_∞ − d₀)/d₀) of columns of base d₀ and height a d₀ on a plane, after they have come to rest.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RunOuts(pub Vec<(f64, f64)>);

impl RunOuts {
    /// Low columns, a < 1.8: in the experiments the run-out grows as a.
    pub fn low(&self) -> Option<PowerLaw> {
        fit(&self.select(|aspect| aspect < 1.8))
    }

    /// Tall columns, a > 5: in the experiments the run-out grows as a^(2/3).
    pub fn tall(&self) -> Option<PowerLaw> {
        fit(&self.select(|aspect| aspect > 5.0))
    }

    fn select(&self, keep: impl Fn(f64) -> bool) -> Vec<(f64, f64)> {
        self.0.iter().copied().filter(|&(aspect, _)| keep(aspect)).collect()
    }

    /// Exponents 1 ± 0.1 and 2/3 ± 0.15.
    pub fn checks(&self) -> Vec<ValidationRow> {
        let exponent = |law: Option<PowerLaw>| law.map_or(f64::NAN, |law| law.exponent);
        vec![
            ValidationRow::near("exponent of the run-out, a < 1.8", exponent(self.low()), 1.0, 0.1),
            ValidationRow::near("exponent of the run-out, a > 5", exponent(self.tall()), 2.0 / 3.0, 0.15),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::RunOuts;

    #[test]
    fn both_regimes_are_told_apart() {
        let aspects = [0.5, 0.75, 1.0, 1.5, 3.0, 6.0, 10.0, 20.0];
        let law = |a: f64| if a < 1.8 { 1.2 * a } else { 1.9 * a.powf(2.0 / 3.0) };
        let run_outs = RunOuts(aspects.map(|a| (a, law(a))).to_vec());
        assert!((run_outs.low().expect("four points").factor - 1.2).abs() < 1e-12);
        assert!((run_outs.tall().expect("three points").factor - 1.9).abs() < 1e-12);
        assert!(run_outs.checks().iter().all(|check| check.passes()));
        assert!(!RunOuts::default().checks().iter().any(|check| check.passes()));
    }
}
