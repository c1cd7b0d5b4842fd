//! Points in an order in which near ones stand near.

/// Halves weighted points along their longest axis, in these units, and every half again.
pub(crate) fn near_together<const D: usize>(points: &mut [([f64; D], f64)], units: &[f64; D]) {
    if points.len() < 3 || D == 0 {
        return;
    }
    let extents: [f64; D] = std::array::from_fn(|axis| {
        let (low, high) = extent(points.iter().map(|(x, _)| x[axis]));
        (high - low) / units[axis]
    });
    let axis = (0..D).max_by(|&a, &b| extents[a].total_cmp(&extents[b])).unwrap_or(0);
    let middle = points.len() / 2;
    points.select_nth_unstable_by(middle, |a, b| a.0[axis].total_cmp(&b.0[axis]));
    let (low, high) = points.split_at_mut(middle);
    near_together(low, units);
    near_together(high, units);
}

/// Numbers of which the least and the largest are looked for side by side: one after the other each would wait for the last.
const SIDE_BY_SIDE: usize = 8;

/// The least and the largest of some numbers; NaN is neither.
#[inline(always)]
pub(crate) fn extent(mut numbers: impl ExactSizeIterator<Item = f64>) -> (f64, f64) {
    let (mut low, mut high) = ([f64::INFINITY; SIDE_BY_SIDE], [f64::NEG_INFINITY; SIDE_BY_SIDE]);
    for _ in 0..numbers.len().div_ceil(SIDE_BY_SIDE) {
        for lane in 0..SIDE_BY_SIDE {
            let number = numbers.next().unwrap_or(f64::NAN);
            (low[lane], high[lane]) = (low[lane].min(number), high[lane].max(number));
        }
    }
    let least = low.into_iter().fold(f64::INFINITY, f64::min);
    (least, high.into_iter().fold(f64::NEG_INFINITY, f64::max))
}
