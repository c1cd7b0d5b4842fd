//! The sums over sample points that a greedy choice makes small.

use mpm_dense::DenseMatrix;
use mpm_kernels::{LANES, Lanes};
use mpm_tensor::vector;
use rayon::prelude::*;

use super::scaled_reading::ScaledReading;
use super::{KnownPoints, OnlineError, Reading};

/// What every S_s begins with, times the identity: small against what a mean point adds to its trace, r.
const START: f64 = 1e-6;

/// σ over the root mean square of the components of e: the part of the velocities' errors that readings do not foretell.
pub(super) const UNFORESEEN: f64 = 0.3;

/// Candidates that are worked on by one thread in one go.
const TOGETHER: usize = 64;

/// The sums over the points chosen so far.
pub(super) struct Design<'a, const D: usize> {
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
    pub fn new(coordinates: usize, known: &'a KnownPoints, readings: &[Reading<D>]) -> Result<Self, OnlineError> {
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

    pub fn objective(&self) -> f64 {
        let states = self.states.iter();
        states
            .map(|state| squared(&state.difference) + self.unforeseen * state.trace)
            .sum()
    }

    /// The free point among these that makes the objective least, with it: one that readings know where there is one.
    pub fn best(&self, members: &[u32], free: &[bool]) -> Option<(u32, f64)> {
        let candidates: Vec<u32> = members.iter().copied().filter(|&p| free[p as usize]).collect();
        let objectives = self.with_each(&candidates);
        let pairs = candidates.into_iter().zip(objectives);
        pairs.reduce(|best, next| if next.1 < best.1 { next } else { best })
    }

    /// The objective with one more point, for each of these; infinite for those that readings do not know.
    pub fn with_each(&self, candidates: &[u32]) -> Vec<f64> {
        let objectives = candidates
            .par_chunks(TOGETHER)
            .flat_map_iter(|some| self.with_some(some));
        objectives.collect()
    }

    fn with_some(&self, candidates: &[u32]) -> Vec<f64> {
        let places: Vec<Option<usize>> = candidates.iter().map(|&point| self.known.place(point)).collect();
        let group = |some: &[Option<usize>]| std::array::from_fn(|l| some.get(l).copied().flatten().unwrap_or(0));
        let groups: Vec<[usize; LANES]> = places.chunks(LANES).map(group).collect();
        let (mut sums, mut columns) = (vec![Lanes::ZERO; groups.len()], Vec::new());
        // Every state serves all candidates while it is at hand.
        for state in &self.states {
            for (sum, group) in sums.iter_mut().zip(&groups) {
                *sum += state.with(group, self.unforeseen, &mut columns);
            }
        }
        let sums = sums.iter().flat_map(|sum| sum.to_array());
        let known = places.iter().zip(sums);
        let objective = |(place, sum): (&Option<usize>, f64)| match place {
            Some(_) if sum.is_finite() => sum,
            _ => f64::INFINITY,
        };
        known.map(objective).collect()
    }

    /// Adds a point to the sums, or takes it out.
    pub fn change(&mut self, point: u32, sign: f64) {
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
        let inverse = DenseMatrix::from_fn(r, r, |i, j| self.information[i * r + j]).inverse();
        self.inverse = (0..r * r).map(|n| inverse[(n / r, n % r)]).collect();
        let rows = self.inverse.chunks_exact(r.max(1));
        self.difference = rows
            .map(|row| row.iter().zip(&self.right).map(|(a, b)| a * b).sum())
            .collect();
        self.trace = (0..r).map(|k| self.inverse[k * r + k]).sum();
    }

    /// |S⁻¹ b|² + σ² tr S⁻¹ with one more point, for several of them: with W = J S⁻¹, L Lᵀ = I + W Jᵀ, Z = L⁻¹ W and y = S⁻¹ b + Wᵀ e these become |y − Zᵀ L⁻¹ J y|² and
    /// tr S⁻¹ − |Z|².
    fn with(&self, points: &[usize; LANES], unforeseen: f64, columns: &mut Vec<Column<D>>) -> Lanes {
        let r = self.right.len();
        let reading = &self.reading;
        let error: [Lanes; D] = std::array::from_fn(|a| Lanes::from(points.map(|p| reading.errors[p][a])));
        columns.clear();
        columns.extend((0..r).map(|k| Column {
            jacobian: std::array::from_fn(|a| Lanes::from(points.map(|p| reading.columns[p * r + k][a]))),
            weighted: [Lanes::ZERO; D],
            moved: Lanes::ZERO,
        }));
        let (mut within, mut seen) = (identity::<D>(), [Lanes::ZERO; D]);
        for k in 0..r {
            let mut weighted = [Lanes::ZERO; D];
            for (column, entry) in columns.iter().zip(&self.inverse[k * r..(k + 1) * r]) {
                accumulate(&mut weighted, Lanes::splat(*entry), &column.jacobian);
            }
            let moved = Lanes::splat(self.difference[k]) + dot(&weighted, &error);
            let column = &mut columns[k];
            for (row, entry) in within.iter_mut().zip(weighted) {
                accumulate(row, entry, &column.jacobian);
            }
            accumulate(&mut seen, moved, &column.jacobian);
            (column.weighted, column.moved) = (weighted, moved);
        }
        cholesky(&mut within);
        let pulled = forward(&within, &seen);
        let mut sum = Lanes::splat(unforeseen * self.trace);
        for Column { weighted, moved, .. } in &*columns {
            let z = forward(&within, weighted);
            let gap = *moved - dot(&z, &pulled);
            sum += gap * gap - dot(&z, &z) * unforeseen;
        }
        sum
    }
}

