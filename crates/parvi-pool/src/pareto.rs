//! Pareto k̂: how heavy the tail of the weights is.

/// The shape k̂ of the generalised Pareto law that fits the largest min(N/5, 3√N), rounded up, of the weights: below 0.5 their variance is finite, above 0.7 no estimate that
/// rests on them is to be relied on.
///
/// J. Zhang, M. A. Stephens, *A new and efficient estimation method for the generalized Pareto distribution*, Technometrics 51, 2009, with the weak prior of
/// A. Vehtari, D. Simpson, A. Gelman, Y. Yao, J. Gabry, *Pareto smoothed importance sampling*, JMLR 25, 2024, App. C. `None` for fewer than five
/// weights in the tail, or a tail whose smallest quarter equals the largest weight below it, as zeros do where less than that much of the tail has any weight.
pub fn pareto_k(weights: &[f64]) -> Option<f64> {
    let n = weights.len();
    let tail = n.div_ceil(5).min((3.0 * (n as f64).sqrt()).ceil() as usize);
    if tail < 5 {
        return None;
    }
    let mut sorted: Vec<f64> = weights.iter().copied().filter(|w| w.is_finite()).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let cut = *sorted.get(sorted.len().checked_sub(tail + 1)?)?;
    let excess: Vec<f64> = sorted[sorted.len() - tail..].iter().map(|w| w - cut).collect();
    let (largest, quartile) = (excess[tail - 1], excess[(tail as f64 / 4.0 + 0.5) as usize - 1]);
    if !(largest > 0.0 && quartile > 0.0) {
        return None;
    }
    let m = 30 + (tail as f64).sqrt() as usize;
    let count = tail as f64;
    let shape = |theta: f64| excess.iter().map(|x| (-theta * x).ln_1p()).sum::<f64>() / count;
    let thetas: Vec<f64> = (1..=m)
        .map(|j| 1.0 / largest + (1.0 - (m as f64 / (j as f64 - 0.5)).sqrt()) / (3.0 * quartile))
        .collect();
    let profile: Vec<f64> = thetas
        .iter()
        .map(|&theta| {
            let k = shape(theta);
            count * ((-theta / k).ln() - k - 1.0)
        })
        .collect();
    let mean = (0..m)
        .map(|j| {
            let others: f64 = profile.iter().map(|l| (l - profile[j]).exp()).sum();
            thetas[j] / others
        })
        .filter(|term| term.is_finite())
        .sum::<f64>();
    let k = (shape(mean) * count + 10.0 * 0.5) / (count + 10.0);
    k.is_finite().then_some(k)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn known_tails_have_their_shape() {
        // Quantiles of the Pareto law with P(w > t) = t^{−1/k}.
        for k in [0.2, 0.5, 0.7, 1.0] {
            let weights: Vec<f64> = (0..20_000)
                .map(|i| ((f64::from(i) + 0.5) / 20_000.0).powf(-k))
                .collect();
            let found = pareto_k(&weights).unwrap();
            assert!((found - k).abs() < 0.08, "{found} for {k}");
        }
    }

    #[test]
    fn equal_weights_have_no_tail() {
        assert_eq!(pareto_k(&[1.0; 100]), None);
        assert_eq!(pareto_k(&[1.0, 2.0, 3.0]), None);
        assert_eq!(pareto_k(&[f64::NAN; 100]), None);
    }
}
