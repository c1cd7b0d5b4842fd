//! Walls one or two cells apart: images of one are before or behind the other.

use mpm_core::{
    Apic, Basis, Boundaries, Boundary, Contact, Extents, Flip, GridMotion, GridNode, Mpm, Particles, Plane, SplineGrid,
    Transfer, VelocityNode,
};
use mpm_kernels::{Cubic, Deposit, Quadratic, Spline};
use mpm_tensor::vector;
use rand::RngExt;

use crate::scenes::{Pull, free, generator, neo_hookean, normal};

const H: f64 = 0.25;
const SLIP: Contact = Contact::Slip;
const STICK: Contact = Contact::Stick;
const SMOOTH: Contact = Contact::Separate { friction: 0.0 };

/// What the walls at 0 and at the other end of an axis do, and how fast they go along.
type Ends = [(Contact, f64); 2];

/// Walls across some axes of a room whose edges are so many cells, in an order that mixes the axes.
fn walls<const D: usize>(cells: [usize; D], ends: &[(usize, Ends)]) -> Vec<Plane<D>> {
    let mut walls = Vec::new();
    for side in [0, 1] {
        for &(axis, ends) in ends {
            let along = |axis: usize, value: f64| std::array::from_fn(|a| if a == axis { value } else { 0.0 });
            let (contact, speed) = ends[side];
            walls.push(Plane {
                point: along(axis, [0.0, H * cells[axis] as f64][side]),
                normal: along(axis, [1.0, -1.0][side]),
                contact,
                velocity: along((axis + 1) % D, speed),
            });
        }
    }
    walls
}

/// The nodes of a room full of particles, with masses and velocities of their own.
struct Room<S, const W: usize, const D: usize> {
    basis: SplineGrid<S, W, D>,
    particles: Vec<[f64; D]>,
    positions: Vec<[f64; D]>,
    nodes: Vec<VelocityNode<D>>,
}

impl<S: Spline<W>, const W: usize, const D: usize> Room<S, W, D> {
    fn new(cells: [usize; D]) -> Self {
        Self::filled(|at| std::array::from_fn(|a| H * cells[a] as f64 * at[a]))
    }

    /// Filled by points of the unit cube, put where `place` says.
    fn filled(place: impl Fn([f64; D]) -> [f64; D]) -> Self {
        let mut random = generator(3);
        let mut basis = SplineGrid::<S, W, D>::new([0.0; D], H).unwrap();
        let mut point = || std::array::from_fn(|_| random.random::<f64>());
        let cloud: Vec<[f64; D]> = (0..3000).map(|_| place(point())).collect();
        let particles = basis.rebuild(&cloud).unwrap();
        let node = |_| {
            let (scalar, velocity) = (random.random::<f64>() + 0.1, normal::<D>(&mut random));
            let mut node = VelocityNode::default();
            node.add(&Deposit {
                scalar,
                vector: velocity.map(|v| scalar * v),
            });
            node.advance(&[0.0; D], 1.0, f64::INFINITY);
            node
        };
        let nodes = (0..basis.node_count()).map(node).collect();
        let mut positions = Vec::new();
        basis.node_positions(&mut positions);
        Self {
            basis,
            particles,
            positions,
            nodes,
        }
    }

    fn constrain(&mut self, walls: &[Plane<D>]) {
        let motion = GridMotion {
            positions: &self.positions,
            extents: Extents {
                positions: &self.particles,
                volume: &|_| 0.0,
            },
            time: 0.0,
            time_step: 0.1,
        };
        Boundaries::new(walls.to_vec(), Vec::new()).constrain(&self.basis, &motion, &mut self.nodes);
    }

    /// Σ m v along an axis, and Σ m |v|² / 2.
    fn sums(&self, axis: usize) -> (f64, f64) {
        let each = self.nodes.iter().map(|node| (node.mass(), *node.velocity()));
        each.fold((0.0, 0.0), |(momentum, energy), (m, v)| {
            let square: f64 = v.iter().map(|c| c * c).sum();
            (momentum + m * v[axis], energy + 0.5 * m * square)
        })
    }

