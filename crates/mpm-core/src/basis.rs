//! The one seam: where a particle sits → which nodes, with which weight and gradient.

use mpm_kernels::{Columns, Deposit, Entry, Interpolated, LANES, NodeField, NodeSink, UniformGrid, Wanted};
use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;

use crate::{MpmError, Schedule};

/// In [`Basis::cell_nodes`]: no particle of the cell touches this one.
pub const NO_NODE: u32 = u32::MAX;

/// A particle of the cell that `cell` was collected of.
#[derive(Debug)]
pub struct Member<'a, C, const D: usize> {
    /// What [`Basis::enter`] has collected.
    pub cell: &'a C,
    /// Place in the schedule.
    pub particle: usize,
    /// The position that it was activated with.
    pub x: &'a [f64; D],
}

impl<C, const D: usize> Clone for Member<'_, C, D> {
    fn clone(&self) -> Self {
        *self
    }
}

impl<C, const D: usize> Copy for Member<'_, C, D> {}

/// A background discretisation: shape functions w_i that sum to one. They may be negative.
///
/// The step is written once over this trait; a uniform B-spline grid, a simplex lattice and an unstructured mesh are
/// implementations. A basis groups particles into *cells*, in which all particles touch the same nodes, so that node
/// numbers are looked up once per cell.
///
/// Whatever an implementation gets wrong leads to wrong results or a panic, not to a data race.
pub trait Basis<const D: usize>: Sync {
    /// Whether every particle is a cell of its own, so that collecting the nodes of a cell is of no use.
    const LONE_PARTICLES: bool = false;

    /// Whether fields are asked for four nodes side by side and not node by node; cells then have whole groups of places, and a node at each.
    const NODES_SIDE_BY_SIDE: bool = false;

    /// What is collected once per cell for all of its particles; `()` where that is nothing.
    type Cell: Default;

    /// Lay out the particles by cell: afterwards `schedule().order()` and the cells are those of these positions. Particles that are
    /// nearly in the order of the cells may stay in their own.
    ///
    /// # Errors
    /// [`MpmError::PositionOutOfRange`], [`MpmError::TooManyNodes`]. The basis is then of no use until it has been sorted and
    /// activated again.
    fn sort(&mut self, positions: &[[f64; D]]) -> Result<(), MpmError>;

    /// Activate the nodes that the positions of the last [`sort`](Self::sort), now in schedule order, touch, and number
    /// them 0..n.
    ///
    /// # Errors
    /// As [`sort`](Self::sort).
    fn activate(&mut self, sorted: &[[f64; D]]) -> Result<(), MpmError>;

    /// [`sort`](Self::sort) and [`activate`](Self::activate); returns the positions in schedule order.
    ///
    /// # Errors
    /// As [`sort`](Self::sort).
    fn rebuild(&mut self, positions: &[[f64; D]]) -> Result<Vec<[f64; D]>, MpmError> {
        self.sort(positions)?;
        let order = self.schedule().order();
        let sorted: Vec<[f64; D]> = order.iter().map(|&p| positions[p as usize]).collect();
        self.activate(&sorted)?;
        Ok(sorted)
    }

    /// From the next [`activate`](Self::activate) on, whether [`affine_direction`](Self::affine_direction) and what rests on it will be asked for; bases that
    /// have to compute D_p⁻¹ may leave it out where it is not. Until told, it is.
    fn expect_affine_directions(&mut self, _read: bool) {}

    /// Order of the particles, their cells, and the parts that work side by side.
    fn schedule(&self) -> &Schedule;

    /// Number of active nodes n.
    fn node_count(&self) -> usize;

    /// Positions of all active nodes, in the order of their numbers.
    fn node_positions(&self, out: &mut Vec<[f64; D]>);

    /// Number of the active node at `position`, where the basis can tell.
    fn node_number(&self, _position: &[f64; D]) -> Option<u32> {
        None
    }

    /// Length h over which the basis resolves a field.
    fn spacing(&self) -> f64;

    /// Nodes that one particle touches, at most; nodes on which its weight and gradient vanish count too. Work is estimated with
    /// it.
    fn stencil_size(&self) -> usize;

    /// Places of nodes that the particles of `cell` may touch: [`stencil_size`](Self::stencil_size) in all cells, unless a basis says
    /// otherwise.
    #[inline(always)]
    fn cell_stencil_size(&self, _cell: usize) -> usize {
        self.stencil_size()
    }

