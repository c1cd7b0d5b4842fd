//! Sample points chosen by what they get wrong.

use faer::Mat;
use faer::linalg::solvers::Solve;
use mpm_scenes::Kinematics;
use mpm_tensor::{Matrix, vector};
use rayon::prelude::*;

use super::samples::groups;
use super::scaled_reading::ScaledReading;
use super::{KnownPoints, OnlineError, Reading};

/// What every S_s begins with, times the identity: small against what a mean point adds to its trace, r.
const START: f64 = 1e-6;

/// σ over the root mean square of the components of e: the part of the velocities' errors that readings do not foretell.
pub(super) const UNFORESEEN: f64 = 0.3;

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

/// The sums over the points chosen so far.
struct Design<'a, const D: usize> {
    coordinates: usize,
    known: &'a KnownPoints,
    states: Vec<State<D>>,
    /// σ².
    unforeseen: f64,
}

/// One reading, and what the points chosen so far make of it.
struct State<const D: usize> {
    reading: ScaledReading<D>,
    /// S, row-major, and b.
    information: Vec<f64>,
    right: Vec<f64>,
    /// S⁻¹, S⁻¹ b and tr S⁻¹.
    inverse: Vec<f64>,
    difference: Vec<f64>,
    trace: f64,
}

impl<'a, const D: usize> Design<'a, D> {
    fn new(coordinates: usize, known: &'a KnownPoints, readings: &[Reading<D>]) -> Result<Self, OnlineError> {
        let scaled = ScaledReading::all(coordinates, known.numbers().len(), readings)?;
        let mean_square = scaled.iter().map(|reading| reading.mean_square).sum::<f64>() / scaled.len().max(1) as f64;
        Ok(Self {
            coordinates,
            known,
            states: scaled
                .into_par_iter()
                .map(|reading| State::new(coordinates, reading))
                .collect(),
            unforeseen: UNFORESEEN * UNFORESEEN * mean_square,
        })
    }

    fn objective(&self) -> f64 {
        let states = self.states.iter();
        states
            .map(|state| squared(&state.difference) + self.unforeseen * state.trace)
            .sum()
    }

    /// The free point among these that makes the objective least, with it: one that readings know where there is one.
    fn best(&self, members: &[u32], free: &[bool]) -> Option<(u32, f64)> {
        let candidates: Vec<u32> = members.iter().copied().filter(|&p| free[p as usize]).collect();
        let objectives: Vec<f64> = candidates
            .par_iter()
            .map(|&point| {
                let states = self.states.iter();
                match self.known.place(point) {
                    Some(place) => states.map(|state| state.with(place, self.unforeseen)).sum(),
                    None => f64::INFINITY,
                }
            })
            .collect();
        let pairs = candidates.into_iter().zip(objectives);
        pairs.reduce(|best, next| if next.1 < best.1 { next } else { best })
    }

    /// Adds a point to the sums, or takes it out.
    fn change(&mut self, point: u32, sign: f64) {
        let r = self.coordinates;
        let Some(point) = self.known.place(point) else {
            return;
        };
        self.states.par_iter_mut().for_each(|state| {
            let rows = &state.reading.columns[point * r..(point + 1) * r];
            for (n, entry) in state.information.iter_mut().enumerate() {
                *entry += sign * vector::dot(&rows[n / r], &rows[n % r]);
            }
            for (row, entry) in rows.iter().zip(&mut state.right) {
                *entry += sign * vector::dot(row, &state.reading.errors[point]);
            }
            state.solve();
        });
    }
}

impl<const D: usize> State<D> {
    fn new(r: usize, reading: ScaledReading<D>) -> Self {
        let mut state = Self {
            reading,
            information: (0..r * r).map(|n| if n % (r + 1) == 0 { START } else { 0.0 }).collect(),
            right: vec![0.0; r],
            inverse: Vec::new(),
            difference: Vec::new(),
            trace: 0.0,
        };
        state.solve();
        state
    }

