//! Tensor-product stencils: Wᴰ nodes from D rows of one-dimensional weights.

use crate::axis_group::AxisGroup;
use crate::lanes::{LANES, Lanes};
use crate::walk::for_each_product;
use crate::{Deposit, Layout, SecondMoment, Spline};

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

    /// 1/h.
    pub(crate) fn inverse_spacing(&self) -> f64 {
        self.inverse_spacing
    }

    /// u_a = (x_a − origin_a) / h.
    ///
    /// # Panics
    ///
    /// Where the axis is not below D, as an index of an array does.
    #[inline(always)]
    pub fn coordinate(&self, x: &[f64; D], axis: usize) -> f64 {
        (x[axis] - self.origin[axis]) * self.inverse_spacing
    }

    /// The [`coordinate`](Self::coordinate)s of the four axes from `first` on, 0 where there are none.
    #[inline(always)]
    pub fn coordinates(&self, x: &[f64; D], first: usize) -> Lanes {
        let axis = |lane: usize| {
            if first + lane < D {
                self.coordinate(x, first + lane)
            } else {
                0.0
            }
        };
        Lanes::new([axis(0), axis(1), axis(2), axis(3)])
    }

    /// Index of the first node per axis that `x` touches with kernel `S`; `None` where a coordinate is not a number or beyond ±2³⁰.
    #[inline(always)]
    pub fn first_node<S: Spline<W>, const W: usize>(&self, x: &[f64; D]) -> Option<[i32; D]> {
        const LIMIT: f64 = (1u64 << 30) as f64;
        const TO_BITS: f64 = 6_755_399_441_055_744.0; // 1.5 · 2⁵²: the integer stands in the low bits of the sum
        let mut node = [0; D];
        let mut inside = true;
        let mut first = 0;
        while first < D {
            let u = self.coordinates(x, first);
            let (distances, bits) = (u.abs().to_array(), (S::default().rows(u).base + TO_BITS).to_array());
            for a in first..D.min(first + LANES) {
                inside &= distances[a % LANES] < LIMIT;
                node[a] = bits[a % LANES].to_bits() as i32;
            }
            first += LANES;
        }
        inside.then_some(node)
    }

    /// The index of the first node along each of the first four axes that `x` touches with kernel `S`, one axis per lane, as
    /// [`first_node`](Self::first_node) but without its checks. Lanes beyond the last axis have no meaning.
    #[inline(always)]
    pub fn first_nodes<S: Spline<W>, const W: usize>(&self, x: &[f64; D]) -> Lanes {
        S::default().rows(self.coordinates(x, 0)).base
    }

    /// Position of the node with index i.
    pub fn node_position(&self, node: &[i32; D]) -> [f64; D] {
        std::array::from_fn(|a| self.origin[a] + self.spacing * f64::from(node[a]))
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
    pub(crate) axes: [Axis<W>; D],
    /// Whether the gradient stands for w_ip D_p⁻¹ (x_i − x_p).
    gradient_directions: bool,
    /// Where the nodes stand.
    pub(crate) layout: Layout<D>,
}

/// What a stencil knows along one axis, for the `W` nodes of a row.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Axis<const W: usize> {
    /// First node.
    base: f64,
    /// N.
    pub weights: [f64; W],
    /// N′ / h.
    pub derivatives: [f64; W],
    /// r = x_i − x_p along the axis.
    pub offsets: [f64; W],
    /// N r.
    pub first_moments: [f64; W],
    /// N r / m; N′ / h for [`SecondMoment::Gradient`].
    pub directions: [f64; W],
    /// m = Σ N r².
    second_moment: f64,
}

impl<const W: usize> Axis<W> {
    const NONE: Self = Self {
        base: 0.0,
        weights: [0.0; W],
        derivatives: [0.0; W],
        offsets: [0.0; W],
        first_moments: [0.0; W],
        directions: [0.0; W],
        second_moment: 0.0,
    };
}

impl<const W: usize, const D: usize> Stencil<W, D> {
    /// Nodes in a stencil: Wᴰ.
    pub const SIZE: usize = W.pow(D as u32);

    /// The stencil of position `x` on `grid` with the kernel that `S` is by default.
    #[inline(always)]
    pub fn new<S: Spline<W>>(x: &[f64; D], grid: &UniformGrid<D>) -> Self {
        Self::of(&S::default(), x, grid)
    }

