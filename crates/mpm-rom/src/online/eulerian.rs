//! Quadrature at points of space.

use mpm_tensor::{Matrix, vector};
use rayon::prelude::*;

use super::instant::Instant;
use super::nodes::Nodes;
use super::quadrature::QuadraturePoints;
use super::support::Support;
use super::{OnlineError, ReducedBody};
use crate::deformation_map::{AtRestTable, DeformationMap};
use crate::manifold::{Evaluation, velocities};
use crate::nearest::nearest;

/// Evaluations of the map for one X, at most; a point that needs more carries nothing.
const EVALUATIONS: usize = 10;

/// X is found where |g(X) − x| is at most this multiple of h. The point's place is then g(X), not x, so that all that is lost is the evenness of the spacing.
const TOLERANCE: f64 = 1e-2;

/// Spacing of the table of a(X), and how far beyond the body it reaches, in grid spacings.
const TABLE_SPACING: f64 = 0.5;
const TABLE_MARGIN: f64 = 2.0;

/// Steps for which a point outside the body is left alone, at most.
const LONGEST_REST: f64 = 32.0;

/// A point is no longer left alone once the fastest sample point is so many times as fast as when it was looked at: half the steps to the body are all of them then.
const FASTER: f64 = 2.0;

/// ℓᴰ points in every cell of the support of ℐ, V_q = (h/ℓ)ᴰ, with X_q from g(X_q, x̂_n) = x_q and m_q = ρ₀ V_q / J_q. Cells are those between the knots of the
/// kernel (ours): for the quadratic one they are centred at nodes, and a node's support is exactly 3ᴰ of them.
///
/// x_q stays where it is while the body moves, so X_q goes along dX/dt = −F⁻¹ v. Newton's method begins there (ours): its first evaluation of the map, which is needed in any
/// case, then nearly always shows that no other is.
pub(super) struct Eulerian<const D: usize> {
    per_axis: usize,
    /// In multiples of h.
    pub tolerance: f64,
    table: Option<AtRestTable<D>>,
    support: Support<D>,
    /// The largest speed of the sample points in this step.
    fastest: f64,
    /// What is known of the points, ℓᴰ entries per cell; of this step, and of the one before.
    known: Vec<Option<Known<D>>>,
    known_before: Vec<Option<Known<D>>>,
    /// Points whose X is looked for, with guesses of it.
    sought: Vec<Sought<D>>,
    guesses: Vec<[f64; D]>,
    evaluation: Evaluation<D>,
}

/// Where a point of space was in the body at rest.
#[derive(Clone, Copy)]
struct Known<const D: usize> {
    reference: [f64; D],
    /// dX/dt.
    rate: [f64; D],
    /// The step that this is of, and the next at which it is looked at.
    step: u64,
    next: u64,
    /// The largest speed of the sample points in that step.
    fastest: f64,
}

struct Sought<const D: usize> {
    /// Its place in `known`.
    number: usize,
    position: [f64; D],
}

impl<const D: usize> Eulerian<D> {
    pub fn new(per_axis: usize) -> Self {
        Self {
            per_axis,
            tolerance: TOLERANCE,
            table: None,
            support: Support::default(),
            fastest: 0.0,
            known: Vec::new(),
            known_before: Vec::new(),
            sought: Vec::new(),
            guesses: Vec::new(),
            evaluation: Evaluation::default(),
        }
    }

    /// With a table of what the map is at rest, if there can be one.
    pub fn tabulated(per_axis: usize, map: &DeformationMap<'_, D>, body: &ReducedBody<D>) -> Self {
        let h = body.grid.spacing();
        Self {
            table: map.tabulate(&body.reference, TABLE_MARGIN * h, TABLE_SPACING * h),
            ..Self::new(per_axis)
        }
    }

    /// The quadrature points of this instant, at which the map has been evaluated with gradients.
    pub fn place(
        &mut self,
        body: &ReducedBody<D>,
        map: &DeformationMap<'_, D>,
        nodes: &Nodes<D>,
        now: &Instant<D>,
        out: &mut QuadraturePoints<D>,
    ) -> Result<(), OnlineError> {
        self.support.find(nodes);
        self.guess(body, nodes, now);
        out.clear();
        let tolerance = self.tolerance * nodes.grid.spacing();
        for _ in 0..EVALUATIONS {
            if self.sought.is_empty() {
                break;
            }
            let prepared = match &self.table {
                Some(table) => map.prepare_from(table, &self.guesses),
                None => map.prepare(&self.guesses),
            };
            map.evaluate_moving(&prepared, now.latent, now.rates, &mut self.evaluation);
            self.accept(body, now, tolerance, out)?;
        }
        Ok(())
    }