    fn solve(&mut self) {
        let r = self.right.len();
        let matrix = Mat::from_fn(r, r, |i, j| self.information[i * r + j]);
        let inverse = matrix.partial_piv_lu().solve(&Mat::<f64>::identity(r, r));
        self.inverse = (0..r * r).map(|n| inverse[(n / r, n % r)]).collect();
        let rows = self.inverse.chunks_exact(r.max(1));
        self.difference = rows
            .map(|row| row.iter().zip(&self.right).map(|(a, b)| a * b).sum())
            .collect();
        self.trace = (0..r).map(|k| self.inverse[k * r + k]).sum();
    }

    /// |S⁻¹ b|² + σ² tr S⁻¹ with one more point: with W = J S⁻¹, K = I + W Jᵀ and y = S⁻¹ b + Wᵀ e they become |y − Wᵀ K⁻¹ J y|² and
    /// tr S⁻¹ − tr K⁻¹ W Wᵀ.
    fn with(&self, point: usize, unforeseen: f64) -> f64 {
        let r = self.right.len();
        let rows = &self.reading.columns[point * r..(point + 1) * r];
        let product = |k: usize| {
            let mut column = [0.0; D];
            for (row, entry) in rows.iter().zip(&self.inverse[k * r..(k + 1) * r]) {
                vector::accumulate(&mut column, *entry, row);
            }
            column
        };
        let (mut within, mut squares, mut seen) = (Matrix::<D>::IDENTITY, Matrix::<D>::ZERO, [0.0; D]);
        for k in 0..r {
            let column = product(k);
            within += Matrix::outer(&column, &rows[k]);
            squares += Matrix::outer(&column, &column);
            let moved = self.difference[k] + vector::dot(&column, &self.reading.errors[point]);
            vector::accumulate(&mut seen, moved, &rows[k]);
        }
        let Some(inverse) = within.inverse() else {
            return f64::INFINITY;
        };
        let pulled = inverse.apply(&seen);
        let mut sum = unforeseen * (self.trace - (inverse * squares).trace());
        for k in 0..r {
            let column = product(k);
            let moved = self.difference[k] + vector::dot(&column, &self.reading.errors[point]);
            sum += (moved - vector::dot(&column, &pulled)).powi(2);
        }
        sum
    }
}

fn squared(list: &[f64]) -> f64 {
    list.iter().map(|value| value * value).sum()
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

    #[test]
    fn the_objective_foretells_the_difference_of_the_rates() {
        use crate::least_squares::LeastSquares;
        let reading = reading(40, 3, 0.23);
        let known = KnownPoints::all(40);
        let mut design = Design::new(3, &known, std::slice::from_ref(&reading)).expect("of these points");
        let chosen = [3, 14, 15, 26, 35];
        chosen.iter().for_each(|&point| design.change(point, 1.0));
        let solve = |numbers: &[usize]| {
            let rows: Vec<_> = numbers
                .iter()
                .flat_map(|&p| reading.jacobians[3 * p..3 * p + 3].to_vec())
                .collect();
            let targets: Vec<_> = numbers.iter().map(|&p| reading.velocities[p]).collect();
            let mut rates = vec![0.0; 3];
            LeastSquares::default()
                .solve(&rows, &targets, &mut rates)
                .expect("of full rank");
            rates
        };
        let few = chosen.map(|p| p as usize);
        let (all, few) = (solve(&(0..40).collect::<Vec<_>>()), solve(&few));
        let mut mean = 0.0;
        for rows in reading.jacobians.chunks(3) {
            let mut gap = [0.0; 2];
            (0..3).for_each(|k| vector::accumulate(&mut gap, few[k] - all[k], &rows[k]));
            mean += vector::norm_squared(&gap) / 40.0;
        }
        let found = squared(&design.states[0].difference);
        assert!((found - mean).abs() < 1e-4 * mean, "{found} {mean}");
        // And one more point is what it becomes.
        let foretold = design.states[0].with(20, design.unforeseen);
        design.change(20, 1.0);
        assert!((foretold / design.objective() - 1.0).abs() < 1e-6);
    }
}
