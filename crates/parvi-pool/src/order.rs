//! Points in an order in which near ones stand near.

/// Halves weighted points along their longest axis, in these units, and every half again.
pub(crate) fn near_together<const D: usize>(points: &mut [([f64; D], f64)], units: &[f64; D]) {
    if points.len() < 3 || D == 0 {
        return;
    }
    let extent = |axis: usize| {
        let (low, high) = points
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (x, _)| {
                (low.min(x[axis]), high.max(x[axis]))
            });
        (high - low) / units[axis]
    };
    let axis = (0..D).max_by(|&a, &b| extent(a).total_cmp(&extent(b))).unwrap_or(0);
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    let (low, high) = points.split_at_mut(middle);
    near_together(low, units);
    near_together(high, units);
}