    /// Points of all cells that have to be looked at, each with a guess of its X.
    fn guess(&mut self, body: &ReducedBody<D>, nodes: &Nodes<D>, now: &Instant<D>) {
        let (h, count) = (nodes.grid.spacing(), self.per_axis.pow(D as u32));
        let speeds = velocities(&now.samples.jacobians, now.rates).map(|v| vector::norm(&v));
        self.fastest = speeds.fold(0.0, f64::max);
        std::mem::swap(&mut self.known, &mut self.known_before);
        self.known.clear();
        self.sought.clear();
        self.guesses.clear();
        for &(node, before) in &self.support.cells {
            let centre = nodes.grid.node_position(&node.map(|c| c as i32));
            let known = before.and_then(|cell| self.known_before.get(cell * count..(cell + 1) * count));
            let mut start = None;
            for digit in 0..count {
                let known = known.and_then(|list| list[digit]);
                let number = self.known.len();
                self.known.push(known);
                let rests = |known: Known<D>| now.step < known.next && self.fastest <= FASTER * known.fastest;
                if known.is_some_and(rests) {
                    continue;
                }
                let position = point(&centre, h, self.per_axis, digit);
                let guess = match known {
                    Some(known) => {
                        let time = (now.step - known.step) as f64 * body.time_step;
                        Some(vector::add_scaled(&known.reference, time, &known.rate))
                    }
                    None => {
                        let start = start.get_or_insert_with(|| Start::nearest(&centre, now));
                        start.as_ref().map(|start| start.guess(&position))
                    }
                };
                if let Some(guess) = guess {
                    self.sought.push(Sought { number, position });
                    self.guesses.push(guess);
                }
            }
        }
    }

    /// Takes the points whose X has been found, and improves the guesses of the others by X + F⁻¹ (x − g(X)).
    fn accept(
        &mut self,
        body: &ReducedBody<D>,
        now: &Instant<D>,
        tolerance: f64,
        out: &mut QuadraturePoints<D>,
    ) -> Result<(), OnlineError> {
        let volume = (body.grid.spacing() / self.per_axis as f64).powi(D as i32);
        // What takes time, on all threads.
        let found = self.evaluation.positions.par_iter().zip(&self.evaluation.gradients);
        let found: Vec<_> = found
            .zip(self.sought.par_iter().zip(&self.guesses))
            .with_min_len(128)
            .map(|((x, gradient), (sought, reference))| {
                let rest = vector::subtract(&sought.position, x);
                let near = vector::maximum_norm(&rest) <= tolerance;
                let outside = near.then(|| body.distance(reference));
                (rest, gradient.inverse(), outside)
            })
            .collect();
        let mut left = 0;
        for (place, (rest, inverse, outside)) in found.into_iter().enumerate() {
            let Sought { number, position } = self.sought[place];
            let x = self.evaluation.positions[place];
            let gradient = self.evaluation.gradients[place];
            let v = self.evaluation.velocities[place];
            let reference = self.guesses[place];
            self.known[number] = None;
            if let Some(outside) = outside {
                if outside <= 0.0 {
                    let (admitted, ratio) = out.admit(&gradient, &reference, now)?;
                    out.push(x, v, admitted, volume / ratio);
                }
                self.known[number] = inverse.map(|inverse| {
                    let rate = inverse.apply(&v).map(|c| -c);
                    let step = now.step;
                    // Half the steps that it needs to reach the body.
                    let steps = 0.5 * outside / (vector::norm(&rate) * body.time_step);
                    let next = step + steps.clamp(1.0, LONGEST_REST) as u64;
                    Known {
                        // Newton's step, which costs nothing here: what this step leaves does not grow.
                        reference: vector::add(&reference, &inverse.apply(&rest)),
                        rate,
                        step,
                        next,
                        fastest: self.fastest,
                    }
                });
            } else if let (Some(inverse), true) = (inverse, vector::is_finite(&rest)) {
                self.guesses[left] = vector::add(&reference, &inverse.apply(&rest));
                self.sought[left] = Sought { number, position };
                left += 1;
            }
        }
        self.guesses.truncate(left);
        self.sought.truncate(left);
        Ok(())
    }
}

/// Point number `digit` of the ℓᴰ in the cell around `centre`.
fn point<const D: usize>(centre: &[f64; D], h: f64, per_axis: usize, digit: usize) -> [f64; D] {
    std::array::from_fn(|a| {
        let along = digit / per_axis.pow(a as u32) % per_axis;
        centre[a] + h * ((along as f64 + 0.5) / per_axis as f64 - 0.5)
    })
}

/// A sample point to begin a search at.
struct Start<'a, const D: usize> {
    reference: &'a [f64; D],
    position: &'a [f64; D],
    inverse: Matrix<D>,
}

impl<'a, const D: usize> Start<'a, D> {
    /// The sample point nearest to `centre`; `None` where its F has no inverse.
    fn nearest(centre: &[f64; D], now: &Instant<'a, D>) -> Option<Self> {
        let samples = now.samples;
        let sample = nearest(centre, &samples.positions);
        Some(Self {
            reference: &now.reference[sample],
            position: &samples.positions[sample],
            inverse: samples.gradients[sample].inverse()?,
        })
    }

    /// Newton's step from there to x.
    fn guess(&self, x: &[f64; D]) -> [f64; D] {
        let step = self.inverse.apply(&vector::subtract(x, self.position));
        vector::add(self.reference, &step)
    }
}
