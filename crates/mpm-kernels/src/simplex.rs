//! The simplex lattice: D + 1 nodes per particle, whatever the dimension.

use mpm_tensor::{Matrix, vector};

use crate::Deposit;
use crate::Entry;
use crate::lanes::{LANES, Lanes};
use crate::simplex_point::{AXES, SimplexPoint};

/// Lattices with more axes are not supported: a particle's simplex is packed into 3 bits per axis.
pub const LARGEST_LATTICE_DIMENSION: usize = AXES;

/// Geometry of a simplex lattice: Kuhn's (Freudenthal's) triangulation of ℤᴰ seen through u = T (x − origin) / h.
///
/// The nodes are x_i = origin + h T⁻¹ i, i ∈ ℤᴰ. The simplex of x: base = ⌊u⌋, the fractions f = u − base sorted in
/// descending order f_π1 ≥ … ≥ f_πD; its vertices are base, base + e_π1, base + e_π1 + e_π2, …, with weights
/// 1 − f_π1, f_π1 − f_π2, …, f_πD, and the gradients are differences of rows of T / h (docs/theory.md, Eqs. 18, 19).
/// Sources: Freudenthal 1942; Kuhn 1960; Adams, Baek & Davis 2010 for the lattice A_d* in filtering.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SimplexGeometry<const D: usize> {
    origin: [f64; D],
    spacing: f64,
    frame: Matrix<D>,
    inverse_frame: Matrix<D>,
    /// Rows of T / h, each after the zero that a scalar has for a gradient; padded to every number that three bits may hold.
    rows: [Deposit<D>; AXES],
    /// Columns of h T⁻¹, the edges of the lattice, padded likewise.
    edges: [[f64; D]; AXES],
}

impl<const D: usize> SimplexGeometry<D> {
    /// Kuhn's triangulation of the cubes themselves: T = I. Origin and spacing are those of [`place`](Self::place).
    pub fn kuhn(origin: [f64; D], spacing: f64) -> Self {
        Self::with_inverse(Matrix::IDENTITY, Matrix::IDENTITY, origin, spacing)
    }

    /// The lattice A_D*, whose simplices are as round as possible: T = c (I + b 1 1ᵀ) with b = (√(D+1) − 1) / D and
    /// c = (D + 1)^{−1/(2D)}. Its edges have the Gram matrix (D+1)^{1/D} (I − 1 1ᵀ / (D+1)) h², so that a cell has the volume
    /// hᴰ (docs/theory.md, Eq. 21; Conway & Sloane, Sphere Packings, Lattices and Groups). Origin and spacing are those of [`place`](Self::place).
    pub fn permutohedral(origin: [f64; D], spacing: f64) -> Self {
        let d = D as f64;
        let root = (d + 1.0).sqrt();
        let scale = (d + 1.0).powf(-0.5 / d);
        let frame = |b: f64, c: f64| Matrix::from_fn(|i, j| c * (b + f64::from(u8::from(i == j))));
        let inverse = frame((1.0 / root - 1.0) / d, 1.0 / scale);
        Self::with_inverse(frame((root - 1.0) / d, scale), inverse, origin, spacing)
    }

    /// Any frame T; `None` where it has no finite inverse, the spacing is not positive or it or the origin is not finite.
    pub fn new(frame: Matrix<D>, origin: [f64; D], spacing: f64) -> Option<Self> {
        let placed = spacing > 0.0 && spacing.is_finite() && vector::is_finite(&origin);
        if !placed {
            return None;
        }
        let inverse = frame.inverse().filter(Matrix::is_finite)?;
        Some(Self::with_inverse(frame, inverse, origin, spacing))
    }

    /// The same lattice turned by an orthogonal R, whose rows are the new axes: T ← T R.
    pub fn turned(&self, rotation: &Matrix<D>) -> Self {
        let inverse = rotation.transpose() * self.inverse_frame;
        Self::with_inverse(self.frame * *rotation, inverse, self.origin, self.spacing)
    }

    fn with_inverse(frame: Matrix<D>, inverse_frame: Matrix<D>, origin: [f64; D], spacing: f64) -> Self {
        let mut geometry = Self {
            origin,
            spacing,
            frame,
            inverse_frame,
            rows: [Deposit::ZERO; AXES],
            edges: [[0.0; D]; AXES],
        };
        geometry.place(origin, spacing);
        geometry
    }

    /// Move the lattice: a node at `origin`, spacing h. The origin should be finite and h positive and finite, which is not looked at here: nodes and weights are without
    /// meaning otherwise. [`new`](Self::new) and the lattices of `mpm-core` refuse such places.
    pub fn place(&mut self, origin: [f64; D], spacing: f64) {
        (self.origin, self.spacing) = (origin, spacing);
        for a in 0..D {
            for b in 0..D {
                self.rows[a].vector[b] = self.frame.0[a][b] / spacing;
                self.edges[a][b] = self.inverse_frame.0[b][a] * spacing;
            }
        }
    }

