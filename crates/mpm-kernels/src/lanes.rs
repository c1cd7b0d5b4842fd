//! Points side by side: one instruction works on several of them.

/// One component of each of [`LANES`] points.
pub type Lanes = wide::f64x4;

/// Points in a group.
pub const LANES: usize = 4;

/// The points in groups; the last group is filled up with its last point.
#[inline(always)]
pub fn groups<const D: usize>(points: &[[f64; D]]) -> impl Iterator<Item = [[f64; D]; LANES]> {
    points
        .chunks(LANES)
        .map(|group| match <[[f64; D]; LANES]>::try_from(group) {
            Ok(group) => group,
            Err(_) => std::array::from_fn(|l| group[l.min(group.len() - 1)]),
        })
}
