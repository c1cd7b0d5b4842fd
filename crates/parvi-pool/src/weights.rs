//! Importance weights: effective sizes, tempering, systematic resampling.

/// Weights proportional to exp(γ l), the largest being one; 0 where l is NaN or −∞. All zero if nothing is finite.
pub(super) fn tempered(logs: &[f64], gamma: f64) -> Vec<f64> {
    let top = top(logs);
    let weight = |l: &f64| if l.is_finite() { (gamma * (l - top)).exp() } else { 0.0 };
    logs.iter().map(weight).collect()
}

/// The largest finite one, or −∞.
pub(super) fn top(logs: &[f64]) -> f64 {
    let finite = logs.iter().copied().filter(|l| l.is_finite());
    finite.fold(f64::NEG_INFINITY, f64::max)
}

/// (Σ w)² / Σ w², Kish's effective size; 0 without weight.
pub(super) fn effective_size(weights: &[f64]) -> f64 {
    let (mut sum, mut squares) = (0.0, 0.0);
    for w in weights {
        sum += w;
        squares += w * w;
    }
    if squares > 0.0 { sum * sum / squares } else { 0.0 }
}

/// The largest γ ≤ 1 at which the weights exp(γ l) have this effective size, by bisection; 0 where even equal ones have not.
pub(super) fn tempering(logs: &[f64], size: f64) -> f64 {
    if effective_size(&tempered(logs, 1.0)) >= size {
        return 1.0;
    }
    let (mut low, mut high) = (0.0_f64, 1.0_f64);
    for _ in 0..40 {
        let middle: f64 = if low > 0.0 && low < 0.01 * high {
            (low * high).sqrt()
        } else {
            0.5 * (low + high)
        };
        if effective_size(&tempered(logs, middle)) >= size {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// `count` indices by systematic resampling: index i appears ⌊count w_i⌋ or ⌈count w_i⌉ times; `offset` in [0, 1).
pub(super) fn systematic(weights: &[f64], count: usize, offset: f64) -> Vec<usize> {
    let total: f64 = weights.iter().sum();
    let mut chosen = Vec::with_capacity(count);
    if !(total > 0.0 && total.is_finite()) {
        return chosen;
    }
    let mut sum = 0.0;
    for (index, w) in weights.iter().enumerate() {
        sum += w;
        while chosen.len() < count && (chosen.len() as f64 + offset) * total < sum * count as f64 {
            chosen.push(index);
        }
    }
    // Rounding may leave the last one out.
    while let Some(&last) = chosen.last()
        && chosen.len() < count
    {
        chosen.push(last);
    }
    chosen
}

/// Indices in order, each with the number of times that it is there.
pub(super) fn runs(indices: Vec<usize>) -> Vec<(usize, f64)> {
    let equal = indices.chunk_by(|a, b| a == b);
    equal.map(|run| (run[0], run.len() as f64)).collect()
}