    /// The stencil of position `x` on `grid` with a kernel.
    #[inline(always)]
    pub fn of<S: Spline<W>>(kernel: &S, x: &[f64; D], grid: &UniformGrid<D>) -> Self {
        let mut axes = [Axis::NONE; D];
        let mut first = 0;
        while first < D {
            let group = AxisGroup::new(kernel, grid.coordinates(x, first), grid.spacing, grid.inverse_spacing);
            for a in first..D.min(first + LANES) {
                let of = |lanes: Lanes| lanes.to_array()[a % LANES];
                let axis = &mut axes[a];
                (axis.base, axis.second_moment) = (of(group.base), of(group.second_moments));
                for j in 0..W {
                    axis.weights[j] = of(group.weights[j]);
                    axis.derivatives[j] = of(group.derivatives[j]);
                    axis.offsets[j] = of(group.offsets[j]);
                    axis.first_moments[j] = of(group.first_moments[j]);
                    axis.directions[j] = of(group.directions[j]);
                }
            }
            first += LANES;
        }
        Self {
            axes,
            gradient_directions: S::SECOND_MOMENT == SecondMoment::Gradient,
            layout: const { Layout::alone(W) },
        }
    }

    /// The same stencil with its nodes at other places; they count from 0 without gaps until it is said otherwise.
    #[inline(always)]
    pub fn at(self, layout: Layout<D>) -> Self {
        Self { layout, ..self }
    }

    /// First node per axis.
    #[inline(always)]
    pub fn base(&self) -> [i64; D] {
        std::array::from_fn(|a| self.axes[a].base as i64)
    }

    /// The diagonal of D_p = Σ_i w_ip (x_i − x_p)(x_i − x_p)ᵀ; `None` for [`SecondMoment::Gradient`].
    #[inline(always)]
    pub fn second_moments(&self) -> Option<[f64; D]> {
        if self.gradient_directions {
            return None;
        }
        let mut moments = [0.0; D];
        for a in 0..D {
            moments[a] = self.axes[a].second_moment;
        }
        Some(moments)
    }

    /// Visit all Wᴰ nodes, the last axis fastest, by their places.
    #[inline(always)]
    pub fn for_each(&self, visit: impl FnMut(usize, &Entry<D>)) {
        let extend = |a: usize, j: usize, before: &Entry<D>| {
            let (w, dw) = (self.axes[a].weights[j], self.axes[a].derivatives[j]);
            let mut entry = *before;
            for b in 0..a {
                entry.gradient[b] = before.gradient[b] * w;
            }
            entry.gradient[a] = before.weight * dw;
            entry.weight = before.weight * w;
            entry.offset[a] = self.axes[a].offsets[j];
            entry
        };
        let one = Entry {
            weight: 1.0,
            gradient: [0.0; D],
            offset: [0.0; D],
        };
        for_each_product::<W, D, _>(one, &self.layout, extend, visit);
    }

    /// Visit all Wᴰ nodes with their weight and w_ip `value` + `scale` (0, ∇w_ip), at D + 1 products per node:
    /// component a of the vector is Π_{b≠a} N_b · (N_a `value`_a + `scale` ∂N_a).
    #[inline(always)]
    pub fn for_each_deposit(&self, value: &Deposit<D>, scale: f64, mut visit: impl FnMut(usize, f64, &Deposit<D>)) {
        let mut own = [[0.0; W]; D];
        for a in 0..D {
            for j in 0..W {
                own[a][j] = self.axes[a].weights[j] * value.vector[a] + self.axes[a].derivatives[j] * scale;
            }
        }
        let extend = |a: usize, j: usize, before: &(f64, [f64; D])| {
            let w = self.axes[a].weights[j];
            let mut flux = before.1;
            for b in 0..a {
                flux[b] = before.1[b] * w;
            }
            flux[a] = before.0 * own[a][j];
            (before.0 * w, flux)
        };
        for_each_product::<W, D, _>((1.0, [0.0; D]), &self.layout, extend, |index, &(weight, vector)| {
            let scalar = weight * value.scalar;
            visit(index, weight, &Deposit { scalar, vector });
        });
    }
}