/// What one coordinate has to do with several points.
struct Column<const D: usize> {
    /// The column of J, that of W, and the entry of y.
    jacobian: [Lanes; D],
    weighted: [Lanes; D],
    moved: Lanes,
}

fn identity<const D: usize>() -> [[Lanes; D]; D] {
    std::array::from_fn(|a| std::array::from_fn(|b| if a == b { Lanes::ONE } else { Lanes::ZERO }))
}

fn accumulate<const D: usize>(sum: &mut [Lanes; D], factor: Lanes, vector: &[Lanes; D]) {
    for (entry, other) in sum.iter_mut().zip(vector) {
        *entry = factor.mul_add(*other, *entry);
    }
}

fn dot<const D: usize>(a: &[Lanes; D], b: &[Lanes; D]) -> Lanes {
    let pairs = a.iter().zip(b);
    pairs.fold(Lanes::ZERO, |sum, (a, b)| a.mul_add(*b, sum))
}

/// L with L Lᵀ = A in the place of A, whose upper half is not read.
fn cholesky<const D: usize>(matrix: &mut [[Lanes; D]; D]) {
    for a in 0..D {
        for b in 0..=a {
            let mut entry = matrix[a][b];
            for c in 0..b {
                entry -= matrix[a][c] * matrix[b][c];
            }
            matrix[a][b] = if a == b { entry.sqrt() } else { entry / matrix[b][b] };
        }
    }
}

/// L⁻¹ x.
fn forward<const D: usize>(lower: &[[Lanes; D]; D], x: &[Lanes; D]) -> [Lanes; D] {
    let mut y = *x;
    for a in 0..D {
        for b in 0..a {
            y[a] -= lower[a][b] * y[b];
        }
        y[a] /= lower[a][a];
    }
    y
}

fn squared(list: &[f64]) -> f64 {
    list.iter().map(|value| value * value).sum()
}

#[cfg(test)]
mod tests {
    use super::super::scaled_reading::tests::reading;
    use super::*;

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
        let others = [20, 0, 39, 7, 22];
        for (other, foretold) in others.into_iter().zip(design.with_each(&others)) {
            design.change(other, 1.0);
            assert!((foretold / design.objective() - 1.0).abs() < 1e-6);
            design.change(other, -1.0);
        }
    }
}
