use mpm_tensor::vector;

use super::Plane;
use crate::GridNode;

/// Make the velocities of an outer and an inner node images of each other: with relative velocities u and the reflection R u = −u at a wall that holds, R u =
/// u − 2 (n·u) n at one that lets slide, the inner one becomes û = (m₂ u₂ + m₁ R u₁) / (m₁ + m₂), the outer one R û.
///
/// `masses` becomes that of the pair for both, so that a second wall sees the right weights in a corner.
pub fn mirror<const D: usize, N: GridNode<D>>(plane: &Plane<D>, pair: [usize; 2], masses: &mut [f64], nodes: &mut [N]) {
    let [outer, inner] = pair;
    let (outer_mass, inner_mass) = (masses[outer], masses[inner]);
    let mass = outer_mass + inner_mass;
    if mass.abs() < f64::MIN_POSITIVE {
        return; // both rest; negative weights make negative masses
    }
    masses[outer] = mass;
    masses[inner] = mass;
    let reflect = |u: &[f64; D]| plane.reflect_relative(u);
    let relative = |number: usize| vector::subtract(nodes[number].velocity(), &plane.velocity);
    let (own, image) = (relative(inner), reflect(&relative(outer)));
    let mean: [f64; D] = std::array::from_fn(|a| (inner_mass * own[a] + outer_mass * image[a]) / mass);
    *nodes[inner].velocity_mut() = vector::add(&plane.velocity, &mean);
    *nodes[outer].velocity_mut() = vector::add(&plane.velocity, &reflect(&mean));
}
