//! The least squares problem with ψ(s) in the place of s, by Newton's method.

use mpm_kernels::Lanes;
use mpm_tensor::Matrix;

use crate::kernel::definite::inverse_of_definite;
use crate::kernel::fit::{LEAST_SAMPLED, LEAST_SPREAD, place_of};
use crate::kernel::ring_lanes::Group;
use crate::kernel::{LARGEST_COUNT, Sums};

/// Iterations of Newton's method, and halvings of each, at most.
const ITERATIONS: usize = 40;
const HALVINGS: usize = 20;

/// Share of the predicted fall that a step of the descent has to bring.
const SUFFICIENT_FALL: f64 = 1e-4;

/// What may be left of Σ w − 1, and of Σ w r / h.
const TOLERANCE: f64 = 1e-13;

/// α and β.
#[derive(Clone, Copy)]
pub(super) struct State<const D: usize> {
    pub level: f64,
    pub slope: [f64; D],
}

/// The ring of a particle, its d′, and θ.
pub(super) struct Problem<'a, const D: usize> {
    pub groups: &'a [Group<D>],
    pub samples: &'a [Lanes],
    pub point: [Lanes; D],
    pub inverse_h: f64,
    pub floor: f64,
}

/// Σ d ψ, Σ d ψ r, and the moments of d ψ′ from the zeroth to the second.
pub(super) struct Totals {
    values: [f64; 4],
    slopes: [f64; LARGEST_COUNT],
}

impl<const D: usize> Problem<'_, D> {
    /// Visit d′, s and r of four nodes at a time.
    #[inline(always)]
    fn for_each(&self, state: &State<D>, mut visit: impl FnMut(Lanes, Lanes, &[Lanes; D])) {
        let (level, slope) = (Lanes::splat(state.level), state.slope.map(Lanes::splat));
        for (group, &sample) in self.groups.iter().zip(self.samples) {
            let (mut s, mut r) = (level, [Lanes::ZERO; D]);
            for a in 0..D {
                r[a] = group.positions[a] - self.point[a];
                s = slope[a].mul_add(r[a], s);
            }
            visit(sample, s, &r);
        }
    }

    /// ψ and ψ′ of four nodes.
    #[inline(always)]
    fn shape(&self, s: Lanes) -> (Lanes, Lanes) {
        let floor = Lanes::splat(self.floor);
        let below = s.simd_lt(floor);
        let quotient = floor / (floor + floor - s);
        (
            below.select(floor * quotient, s),
            below.select(quotient * quotient, Lanes::splat(1.0)),
        )
    }

    /// Whether a node has s < θ.
    pub fn is_below(&self, state: &State<D>) -> bool {
        let mut below = false;
        self.for_each(state, |sample, s, _| {
            let low = s.simd_lt(Lanes::splat(self.floor)) & sample.simd_gt(Lanes::ZERO);
            below |= low.to_bitmask() != 0;
        });
        below
    }

    fn totals(&self, state: &State<D>) -> Totals {
        let (mut values, mut slopes): ([Lanes; 4], Sums) = ([Lanes::ZERO; 4], [Lanes::ZERO; LARGEST_COUNT]);
        self.for_each(state, |sample, s, r| {
            let (value, slope) = self.shape(s);
            let (value, slope) = (sample * value, sample * slope);
            values[0] += value;
            slopes[0] += slope;
            for i in 0..D {
                values[1 + i] = value.mul_add(r[i], values[1 + i]);
                let weighted = slope * r[i];
                slopes[1 + i] += weighted;
                for j in 0..=i {
                    let place = place_of(D, i, j);
                    slopes[place] = weighted.mul_add(r[j], slopes[place]);
                }
            }
        });
        Totals {
            values: values.map(Lanes::reduce_add),
            slopes: slopes.map(Lanes::reduce_add),
        }
    }

    /// How far Σ w is from 1 and Σ w r / h from 0.
    fn error(&self, totals: &Totals) -> f64 {
        let first = totals.values[1..=D].iter();
        let first = first.map(|value| (value * self.inverse_h).abs());
        first.fold((totals.values[0] - 1.0).abs(), f64::max)
    }

    /// Newton's method, with directions halved until the error falls, and as a [`descent`](Self::descent) from where that ends.
    pub fn solution(&self, start: State<D>) -> Option<(State<D>, Totals)> {
        let mut here = (start, self.totals(&start));
        let mut error = self.error(&here.1);
        for _ in 0..ITERATIONS {
            let direction = System::<D>::of(&here.1)?.solve(&here.1);
            let mut way = 1.0;
            let mut next = None;
            for _ in 0..HALVINGS {
                let state = here.0.moved(way, &direction);
                let totals = self.totals(&state);
                let left = self.error(&totals);
                if left < error {
                    next = Some((state, totals, left));
                    break;
                }
                way *= 0.5;
            }
            match next {
                Some((state, totals, left)) => (here, error) = ((state, totals), left),
                None => break, // rounding
            }
            if error < 0.01 * TOLERANCE {
                break;
            }
        }
        if error <= TOLERANCE {
            return Some(here);
        }
        self.descent(here)
    }

    /// Σ d Ψ(s) − α, Ψ(s) = ½ s² for s ≥ θ and ½ θ² − θ² ln (2 − s/θ) below.
    fn objective(&self, state: &State<D>) -> f64 {
        let floor = Lanes::splat(self.floor);
        let mut sum = Lanes::ZERO;
        self.for_each(state, |sample, s, _| {
            let past = (Lanes::splat(2.0) - s / floor).fast_max(Lanes::splat(1.0));
            let energy = s.simd_lt(floor).select(
                floor * floor * (Lanes::splat(0.5) - past.ln()),
                Lanes::splat(0.5) * s * s,
            );
            sum += sample * energy;
        });
        sum.reduce_add() - state.level
    }

    /// Newton's method, with directions halved until the convex function falls or the error halves: where most nodes have s far below θ, as in flat cells, the error alone falls too slowly.
    fn descent(&self, start: (State<D>, Totals)) -> Option<(State<D>, Totals)> {
        let mut here = start;
        let mut error = self.error(&here.1);
        let mut objective = self.objective(&here.0);
        for _ in 0..ITERATIONS {
            let direction = System::<D>::of(&here.1)?.solve(&here.1);
            let along = |a: usize| here.1.values[1 + a] * direction.slope[a];
            let fall = (here.1.values[0] - 1.0) * direction.level + (0..D).map(along).sum::<f64>();
            let mut way = 1.0;
            let mut next = None;
            for _ in 0..HALVINGS {
                let state = here.0.moved(way, &direction);
                let totals = self.totals(&state);
                let (left, value) = (self.error(&totals), self.objective(&state));
                if value <= objective + SUFFICIENT_FALL * way * fall || left < 0.5 * error {
                    next = Some((state, totals, left, value));
                    break;
                }
                way *= 0.5;
            }
            let (state, totals, left, value) = next?;
            (here, error, objective) = ((state, totals), left, value);
            if error <= TOLERANCE {
                return Some(here);
            }
        }
        None
    }

    /// d ψ′ of all nodes, and D_p⁻¹ of the weights.
    pub fn weighted(&self, state: &State<D>, spread: bool) -> (Vec<Lanes>, Option<Matrix<D>>) {
        let mut tilted = Vec::with_capacity(self.samples.len());
        let (mut moments, mut sampled) = ([[Lanes::ZERO; D]; D], [Lanes::ZERO; D]);
        self.for_each(state, |sample, s, r| {
            let (value, slope) = self.shape(s);
            tilted.push(sample * slope);
            let weight = sample * value;
            for i in 0..D {
                sampled[i] += sample * r[i] * r[i];
                for j in 0..=i {
                    moments[i][j] = (weight * r[i]).mul_add(r[j], moments[i][j]);
                }
            }
        });
        if !spread {
            return (tilted, None);
        }
        let moments = moments.map(|row| row.map(|entry| Lanes::splat(entry.reduce_add())));
        let mut floor = [Lanes::ZERO; D];
        for a in 0..D {
            let least = LEAST_SAMPLED * sampled[a].reduce_add();
            floor[a] = Lanes::splat(least).fast_max(moments[a][a] * LEAST_SPREAD);
        }
        let (inverse, definite) = inverse_of_definite(&moments, &floor);
        let inverse = Matrix(inverse.map(|row| row.map(|entry| entry.to_array()[0])));
        (tilted, (definite.to_bitmask() & 1 == 1).then_some(inverse))
    }
}