    /// The [`cell_stencil_size`](Self::cell_stencil_size) node numbers that the particles of `cell` touch, by the places of
    /// [`for_each_node`](Self::for_each_node), [`NO_NODE`] at places that none of them touches; a node may have several places, of which only the first is
    /// visited. Written to `scratch` where they are not stored.
    fn cell_nodes<'a>(&'a self, cell: usize, scratch: &'a mut Vec<u32>) -> &'a [u32];

    /// Collect what the particles of `cell` have in common in the place of what is there: asked before they deposit and interpolate.
    #[inline(always)]
    fn enter(&self, _cell: usize, _collected: &mut Self::Cell) {}

    /// [`enter`](Self::enter), and visit the numbers of four nodes at a time, in the order of their places, where they are
    /// [side by side](Self::NODES_SIDE_BY_SIDE). `node_count` is that of all nodes.
    #[inline(always)]
    fn enter_by_fours(
        &self,
        cell: usize,
        collected: &mut Self::Cell,
        _node_count: usize,
        _visit: impl FnMut([u32; LANES]),
    ) {
        self.enter(cell, collected);
    }

    /// Visit the stencil of a particle, given by its place in the schedule and the position `x` that it was activated with:
    /// place in [`cell_nodes`](Self::cell_nodes), weight, gradient, offset.
    fn for_each_node(&self, particle: usize, x: &[f64; D], visit: impl FnMut(usize, &Entry<D>));

    /// As [`for_each_node`](Self::for_each_node), with weight and w_ip `value` + `scale` (0, ∇w_ip).
    ///
    /// Bases override it: an isotropic stress needs D + 1 products per node of a tensor product, and as many differences on a lattice.
    #[inline(always)]
    fn for_each_deposit(
        &self,
        particle: usize,
        x: &[f64; D],
        value: &Deposit<D>,
        scale: f64,
        mut visit: impl FnMut(usize, f64, &Deposit<D>),
    ) {
        self.for_each_node(particle, x, |index, entry| {
            let gradient = Deposit {
                scalar: 0.0,
                vector: entry.gradient,
            };
            visit(index, entry.weight, &value.combine(entry.weight, &gradient, scale));
        });
    }

    /// Add to the nodes of the stencil of a particle, which count as in [`for_each_node`](Self::for_each_node),
    /// w_ip `value` + A w_ip D_p⁻¹ (x_i − x_p) + S ∇w_ip, where A = `affine` and S = `flux` act on the vector alone and
    /// D_p⁻¹ is that of [`affine_direction`](Self::affine_direction).
    #[inline(always)]
    fn deposit<A: Columns<D>, S: Columns<D>>(
        &self,
        Member { particle, x, .. }: Member<Self::Cell, D>,
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        if let (Some(0.0), Some(scale)) = (affine.isotropic(), flux.isotropic()) {
            self.for_each_deposit(particle, x, value, scale, |index, _, deposit| {
                sink.add(index, deposit);
            });
            return;
        }
        self.deposit_node_by_node((particle, x), value, affine, flux, sink);
    }

    /// [`deposit`](Self::deposit) to one node after another, by weights and gradients alone.
    #[inline(always)]
    fn deposit_node_by_node<A: Columns<D>, S: Columns<D>>(
        &self,
        (particle, x): (usize, &[f64; D]),
        value: &Deposit<D>,
        affine: &A,
        flux: &S,
        sink: &mut impl NodeSink<D>,
    ) {
        self.for_each_node(particle, x, |index, entry| {
            let direction = self.affine_direction(particle, x, entry);
            let mut sum = value.combine(entry.weight, &Deposit::ZERO, 0.0);
            for a in 0..D {
                let columns = [(affine.column(a), direction[a]), (flux.column(a), entry.gradient[a])];
                for (column, scale) in columns {
                    if let Some(column) = column {
                        add_scaled(&mut sum.vector, scale, &column);
                    }
                }
            }
            sink.add(index, &sum);
        });
    }

    /// Σ_i w_ip v_i and what is `wanted` beside it; `nodes` has v_i at i, i counting as in
    /// [`for_each_node`](Self::for_each_node).
    #[inline(always)]
    fn interpolate(
        &self,
        Member { particle, x, .. }: Member<Self::Cell, D>,
        wanted: Wanted,
        nodes: &impl NodeField<D>,
    ) -> Interpolated<D> {
        if wanted == Wanted::default() {
            let mut sum = Interpolated::ZERO;
            let value = &mut sum.value;
            self.for_each_node(particle, x, |index, entry| {
                add_scaled(value, entry.weight, &nodes.vector(index));
            });
            return sum;
        }
        self.interpolate_node_by_node((particle, x), wanted, nodes)
    }

