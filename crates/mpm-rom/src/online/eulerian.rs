//! Quadrature at points of space.

use mpm_tensor::vector;

use super::lagrangian::Instant;
use super::nodes::Nodes;
use super::quadrature::{QuadraturePoints, checked_volume_ratio};
use super::{Inverted, OnlineError, ReducedBody};
use crate::deformation_map::{DeformationMap, MaterialPoints};
use crate::manifold::{Evaluation, Manifold, Wanted};

/// Newton steps for a reference position, at most; a point that needs more carries nothing.
const ITERATIONS: usize = 10;

/// A reference position is found where |g(X) − x| is at most this multiple of h.
const TOLERANCE: f64 = 1e-8;

/// ℓᴰ points in every cell of the support of ℐ, V_q = (h/ℓ)ᴰ, with X_q from g(X_q, x̂_n) = x_q and m_q = ρ₀ V_q / J_q. Cells are those between the knots of the
/// kernel (ours): for the quadratic one they are centred at nodes, and a node's support is exactly 3ᴰ of them.
pub(super) struct Eulerian<const D: usize> {
    per_axis: usize,
    inverted: Inverted,
    /// Which places of the nodes' box are in the list of cells.
    marked: Vec<bool>,
    cells: Vec<usize>,
    /// x_q that are still looked for, their X_q, and the guesses' evaluation.
    targets: Vec<[f64; D]>,
    guesses: Vec<[f64; D]>,
    prepared: MaterialPoints<D>,
    evaluation: Evaluation<D>,
    /// X_q that have been found.
    found: Vec<[f64; D]>,
    /// Points that the step left out because of J ≤ 0.
    pub left_out: usize,
}

impl<const D: usize> Eulerian<D> {
    pub fn new(per_axis: usize, inverted: Inverted) -> Self {
        Self {
            per_axis,
            inverted,
            marked: Vec::new(),
            cells: Vec::new(),
            targets: Vec::new(),
            guesses: Vec::new(),
            prepared: MaterialPoints::default(),
            evaluation: Evaluation::default(),
            found: Vec::new(),
            left_out: 0,
        }
    }

    /// The quadrature points of this instant; `samples` is the evaluation of the sample points with gradients, `reference` their X_p.
    #[allow(clippy::too_many_arguments)]
    pub fn place<M: Manifold<D>>(
        &mut self,
        body: &ReducedBody<D>,
        map: &mut DeformationMap<D, M>,
        reference: &[[f64; D]],
        samples: &Evaluation<D>,
        nodes: &Nodes<D>,
        now: &Instant<D>,
        out: &mut QuadraturePoints<D>,
    ) -> Result<(), OnlineError> {
        self.find_cells(nodes);
        self.guess(nodes, reference, samples);
        self.search(map, now, TOLERANCE * nodes.grid.spacing());
        self.found.retain(|x| body.holds(x));
        map.prepare(&self.found, &mut self.prepared);
        map.evaluate_moving(&self.prepared, now.latent, now.rates, now.time, &mut self.evaluation);
        let volume = (nodes.grid.spacing() / self.per_axis as f64).powi(D as i32);
        out.clear();
        self.left_out = 0;
        let places = self.evaluation.positions.iter().zip(&self.evaluation.gradients);
        for ((place, velocity), start) in places.zip(&self.evaluation.velocities).zip(&self.found) {
            let (position, gradient) = place;
            match (checked_volume_ratio(gradient, start, now.step), self.inverted) {
                (Ok(ratio), _) => {
                    out.positions.push(*position);
                    out.velocities.push(*velocity);
                    out.gradients.push(*gradient);
                    out.volumes.push(volume / ratio);
                }
                (Err(error), Inverted::Refuse) => return Err(error),
                (Err(_), Inverted::LeaveOut) => self.left_out += 1,
            }
        }
        Ok(())
    }

    /// The cells of the support of ℐ, each once.
    fn find_cells(&mut self, nodes: &Nodes<D>) {
        for &place in &self.cells {
            if let Some(marked) = self.marked.get_mut(place) {
                *marked = false;
            }
        }
        self.cells.clear();
        self.marked.resize(nodes.box_size(), false);
        for &active in nodes.active() {
            let node = nodes.node(active);
            for number in 0..3usize.pow(D as u32) {
                let cell = std::array::from_fn(|a| node[a] + (number / 3usize.pow(a as u32) % 3) as i64 - 1);
                if let Some(place) = nodes.place(&cell)
                    && let Some(marked) = self.marked.get_mut(place)
                    && !*marked
                {
                    *marked = true;
                    self.cells.push(place);
                }
            }
        }
    }

    /// The points of all cells, and their first guesses: Newton's step from the sample point that is nearest to the cell's centre.
    fn guess(&mut self, nodes: &Nodes<D>, reference: &[[f64; D]], samples: &Evaluation<D>) {
        self.targets.clear();
        self.guesses.clear();
        let h = nodes.grid.spacing();
        for &place in &self.cells {
            let node = nodes.node(place).map(|c| c as i32);
            let centre = nodes.grid.node_position(&node);
            let all = samples.positions.iter().zip(&samples.gradients).zip(reference);
            let nearest = all.min_by(|((a, _), _), ((b, _), _)| {
                vector::distance_squared(a, &centre).total_cmp(&vector::distance_squared(b, &centre))
            });
            let Some(((x, gradient), start)) = nearest else {
                continue;
            };
            let Some(inverse) = gradient.inverse() else { continue };
            for number in 0..self.per_axis.pow(D as u32) {
                let target: [f64; D] = std::array::from_fn(|a| {
                    let digit = number / self.per_axis.pow(a as u32) % self.per_axis;
                    centre[a] + h * ((digit as f64 + 0.5) / self.per_axis as f64 - 0.5)
                });
                let step = inverse.apply(&vector::subtract(&target, x));
                self.targets.push(target);
                self.guesses.push(vector::add(start, &step));
            }
        }
    }

    /// Newton's method for all points at once: X ← X + F⁻¹ (x − g(X)). Points that it does not find are dropped.
    fn search<M: Manifold<D>>(&mut self, map: &mut DeformationMap<D, M>, now: &Instant<D>, tolerance: f64) {
        let wanted = Wanted {
            gradients: true,
            ..Wanted::default()
        };
        self.found.clear();
        for _ in 0..ITERATIONS {
            if self.guesses.is_empty() {
                return;
            }
            map.prepare(&self.guesses, &mut self.prepared);
            map.evaluate(&self.prepared, now.latent, now.time, wanted, &mut self.evaluation);
            let mut left = 0;
            for point in 0..self.guesses.len() {
                let rest = vector::subtract(&self.targets[point], &self.evaluation.positions[point]);
                let distance = vector::maximum_norm(&rest);
                if distance <= tolerance {
                    self.found.push(self.guesses[point]);
                    continue;
                }
                let Some(inverse) = self.evaluation.gradients[point].inverse() else {
                    continue;
                };
                if distance.is_finite() {
                    self.guesses[left] = vector::add(&self.guesses[point], &inverse.apply(&rest));
                    self.targets[left] = self.targets[point];
                    left += 1;
                }
            }
            self.guesses.truncate(left);
            self.targets.truncate(left);
        }
    }
}
