//! Simplices that make up a prism.

/// The D simplices of the prism between a facet of D vertices and its copy: (s₀ … s_j, s′_j … s′_{D−1}) for each j, s′ being
/// the copy of s. Vertices are in the order of their numbers: of the two diagonals of a side each prism takes the one from the
/// smaller number below to the larger above, so neighbours agree.
///
/// `positive` says whether (s₀ … s_{D−1}, s′_{D−1}) is a positively oriented cell.
pub fn prism_cells<const D: usize>(facet: &[u32; D], copy: &[u32; D], positive: bool) -> Vec<u32> {
    let mut cells = Vec::with_capacity(D * (D + 1));
    for j in 0..D {
        let start = cells.len();
        cells.extend(&facet[..=j]);
        cells.extend(&copy[j..]);
        // Each step of j moves one vertex past the copies: an exchange.
        if positive != (D - 1 - j).is_multiple_of(2) {
            cells.swap(start, start + 1);
        }
    }
    cells
}
