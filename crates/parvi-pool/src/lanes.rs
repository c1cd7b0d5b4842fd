//! Points in groups of eight, axis by axis, so that one instruction serves several of them.

/// Points per group.
pub(super) const LANES: usize = 8;

/// One coordinate or value of the points of a group.
pub(super) type Lanes = [f64; LANES];

/// The points of a group: `group[axis][lane]`.
pub(super) type Group<const D: usize> = [Lanes; D];

/// Points in groups; the last group is filled up with copies of its first point.
pub(super) fn packed<const D: usize>(points: &[[f64; D]]) -> Vec<Group<D>> {
    points
        .chunks(LANES)
        .map(|chunk| {
            let at = |lane: usize| &chunk[if lane < chunk.len() { lane } else { 0 }];
            std::array::from_fn(|axis| std::array::from_fn(|lane| at(lane)[axis]))
        })
        .collect()
}