    /// [`interpolate`](Self::interpolate) from one node after another, by weights and gradients alone.
    #[inline(always)]
    fn interpolate_node_by_node(
        &self,
        (particle, x): (usize, &[f64; D]),
        wanted: Wanted,
        nodes: &impl NodeField<D>,
    ) -> Interpolated<D> {
        let mut sum = Interpolated::ZERO;
        self.for_each_node(particle, x, |index, entry| {
            let direction = if wanted.least_squares {
                self.affine_direction(particle, x, entry)
            } else {
                entry.gradient
            };
            sum.add(wanted, entry, &direction, &nodes.vector(index));
        });
        sum
    }

    /// Add w_ip times every scalar to its sums of the nodes of the stencil, which count as in [`for_each_node`](Self::for_each_node).
    #[inline(always)]
    fn deposit_scalars<const N: usize>(
        &self,
        Member { particle, x, .. }: Member<Self::Cell, D>,
        scalars: [f64; N],
        mut sums: [&mut [f64]; N],
    ) {
        self.for_each_node(particle, x, |index, entry| {
            for (sums, scalar) in sums.iter_mut().zip(scalars) {
                sums[index] += entry.weight * scalar;
            }
        });
    }

    /// Σ_i w_ip s_i; `nodes` has s_i at i, i counting as in [`for_each_node`](Self::for_each_node).
    #[inline(always)]
    fn interpolate_scalar(&self, Member { particle, x, .. }: Member<Self::Cell, D>, nodes: &[f64]) -> f64 {
        let mut sum = 0.0;
        self.for_each_node(particle, x, |index, entry| sum += entry.weight * nodes[index]);
        sum
    }

    /// w_ip D_p⁻¹ (x_i − x_p), by which APIC sends the affine part of a particle's velocity to node i, with
    /// D_p = Σ_i w_ip (x_i − x_p)(x_i − x_p)ᵀ; equals ∇w_ip for piecewise linear bases (Jiang et al. 2015, §5.3).
    fn affine_direction(&self, particle: usize, x: &[f64; D], entry: &Entry<D>) -> [f64; D];

    /// Bytes held.
    fn storage_bytes(&self) -> usize;
}

/// `sum` ← `sum` + `scale` `vector`.
#[inline(always)]
pub(crate) fn add_scaled<const D: usize>(sum: &mut [f64; D], scale: f64, vector: &[f64; D]) {
    for a in 0..D {
        sum[a] = multiply_add(scale, vector[a], sum[a]);
    }
}

/// A basis on a lattice without end, which can be moved and scaled.
pub trait UniformBasis<const D: usize>: Basis<D> {
    /// A node at `origin`, spacing h. The basis must be rebuilt before anything else is asked of it.
    ///
    /// # Errors
    /// [`MpmError::InvalidParameter`] unless `h` is positive and `h` and `origin` are finite.
    fn place(&mut self, origin: [f64; D], h: f64) -> Result<(), MpmError>;

    /// Turn the basis by an orthogonal R (rows: the new axes), seen from how it was made. Bases whose axes are those of space stay as they
    /// are. The basis must be rebuilt before anything else is asked of it.
    fn turn(&mut self, _rotation: &Matrix<D>) {}

    /// The point of the unit cell of a lattice of spacing h that has the coordinates `fraction` ∈ [0, 1)ᴰ in it: all
    /// lattices there are have their origin at one such point.
    fn cell_point(&self, fraction: &[f64; D], h: f64) -> [f64; D];
}

/// The nodes of a grid along the axes, as [`UniformBasis::place`] takes them.
pub(crate) fn placed_grid<const D: usize>(origin: [f64; D], h: f64) -> Result<UniformGrid<D>, MpmError> {
    check_placement(&origin, h)?;
    Ok(UniformGrid::new(origin, h))
}

/// What [`UniformBasis::place`] refuses.
pub(crate) fn check_placement<const D: usize>(origin: &[f64; D], h: f64) -> Result<(), MpmError> {
    if let Some(&value) = origin.iter().find(|c| !c.is_finite()) {
        return Err(MpmError::InvalidParameter {
            field: "origin",
            value,
            expected: "finite",
        });
    }
    if !(h > 0.0 && h.is_finite()) {
        return Err(MpmError::InvalidParameter {
            field: "spacing",
            value: h,
            expected: "positive and finite",
        });
    }
    Ok(())
}