    /// The largest error of the condition at a wall, at the points of it below the particles that are farther than `from` along the first axis.
    fn error_at(&self, wall: &Plane<D>, from: f64) -> f64 {
        let mut largest = 0.0f64;
        for particle in self.particles.iter().step_by(50) {
            let height = vector::dot(&wall.normal, &vector::subtract(particle, &wall.point));
            let x = vector::add_scaled(particle, -height, &wall.normal);
            if x[0] < from {
                continue;
            }
            let mut basis = SplineGrid::<S, W, D>::new([0.0; D], H).unwrap();
            basis.rebuild(&[x]).unwrap();
            let mut velocity = [0.0; D];
            basis.for_each_node(0, &x, |_, entry| {
                let at = vector::add(&x, &entry.offset);
                if let Some(number) = self.basis.node_number(&at) {
                    let node = self.nodes[number as usize].velocity();
                    vector::accumulate(&mut velocity, entry.weight, node);
                } else {
                    assert!(entry.weight.abs() < 1e-12, "a node at {at:?} is missing");
                }
            });
            let error = vector::subtract(&velocity, &wall.velocity);
            largest = largest.max(match wall.contact {
                STICK => vector::norm(&error),
                _ => vector::dot(&error, &wall.normal).abs(),
            });
        }
        largest
    }
}

/// The conditions hold at all walls, a second time nothing changes, and energy does not grow; momentum stays along an axis where all walls slide.
fn holds<S: Spline<W>, const W: usize, const D: usize>(cells: [usize; D], ends: &[(usize, Ends)], free: &[usize]) {
    let what = format!("{}, {cells:?}, {ends:?}", S::NAME);
    let walls = walls(cells, ends);
    let mut room = Room::<S, W, D>::new(cells);
    let before: Vec<_> = (0..D).map(|axis| room.sums(axis)).collect();
    room.constrain(&walls);
    for wall in &walls {
        let error = room.error_at(wall, f64::NEG_INFINITY);
        assert!(error < 1e-12, "{what}: {error} at {:?}", wall.point);
    }
    if walls.iter().all(|wall| wall.velocity == [0.0; D]) {
        assert!(room.sums(0).1 <= before[0].1, "{what}");
    }
    for &axis in free {
        let gained = room.sums(axis).0 - before[axis].0;
        assert!(gained.abs() < 1e-12, "{what}: {gained} along {axis}");
    }
    let once: Vec<_> = room.nodes.iter().map(|node| *node.velocity()).collect();
    room.constrain(&walls);
    for (node, once) in room.nodes.iter().zip(&once) {
        let change = vector::distance(node.velocity(), once);
        assert!(change < 1e-12, "{what}: {change}");
    }
}

fn all_conditions<S: Spline<W>, const W: usize>() {
    let (slip, stick, moving) = ((SLIP, 0.0), (STICK, 0.0), (STICK, 0.7));
    for cells in 1..=3 {
        for ends in [
            [slip, slip],
            [stick, stick],
            [stick, slip],
            [slip, stick],
            [moving, stick],
            [slip, moving],
        ] {
            let along: &[usize] = if ends == [slip, slip] { &[0] } else { &[] };
            holds::<S, W, 2>([4, cells], &[(1, ends)], along);
        }
        // Corners.
        holds::<S, W, 2>([2, cells], &[(0, [slip, slip]), (1, [slip, slip])], &[]);
        holds::<S, W, 2>([1, cells], &[(1, [slip, stick]), (0, [slip, slip])], &[]);
        holds::<S, W, 2>([4, cells], &[(1, [slip, slip]), (0, [stick, slip])], &[]);
        holds::<S, W, 3>([3, cells, 4], &[(1, [slip, slip])], &[0, 2]);
        holds::<S, W, 3>([1, cells, 4], &[(0, [slip, slip]), (1, [slip, slip])], &[2]);
    }
}

#[test]
fn walls_a_cell_or_two_apart_hold_and_let_slide() {
    all_conditions::<Quadratic, 3>();
    all_conditions::<Cubic, 4>();
}

