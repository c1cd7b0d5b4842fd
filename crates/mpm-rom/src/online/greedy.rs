//! Sample points chosen by what they get wrong.

use mpm_scenes::Kinematics;

use super::design::Design;
use super::samples::groups;
use super::{KnownPoints, OnlineError, Reading};

/// Rounds of exchanges after the greedy choice, at most.
const EXCHANGES: usize = 4;

/// Larger choices are not exchanged: a round costs as much as the choice.
const MOST_EXCHANGED: usize = 24;

/// `count` sample points that stand for all points best, ascending: a greedy choice on readings of training states, as that of sample nodes in GNAT (K. Carlberg, C. Farhat, J. Cortial,
/// D. Amsallem 2013, Algorithm 3), with five points or more on each kinematic region as [`SampleChoice::Drawn`](super::SampleChoice::Drawn) has;
/// points that readings do not know are taken only where a region has too few others.
///
/// A [`Reading`] has the velocities v_p of all N points that readings know after a step from the state s, and J_p = ∂g/∂x̂(X_p, x̂). Of all points together they make v̂ = argmin Σ|J_p v̂ − v_p|², of those in 𝒫
/// another rate, which differs by S_s⁻¹ b_s with S_s = Σ_{p ∈ 𝒫} J_pᵀ J_p, b_s = Σ_{p ∈ 𝒫} J_pᵀ e_p, e_p = v_p − J_p v̂. The points are those that make
///
/// Σ_s |S_s⁻¹ b_s|² + σ² tr S_s⁻¹
///
/// small, coordinates being scaled so that N⁻¹ Σ_p J_pᵀ J_p = I over all points: the mean square of the difference of all velocities, and that of independent errors of
/// size σ = 0.3 × the root mean square of e, which keeps the problem well conditioned (an A-optimal design). Each point is the one that lowers the sum most, the first of equals; then, up to 24 points, each is exchanged for the
/// one that lowers it most, until none does or after four rounds. Readings whose Jacobians do not tell the coordinates apart at all points are left out.
///
/// # Errors
/// [`OnlineError::TooFewSamples`], [`OnlineError::TooManySamples`], [`OnlineError::Readings`].
pub fn choose_greedily<const D: usize>(
    readings: &[Reading<D>],
    coordinates: usize,
    kinematics: &Kinematics<D>,
    known: &KnownPoints,
    count: usize,
) -> Result<Vec<u32>, OnlineError> {
    let points = known.points_of_body();
    let groups = groups(kinematics, points, coordinates, count)?;
    let mut design = Design::new(coordinates, known, readings)?;
    let mut chosen: Vec<(u32, usize)> = Vec::with_capacity(count);
    let mut free = vec![true; points];
    for (number, (members, share)) in groups.iter().enumerate() {
        for _ in 0..*share {
            let Some((point, _)) = design.best(members, &free) else {
                break;
            };
            design.change(point, 1.0);
            free[point as usize] = false;
            chosen.push((point, number));
        }
    }
    let rounds = if count <= MOST_EXCHANGED { EXCHANGES } else { 0 };
    for _ in 0..rounds {
        let mut changed = false;
        for (point, number) in &mut chosen {
            let before = design.objective();
            design.change(*point, -1.0);
            free[*point as usize] = true;
            let best = design.best(&groups[*number].0, &free);
            // Rounding alone must not move a point.
            let other = best.filter(|(_, objective)| *objective < before * (1.0 - 1e-9));
            let kept = other.map_or(*point, |(other, _)| other);
            changed |= kept != *point;
            *point = kept;
            design.change(kept, 1.0);
            free[kept as usize] = false;
        }
        if !changed {
            break;
        }
    }
    let mut numbers: Vec<u32> = chosen.into_iter().map(|(point, _)| point).collect();
    numbers.sort_unstable();
    Ok(numbers)
}

#[cfg(test)]
mod tests {
    use super::super::scaled_reading::tests::reading;
    use super::*;

    #[test]
    fn a_lever_without_errors_is_read_at_its_ends() {
        // g = y₀ + y₁ X on a line.
        let line: Vec<f64> = (-50..=50).map(f64::from).collect();
        let lever = Reading::<1> {
            jacobians: line.iter().flat_map(|&x| [[1.0], [x]]).collect(),
            velocities: line.iter().map(|&x| [0.3 - 0.2 * x]).collect(),
        };
        let chosen = choose_greedily(&[lever], 2, &Kinematics::default(), &KnownPoints::all(101), 4).expect("enough");
        assert_eq!(chosen, [0, 1, 99, 100]);
    }

    #[test]
    fn no_exchange_of_one_point_is_better() {
        let readings = [reading(30, 3, 0.37), reading(30, 3, 0.61)];
        let all = KnownPoints::all(30);
        let objective = |chosen: &[u32]| {
            let mut design = Design::new(3, &all, &readings).expect("of these points");
            chosen.iter().for_each(|&point| design.change(point, 1.0));
            design.objective()
        };
        let chosen = choose_greedily(&readings, 3, &Kinematics::default(), &all, 5).expect("enough");
        let least = objective(&chosen);
        for place in 0..5 {
            for other in (0..30).filter(|p| !chosen.contains(p)) {
                let mut instead = chosen.clone();
                instead[place] = other;
                assert!(least <= objective(&instead) * (1.0 + 1e-6), "{place}: {other}");
            }
        }
    }
}
