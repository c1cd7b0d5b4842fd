//! Which summits belong to one mode: those that a straight way without a deep valley connects.

use mpm_tensor::vector;

use super::density::{Density, Valued};

/// A valley is deep if log p falls by more than this below the lower end of the way.
const VALLEY: f64 = 3.0;

/// Points looked at along a way.
const STATIONS: usize = 6;

/// Members of a cluster that a summit is connected with at most, the nearest ones.
const NEIGHBOURS: usize = 3;

/// Clusters of summits, each with its highest first; the clusters too from the highest down.
pub(super) fn clusters<const D: usize>(
    density: &mut Density<'_, D>,
    mut summits: Vec<Valued<D>>,
) -> Vec<Vec<Valued<D>>> {
    summits.sort_by(|a, b| b.log_density.total_cmp(&a.log_density));
    let mut clusters: Vec<Vec<Valued<D>>> = Vec::new();
    for summit in summits {
        let joined: Vec<usize> = (0..clusters.len())
            .filter(|&k| reaches(density, &clusters[k], &summit))
            .collect();
        match joined.split_first() {
            None => clusters.push(vec![summit]),
            Some((&first, others)) => {
                for &other in others.iter().rev() {
                    let members = clusters.remove(other);
                    clusters[first].extend(members);
                }
                clusters[first].push(summit);
            }
        }
    }
    clusters
}

/// Whether the summit is connected with one of the nearest members of the cluster.
fn reaches<const D: usize>(density: &mut Density<'_, D>, cluster: &[Valued<D>], summit: &Valued<D>) -> bool {
    let mut near: Vec<&Valued<D>> = cluster.iter().collect();
    let distance = |other: &Valued<D>| vector::distance_squared(&other.point, &summit.point);
    near.sort_by(|a, b| distance(a).total_cmp(&distance(b)));
    near.iter()
        .take(NEIGHBOURS)
        .any(|member| connected(density, member, summit))
}

fn connected<const D: usize>(density: &mut Density<'_, D>, a: &Valued<D>, b: &Valued<D>) -> bool {
    let level = a.log_density.min(b.log_density) - VALLEY;
    let way = vector::subtract(&b.point, &a.point);
    (1..=STATIONS).all(|station| {
        let share = station as f64 / (STATIONS + 1) as f64;
        density.log_density(&vector::add_scaled(&a.point, share, &way)) >= level
    })
}

#[cfg(test)]
mod tests {
    use parvi_targets::{CatalogueTarget, Frame, GaussianMixture, Ring};

    use super::*;

    #[test]
    fn modes_apart_are_kept_apart_and_a_ring_is_one_piece() {
        let frame = Frame::identity();
        let mixture = GaussianMixture::<2>::three_far().unwrap();
        let mut density = Density::new(&mixture, &frame);
        let near_modes = mixture
            .modes()
            .iter()
            .flat_map(|mode| [-0.5, 0.0, 0.5].map(|offset| [mode.centre[0] + offset * mode.width, mode.centre[1]]));
        let summits: Vec<_> = near_modes.filter_map(|z| density.value(&z)).collect();
        assert_eq!(clusters(&mut density, summits).len(), 3);

        let ring = Ring::new(2.0, 0.2).unwrap();
        let mut density = Density::new(&ring, &frame);
        let around = (0..24).map(|k| f64::from(k) / 24.0 * std::f64::consts::TAU);
        let summits: Vec<_> = around
            .filter_map(|angle| density.value(&[2.0 * angle.cos(), 2.0 * angle.sin()]))
            .collect();
        assert_eq!(clusters(&mut density, summits).len(), 1);
    }
}
