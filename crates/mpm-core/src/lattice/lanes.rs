//! Points side by side, so that the compiler works on several of them with one instruction.

/// Points in a group.
pub const LANES: usize = 4;

/// The points in groups; the last group is filled up with its last point.
#[inline(always)]
pub fn lanes<const D: usize>(points: &[[f64; D]]) -> impl Iterator<Item = [[f64; D]; LANES]> {
    points
        .chunks(LANES)
        .map(|group| match <[[f64; D]; LANES]>::try_from(group) {
            Ok(lanes) => lanes,
            Err(_) => std::array::from_fn(|l| group[l.min(group.len() - 1)]),
        })
}