    /// A node's position.
    pub fn origin(&self) -> &[f64; D] {
        &self.origin
    }

    /// h: a cell of the lattice (a parallelepiped of D! simplices) has the volume hᴰ / |det T|.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// T.
    pub fn frame(&self) -> &Matrix<D> {
        &self.frame
    }

    /// u = T (x − origin) / h of points side by side: `u[axis]`.
    #[inline(always)]
    pub fn coordinates(&self, xs: &[[f64; D]; LANES]) -> [Lanes; D] {
        let mut u = [Lanes::ZERO; D];
        for b in 0..D {
            let c = Lanes::new(xs.map(|x| x[b])) - self.origin[b];
            for a in 0..D {
                u[a] = Lanes::splat(self.rows[a].vector[b]).mul_add(c, u[a]);
            }
        }
        u
    }

    /// Bases of the simplices of points with lattice coordinates u: the integers below. Where a coordinate is an integer
    /// itself, either neighbour may come out; the simplex is then the closed one on that side.
    #[inline(always)]
    pub fn bases(&self, u: &[Lanes; D]) -> [Lanes; D] {
        const TO_INTEGER: f64 = 6_755_399_441_055_744.0; // 1.5 · 2⁵²: the sum has no room for a fraction
        u.map(|u| ((u - 0.5) + TO_INTEGER) - TO_INTEGER)
    }

    /// The simplices that contain points side by side: their bases, `base[axis]`, and where in them the points are.
    #[inline(always)]
    pub fn simplices(&self, xs: &[[f64; D]; LANES]) -> ([Lanes; D], [SimplexPoint<D>; LANES]) {
        let u = self.coordinates(xs);
        let bases = self.bases(&u);
        (bases, SimplexPoint::sorted(&std::array::from_fn(|a| u[a] - bases[a])))
    }

    /// Position of the node with index i.
    pub fn node_position(&self, node: &[f64; D]) -> [f64; D] {
        let mut x = self.origin;
        for a in 0..D {
            for b in 0..D {
                x[b] += self.edges[a][b] * node[a];
            }
        }
        x
    }

    /// h T⁻¹ c: the point with coordinates c in the unit cell of a lattice of this frame and spacing h at 0.
    pub fn cell_point(&self, fraction: &[f64; D], spacing: f64) -> [f64; D] {
        self.inverse_frame.apply(fraction).map(|c| c * spacing)
    }

    /// Visit the D + 1 vertices, from the base on, with weight, gradient and offset.
    #[inline(always)]
    pub fn for_each(&self, point: &SimplexPoint<D>, mut visit: impl FnMut(usize, &Entry<D>)) {
        let mut offset = [0.0; D];
        for k in 0..D {
            let edge = &self.edges[point.axis(k)];
            for b in 0..D {
                offset[b] -= edge[b] * (point.level(k) - 1.0);
            }
        }
        let (mut above, mut row_above) = (2.0, &[0.0; D]);
        for k in 0..D {
            let (level, axis) = (point.level(k), point.axis(k));
            let row = &self.rows[axis].vector;
            let gradient = std::array::from_fn(|b| row_above[b] - row[b]);
            let weight = above - level;
            visit(
                k,
                &Entry {
                    weight,
                    gradient,
                    offset,
                },
            );
            for b in 0..D {
                offset[b] += self.edges[axis][b];
            }
            (above, row_above) = (level, row);
        }
        let weight = above - 1.0;
        visit(
            D,
            &Entry {
                weight,
                gradient: *row_above,
                offset,
            },
        );
    }

    /// Visit the vertices with weight and w `value` + `scale` (0, ∇w): differences of (1 + f) `value` + `scale` (0, row), each
    /// exact to 2⁻⁵² of `value`, not of w `value`.
    #[inline(always)]
    pub fn for_each_deposit(
        &self,
        point: &SimplexPoint<D>,
        value: &Deposit<D>,
        scale: f64,
        mut visit: impl FnMut(usize, f64, &Deposit<D>),
    ) {
        let (mut above, mut carried) = (2.0, value.combine(2.0, &Deposit::ZERO, 0.0));
        for k in 0..D {
            let (level, row) = (point.level(k), &self.rows[point.axis(k)]);
            let next = value.combine(level, row, scale);
            visit(k, above - level, &carried.minus(&next));
            (above, carried) = (level, next);
        }
        visit(D, above - 1.0, &carried.minus(value));
    }
}
