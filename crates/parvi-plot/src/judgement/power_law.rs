//! A power law over a range, as the run-out of collapsing columns has it (Lube, Huppert, Sparks & Freundt 2005; Lajeunesse, Monnier & Homsy
//! 2005).

use super::{MeasuredSeries, Verdict};
use crate::exponent_text;
use crate::page::MISSING;
use crate::statistics::{PowerLaw, fit_power_law};

/// The law through the points with `from` ≤ x ≤ `to`; `None` with fewer than two, or values that are not positive.
pub fn fit(series: &MeasuredSeries, range: (Option<f64>, Option<f64>)) -> Option<PowerLaw> {
    let pairs = series.pairs().into_iter();
    let (x, y): (Vec<f64>, Vec<f64>) = pairs.filter(|&(x, _)| within(range, x)).unzip();
    fit_power_law(&x, &y).ok()
}

/// Whether an x is in a range, which may lack ends.
pub fn within((from, to): (Option<f64>, Option<f64>), x: f64) -> bool {
    from.is_none_or(|from| x >= from) && to.is_none_or(|to| x <= to)
}

/// Whether the exponent is within the tolerance; its 95 % interval (Student's t) is told beside it.
pub fn judge(series: &MeasuredSeries, (asked, tolerance): (f64, f64), range: (Option<f64>, Option<f64>)) -> Verdict {
    let law = fit(series, range);
    let exponent = law.as_ref().and_then(|law| law.exponents.first());
    let deviation = exponent.map_or(f64::INFINITY, |exponent| (exponent.value - asked).abs());
    let inside = exponent
        .and_then(|exponent| exponent.half_width)
        .is_some_and(|half| deviation + half <= tolerance);
    let reached = law.as_ref().map_or(MISSING.to_owned(), |law| {
        let where_ = if inside { "within" } else { "not within" };
        format!(
            "{} (95 %, {} points), interval {where_} the tolerance",
            exponent_text(law, 0),
            law.count
        )
    });
    Verdict {
        of: series.name(),
        asked: format!("exponent {asked:.3} ± {tolerance}"),
        reached,
        pass: deviation <= tolerance,
    }
}

#[cfg(test)]
mod tests {
    use super::super::through;
    use super::*;

    const ASPECTS: [f64; 8] = [0.5, 0.75, 1.0, 1.5, 3.0, 6.0, 10.0, 20.0];

    #[test]
    fn both_regimes_are_told_apart() {
        let law = |a: f64| if a < 1.8 { 1.2 * a } else { 1.9 * a.powf(2.0 / 3.0) };
        let series = through(&ASPECTS.map(|a| (a, law(a))));
        let low = fit(&series, (None, Some(1.8))).unwrap();
        let tall = fit(&series, (Some(5.0), None)).unwrap();
        assert!((low.prefactor - 1.2).abs() < 1e-12 && (tall.prefactor - 1.9).abs() < 1e-12);
        assert_eq!((low.count, tall.count), (4, 3));
        let verdict = judge(&series, (2.0 / 3.0, 0.15), (Some(5.0), None));
        assert!(
            verdict.pass && verdict.reached.contains("interval within"),
            "{verdict:?}"
        );
        assert!(!judge(&series, (1.0, 0.1), (Some(5.0), None)).pass);
    }

    /// By hand: x = e⁰, e¹, e², y = e⁰, e², e¹ has the slope ½ and the interval ± 11.0.
    #[test]
    fn a_wide_interval_is_told() {
        let e = 1f64.exp();
        let verdict = judge(
            &through(&[(1.0, 1.0), (e, e * e), (e * e, e)]),
            (0.5, 0.1),
            (None, None),
        );
        assert!(verdict.pass && verdict.reached.contains("not within"), "{verdict:?}");
    }

    #[test]
    fn nothing_to_fit_does_not_pass() {
        assert!(!judge(&through(&[(1.0, 1.0)]), (0.0, 1e9), (None, None)).pass);
    }
}