/// A wall that lets go across from one that mirrors: what it does to a node it does to the image.
#[test]
fn images_of_nodes_at_a_wall_that_lets_go_stay_images() {
    for order in [[0, 1], [1, 0]] {
        let both = walls([4, 1], &[(1, [(SLIP, 0.0), (SMOOTH, 0.0)])]);
        let mut room = Room::<Quadratic, 3, 2>::new([4, 1]);
        let before = room.sums(0).0;
        room.constrain(&order.map(|k| both[k]));
        assert!(room.error_at(&both[0], f64::NEG_INFINITY) < 1e-12 && (room.sums(0).0 - before).abs() < 1e-12);
        for (x, node) in room.positions.iter().zip(&room.nodes) {
            if (x[1] - H).abs() < 1e-9 {
                let image = room.basis.node_number(&[x[0], -x[1]]).expect("active");
                let [u, v] = *node.velocity();
                assert_eq!(*room.nodes[image as usize].velocity(), [u, -v]);
                // Particles touch the wall, so that none of it comes nearer than they are.
                assert!(v <= H / 0.1, "{v}");
            }
        }
    }
}

/// Walls that meet at 45°: all images of a node, up to seven, beyond the stencil of their edge.
#[test]
fn walls_at_half_a_right_angle_hold_and_let_slide() {
    let half = 0.5f64.sqrt();
    for [floor, slope] in [[SLIP, SLIP], [STICK, SLIP], [SLIP, STICK], [STICK, STICK]] {
        let walls = [([0.0, 1.0], floor), ([half, -half], slope)].map(|(normal, contact)| Plane {
            point: [0.0; 2],
            normal,
            contact,
            velocity: [0.0; 2],
        });
        let mut room = Room::<Quadratic, 3, 2>::filled(|[a, b]| [2.0 * a.max(b), 2.0 * a.min(b)]);
        let before = room.sums(0).1;
        room.constrain(&walls);
        for wall in &walls {
            let error = room.error_at(wall, 1.5 * H);
            assert!(error < 1e-12, "{floor:?}, {slope:?}: {error}");
        }
        assert!(room.sums(0).1 < before);
    }
}

/// A bar that is compressed along a room of so many cells across, four particles each: its places along and velocities after some steps, one row of them.
fn compressed<S: Spline<W>, const W: usize, T: Transfer<2>>(transfer: T, cells: usize) -> Vec<[f64; 2]> {
    let rows = 2 * cells;
    let place = |k: usize| {
        [
            H * (0.25 + 0.5 * (k / rows) as f64),
            H * (0.25 + 0.5 * (k % rows) as f64),
        ]
    };
    let positions: Vec<[f64; 2]> = (0..16 * rows).map(place).collect();
    let volume = 0.25 * H * H;
    let count = positions.len();
    let mut particles = Particles::at_rest(positions, volume * count as f64).with_elastic_state(vec![volume; count]);
    for k in 0..count {
        particles.velocities[k] = [0.4 * (place(k)[0]).sin(), 0.0];
    }
    let basis = SplineGrid::<S, W, 2>::new([0.0; 2], H).unwrap();
    let walls = walls([8, cells], &[(1, [(SLIP, 0.0), (SLIP, 0.0)])]);
    let boundaries = Boundaries::new(walls, Vec::new());
    let mut body = Mpm::new(particles, basis, transfer, neo_hookean(10.0), Pull::none()).with_boundary(boundaries);
    for _ in 0..40 {
        body.step(&free(0.01)).unwrap();
    }
    let velocities = body.particles.in_creation_order(&body.particles.velocities);
    let places = body.particles.in_creation_order(&body.particles.positions);
    let first = |k: usize| k.is_multiple_of(rows);
    let row = places.iter().zip(&velocities).enumerate().filter(|(k, _)| first(*k));
    row.map(|(_, (x, v))| [x[0], v[0]]).collect()
}

/// Strain along one axis alone is the same in a room of any width.
fn the_width_does_not_matter<S: Spline<W>, const W: usize, T: Transfer<2> + Copy>(transfer: T) {
    let wide = compressed::<S, W, T>(transfer, 4);
    for cells in 1..=3 {
        for (narrow, wide) in compressed::<S, W, T>(transfer, cells).iter().zip(&wide) {
            let error = vector::distance(narrow, wide);
            assert!(error < 1e-12, "{}, {cells} cells: {error}", S::NAME);
        }
    }
}

#[test]
fn a_bar_between_sliding_walls_moves_alike_at_any_width() {
    the_width_does_not_matter::<Quadratic, 3, _>(Apic);
    the_width_does_not_matter::<Cubic, 4, _>(Apic);
    the_width_does_not_matter::<Quadratic, 3, _>(Flip::blend(1.0));
}