impl<const D: usize> State<D> {
    fn moved(&self, way: f64, direction: &Self) -> Self {
        Self {
            level: self.level + way * direction.level,
            slope: std::array::from_fn(|a| self.slope[a] + way * direction.slope[a]),
        }
    }
}

/// The inverse of the moments of d ψ′, as of [`Fit`]: α̂, β̂ and Γ.
pub(super) struct System<const D: usize> {
    pub level: f64,
    pub slope: [f64; D],
    pub curvature: Matrix<D>,
}

impl<const D: usize> System<D> {
    pub fn of(totals: &Totals) -> Option<Self> {
        let sums = &totals.slopes;
        let centre: [f64; D] = std::array::from_fn(|a| sums[1 + a] / sums[0]);
        let mut scatter = [[Lanes::ZERO; D]; D];
        for i in 0..D {
            for j in 0..=i {
                scatter[i][j] = Lanes::splat(sums[place_of(D, i, j)] - sums[0] * centre[i] * centre[j]);
            }
        }
        let (inverse, definite) = inverse_of_definite(&scatter, &[Lanes::ZERO; D]);
        if definite.to_bitmask() & 1 == 0 {
            return None;
        }
        let curvature = Matrix(inverse.map(|row| row.map(|entry| entry.to_array()[0])));
        let slope = curvature.apply(&centre).map(|c| -c);
        let level = 1.0 / sums[0] - (0..D).map(|a| slope[a] * centre[a]).sum::<f64>();
        Some(Self {
            level,
            slope,
            curvature,
        })
    }

    /// The direction that Newton's method takes.
    fn solve(&self, totals: &Totals) -> State<D> {
        let zeroth = 1.0 - totals.values[0];
        let first: [f64; D] = std::array::from_fn(|a| -totals.values[1 + a]);
        let curved = self.curvature.apply(&first);
        State {
            level: self.level * zeroth + (0..D).map(|a| self.slope[a] * first[a]).sum::<f64>(),
            slope: std::array::from_fn(|a| self.slope[a] * zeroth + curved[a]),
        }
    }
}
