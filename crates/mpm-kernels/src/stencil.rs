//! Tensor-product stencils: Wᴰ nodes from D rows of one-dimensional weights.

use crate::{Deposit, Spline};

/// The nodes {origin + h i : i ∈ ℤᴰ}.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformGrid<const D: usize> {
    origin: [f64; D],
    spacing: f64,
    inverse_spacing: f64,
}

impl<const D: usize> UniformGrid<D> {
    /// The grid with a node at `origin` and spacing h, which should be positive and finite.
    pub fn new(origin: [f64; D], spacing: f64) -> Self {
        Self {
            origin,
            spacing,
            inverse_spacing: 1.0 / spacing,
        }
    }

    /// A node's position.
    pub fn origin(&self) -> &[f64; D] {
        &self.origin
    }

    /// h.
    pub fn spacing(&self) -> f64 {
        self.spacing
    }

    /// u_a = (x_a − origin_a) / h.
    #[inline(always)]
    pub fn coordinate(&self, x: &[f64; D], axis: usize) -> f64 {
        (x[axis] - self.origin[axis]) * self.inverse_spacing
    }

    /// Position of the node with index i.
    pub fn node_position(&self, node: &[i64; D]) -> [f64; D] {
        std::array::from_fn(|a| self.origin[a] + self.spacing * node[a] as f64)
    }
}

/// One node of a stencil as seen from a particle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Entry<const D: usize> {
    /// w_ip = w_i(x_p).
    pub weight: f64,
    /// ∇w_ip, the gradient with respect to the particle's position; 1/length.
    pub gradient: [f64; D],
    /// x_i − x_p.
    pub offset: [f64; D],
}

/// Weights of a particle on the Wᴰ nodes base + {0, …, W−1}ᴰ of a uniform grid with spacing h:
/// w_ip = Π_a N(u_a − i_a), ∂w_ip/∂x_a = N′(u_a − i_a)/h Π_{b≠a} N(u_b − i_b), u = (x − origin)/h.
#[derive(Clone, Copy, Debug)]
pub struct Stencil<const W: usize, const D: usize> {
    /// First node per axis.
    pub base: [i64; D],
    weights: [[f64; W]; D],
    derivatives: [[f64; W]; D],
    offsets: [[f64; W]; D],
}

impl<const W: usize, const D: usize> Stencil<W, D> {
    /// Nodes in a stencil: Wᴰ.
    pub const SIZE: usize = W.pow(D as u32);

    /// The stencil of position `x` on `grid`.
    #[inline(always)]
    pub fn new<S: Spline<W>>(x: &[f64; D], grid: &UniformGrid<D>) -> Self {
        let mut stencil = Self {
            base: [0; D],
            weights: [[0.0; W]; D],
            derivatives: [[0.0; W]; D],
            offsets: [[0.0; W]; D],
        };
        for a in 0..D {
            let u = grid.coordinate(x, a);
            let row = S::row(u);
            stencil.base[a] = row.base;
            stencil.weights[a] = row.weights;
            for j in 0..W {
                stencil.derivatives[a][j] = row.derivatives[j] * grid.inverse_spacing;
                stencil.offsets[a][j] = (row.base.wrapping_add(j as i64) as f64 - u) * grid.spacing;
            }
        }
        stencil
    }

    /// Visit all Wᴰ nodes, the last axis fastest; the first argument counts from 0.
    #[inline(always)]
    pub fn for_each(&self, mut visit: impl FnMut(usize, &Entry<D>)) {
        let extend = |a: usize, j: usize, before: &Entry<D>| {
            let (w, dw) = (self.weights[a][j], self.derivatives[a][j]);
            let mut entry = *before;
            for b in 0..a {
                entry.gradient[b] = before.gradient[b] * w;
            }
            entry.gradient[a] = before.weight * dw;
            entry.weight = before.weight * w;
            entry.offset[a] = self.offsets[a][j];
            entry
        };
        let one = Entry {
            weight: 1.0,
            gradient: [0.0; D],
            offset: [0.0; D],
        };
        walk::<W, D, _>(one, extend, &mut visit);
    }

    /// Visit all Wᴰ nodes with their weight and w_ip `value` + `scale` (0, ∇w_ip), at D + 1 products per node:
    /// component a of the vector is Π_{b≠a} N_b · (N_a `value`_a + `scale` ∂N_a).
    #[inline(always)]
    pub fn for_each_deposit(&self, value: &Deposit<D>, scale: f64, mut visit: impl FnMut(usize, f64, &Deposit<D>)) {
        let own: [[f64; W]; D] = std::array::from_fn(|a| {
            std::array::from_fn(|j| self.weights[a][j] * value.vector[a] + self.derivatives[a][j] * scale)
        });
        let extend = |a: usize, j: usize, before: &(f64, [f64; D])| {
            let w = self.weights[a][j];
            let mut flux = before.1;
            for b in 0..a {
                flux[b] = before.1[b] * w;
            }
            flux[a] = before.0 * own[a][j];
            (before.0 * w, flux)
        };
        walk::<W, D, _>((1.0, [0.0; D]), extend, &mut |index, &(weight, vector)| {
            let scalar = weight * value.scalar;
            visit(index, weight, &Deposit { scalar, vector });
        });
    }
}

/// Visit all products of one factor per axis, the last axis fastest: `extend(a, j, P)` is the product over the axes
/// before a, taken over to axis a with factor j.
///
/// The inner loops have a constant length, so that they unroll; products over the outer axes are carried along and
/// renewed only from the first digit that changed.
#[inline(always)]
fn walk<const W: usize, const D: usize, P: Copy>(
    one: P,
    extend: impl Fn(usize, usize, &P) -> P,
    visit: &mut impl FnMut(usize, &P),
) {
    match D {
        1 => {
            for j in 0..W {
                visit(j, &extend(0, j, &one));
            }
        }
        2 => {
            for i in 0..W {
                let row = extend(0, i, &one);
                for j in 0..W {
                    visit(i * W + j, &extend(1, j, &row));
                }
            }
        }
        3 => {
            for i in 0..W {
                let plane = extend(0, i, &one);
                for j in 0..W {
                    let row = extend(1, j, &plane);
                    for k in 0..W {
                        visit((i * W + j) * W + k, &extend(2, k, &row));
                    }
                }
            }
        }
        _ => {
            let mut digit = [0usize; D];
            let mut products = [one; D];
            let (mut changed, mut index) = (0, 0);
            loop {
                for a in changed..D - 2 {
                    products[a + 1] = extend(a, digit[a], &products[a]);
                }
                for j in 0..W {
                    let row = extend(D - 2, j, &products[D - 2]);
                    for k in 0..W {
                        visit(index + k, &extend(D - 1, k, &row));
                    }
                    index += W;
                }
                if index == W.pow(D as u32) {
                    return;
                }
                changed = D - 3;
                digit[changed] += 1;
                while digit[changed] == W {
                    digit[changed] = 0;
                    changed -= 1;
                    digit[changed] += 1;
                }
            }
        }
    }
}
