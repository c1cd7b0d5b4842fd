//! Exchanges of single sample points, the most promising first.

use mpm_scenes::Kinematics;

use super::design::Design;
use super::{KnownPoints, OnlineError, Reading};

/// Exchanges of one of these sample points for a point that is none of them: (p, q) puts q in the place of p. Points of kinematic regions stay, and points that readings do not know are not taken.
///
/// The sum that [`choose_greedily`](super::choose_greedily) makes small says which come first: the best one for each point, by their sums, then the second best for each, and so on.
///
/// # Errors
/// [`OnlineError::Readings`].
pub fn rank_exchanges<const D: usize>(
    readings: &[Reading<D>],
    coordinates: usize,
    kinematics: &Kinematics<D>,
    known: &KnownPoints,
    chosen: &[u32],
) -> Result<Vec<(u32, u32)>, OnlineError> {
    let mut design = Design::new(coordinates, known, readings)?;
    chosen.iter().for_each(|&point| design.change(point, 1.0));
    let regions = kinematics.regions();
    let is_free = |point: &u32| {
        !regions
            .iter()
            .any(|region| region.members.binary_search(&(*point as usize)).is_ok())
    };
    let others = (0..known.points_of_body() as u32).filter(|point| known.place(*point).is_some());
    let others: Vec<u32> = others
        .filter(|point| is_free(point) && !chosen.contains(point))
        .collect();
    let mut ranked: Vec<(usize, f64, (u32, u32))> = Vec::new();
    for &point in chosen.iter().filter(|point| is_free(point)) {
        design.change(point, -1.0);
        let objectives = design.with_each(&others).into_iter();
        design.change(point, 1.0);
        let mut own: Vec<(f64, u32)> = objectives.zip(others.iter().copied()).collect();
        own.sort_by(|a, b| a.0.total_cmp(&b.0));
        let own = own.into_iter().enumerate();
        ranked.extend(own.map(|(rank, (objective, other))| (rank, objective, (point, other))));
    }
    ranked.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)));
    Ok(ranked.into_iter().map(|(_, _, pair)| pair).collect())
}

#[cfg(test)]
mod tests {
    use super::super::scaled_reading::tests::reading;
    use super::*;

    #[test]
    fn the_best_exchange_of_each_point_comes_first() {
        let (readings, known) = ([reading(30, 3, 0.37), reading(30, 3, 0.61)], KnownPoints::all(30));
        let objective = |chosen: &[u32]| {
            let mut design = Design::new(3, &known, &readings).expect("of these points");
            chosen.iter().for_each(|&point| design.change(point, 1.0));
            design.objective()
        };
        let chosen = [2, 9, 17, 28];
        let ranked = rank_exchanges(&readings, 3, &Kinematics::default(), &known, &chosen).expect("of these points");
        assert_eq!(ranked.len(), 4 * 26);
        let after = |(from, to): (u32, u32)| objective(&chosen.map(|point| if point == from { to } else { point }));
        let first: Vec<f64> = ranked[..4].iter().map(|&pair| after(pair)).collect();
        assert!(
            first.windows(2).all(|pair| pair[0] <= pair[1] * (1.0 + 1e-9)),
            "{first:?}"
        );
        for (&(from, to), least) in ranked[..4].iter().zip(&first) {
            assert!(!chosen.contains(&to));
            let others = (0..30).filter(|other| !chosen.contains(other));
            let best = others.map(|other| after((from, other))).fold(f64::INFINITY, f64::min);
            assert!((least / best - 1.0).abs() < 1e-6, "{from}: {least} {best}");
        }
    }
}
