use crate::GridNode;

/// Make the velocities of an outer and an inner node odd (or even) in each component about `velocity`: the inner one is
/// the mean û = (m₂ u₂ ∓ m₁ u₁) / (m₁ + m₂) of the relative velocities u, the outer one ∓û.
///
/// `masses` becomes that of the pair for both, so that a second wall sees the right weights in a corner.
pub fn mirror<const D: usize, N: GridNode<D>>(
    pair: [usize; 2],
    odd: &[bool; D],
    velocity: &[f64; D],
    masses: &mut [f64],
    nodes: &mut [N],
) {
    let [outer, inner] = pair;
    let (outer_mass, inner_mass) = (masses[outer], masses[inner]);
    let mass = outer_mass + inner_mass;
    if mass < f64::MIN_POSITIVE {
        return; // both rest
    }
    masses[outer] = mass;
    masses[inner] = mass;
    for a in 0..D {
        let sign = if odd[a] { -1.0 } else { 1.0 };
        let base = if odd[a] { velocity[a] } else { 0.0 };
        let relative = |number: usize| nodes[number].velocity()[a] - base;
        let mean = (inner_mass * relative(inner) + sign * outer_mass * relative(outer)) / mass;
        nodes[inner].velocity_mut()[a] = base + mean;
        nodes[outer].velocity_mut()[a] = base + sign * mean;
    }
}
