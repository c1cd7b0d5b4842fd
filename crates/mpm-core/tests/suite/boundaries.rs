//! Walls and obstacles: what the nodes' velocities obey, and what is conserved all the same.

use mpm_core::{
    Apic, Basis, Boundaries, Boundary, Contact, Extents, GridMotion, GridNode, HalfSpace, HeldNode, HeldSurface,
    ImageNode, Mpm, MpmError, Obstacle, Particles, Plane, SignedDistance, SplineGrid, VelocityNode,
};
use mpm_kernels::{Cubic, Deposit, Linear, Quadratic, Spline};
use rand::RngExt;

use crate::scenes::{Pull, free, generator, neo_hookean, normal, uniform_cloud};

const H: f64 = 0.25;

/// A grid with 2000 particles in the unit square, nodes with masses and velocities, and the boundary applied to them.
struct Constrained<B> {
    basis: B,
    positions: Vec<[f64; 2]>,
    before: Vec<VelocityNode<2>>,
    after: Vec<VelocityNode<2>>,
}

fn constrained<S: Spline<W>, const W: usize>(boundaries: Boundaries<2>) -> Constrained<SplineGrid<S, W, 2>> {
    let mut basis = SplineGrid::<S, W, 2>::new([0.0; 2], H).unwrap();
    let particles = basis.rebuild(&uniform_cloud::<2>(2000, 1.0, 5)).unwrap();
    let mut random = generator(6);
    let node = |_| {
        let (scalar, velocity) = (random.random::<f64>() + 0.1, normal::<2>(&mut random));
        let mut node = VelocityNode::default();
        node.add(&Deposit {
            scalar,
            vector: velocity.map(|v| scalar * v),
        });
        node.advance(&[0.0; 2], 1.0, f64::INFINITY);
        node
    };
    let before: Vec<VelocityNode<2>> = (0..basis.node_count()).map(node).collect();
    let (mut positions, mut after) = (Vec::new(), before.clone());
    basis.node_positions(&mut positions);
    let motion = GridMotion {
        positions: &positions,
        extents: Extents {
            positions: &particles,
            volume: &|_| 0.0,
        },
        time: 0.0,
        time_step: 0.1,
    };
    let mut boundaries = boundaries;
    boundaries.constrain(&basis, &motion, &mut after);
    Constrained {
        basis,
        positions,
        before,
        after,
    }
}

impl<B: Basis<2>> Constrained<B> {
    /// The interpolated velocity at a point of the domain.
    fn velocity(&mut self, x: [f64; 2]) -> [f64; 2] {
        let mut sum = [0.0; 2];
        let (mut rows, mut total) = (Vec::new(), 0.0);
        for (x_i, node) in self.positions.iter().zip(&self.after) {
            rows.push((*x_i, *node.velocity()));
        }
        // One particle's stencil on the same grid, matched by position.
        let mut basis = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], H).unwrap();
        basis.rebuild(&[x]).unwrap();
        basis.for_each_node(0, &x, |_, entry| {
            let at: [f64; 2] = std::array::from_fn(|a| x[a] + entry.offset[a]);
            let found = rows.iter().find(|(p, _)| (0..2).all(|a| (p[a] - at[a]).abs() < 1e-9));
            if let Some((_, v)) = found {
                total += entry.weight;
                for a in 0..2 {
                    sum[a] += entry.weight * v[a];
                }
            }
        });
        assert!((total - 1.0).abs() < 1e-12, "all nodes around {x:?} are active");
        sum
    }

    /// The nodes when these boundaries act on them once more.
    fn again(&self, mut boundaries: Boundaries<2>) -> Vec<VelocityNode<2>> {
        let motion = GridMotion {
            positions: &self.positions,
            extents: Extents {
                positions: &[],
                volume: &|_| 0.0,
            },
            time: 0.0,
            time_step: 0.1,
        };
        let mut nodes = self.after.clone();
        boundaries.constrain(&self.basis, &motion, &mut nodes);
        nodes
    }

    fn momentum(nodes: &[VelocityNode<2>], axis: usize) -> f64 {
        nodes.iter().map(|node| node.mass() * node.velocity()[axis]).sum()
    }
}

/// The wall across an axis at 0, with the domain above it, or at 1, with the domain below.
fn wall(axis: usize, position: f64, contact: Contact, velocity: [f64; 2]) -> Plane<2> {
    let along = |value: f64| std::array::from_fn(|a| if a == axis { value } else { 0.0 });
    Plane {
        point: along(position),
        normal: along(1.0 - 2.0 * position),
        contact,
        velocity,
    }
}

struct Disk;

impl Disk {
    const CENTRE: [f64; 2] = [0.5, 0.0];
    const RADIUS: f64 = 0.4;
}

impl SignedDistance<2> for Disk {
    fn distance(&self, x: &[f64; 2]) -> f64 {
        mpm_tensor::vector::norm(&mpm_tensor::vector::subtract(x, &Self::CENTRE)) - Self::RADIUS
    }

    fn normal(&self, x: &[f64; 2]) -> [f64; 2] {
        let offset = mpm_tensor::vector::subtract(x, &Self::CENTRE);
        offset.map(|c| c / mpm_tensor::vector::norm(&offset))
    }
}

fn box_of(contact: Contact) -> Boundaries<2> {
    let sides = [(0, 0.0), (0, 1.0), (1, 0.0), (1, 1.0)];
    let walls = sides.map(|(axis, position)| wall(axis, position, contact, [0.0; 2]));
    Boundaries::new(walls.to_vec(), Vec::new())
}

#[test]
fn nothing_moves_on_a_wall_that_sticks_or_through_one_that_slips() {
    let mut stuck = constrained::<Quadratic, 3>(box_of(Contact::Stick));
    let mut sliding = constrained::<Quadratic, 3>(box_of(Contact::Slip));
    for s in [0.0, 0.13, 0.5, 0.77, 1.0] {
        for (x, axis) in [([0.0, s], 0), ([1.0, s], 0), ([s, 0.0], 1), ([s, 1.0], 1)] {
            let v = stuck.velocity(x);
            assert!(v.iter().all(|c| c.abs() < 1e-12), "stick at {x:?}: {v:?}");
            assert!(sliding.velocity(x)[axis].abs() < 1e-12, "slip at {x:?}");
        }
    }
    assert!(sliding.velocity([0.0, 0.5])[1].abs() > 1e-3, "it slides");
}

#[test]
fn a_wall_that_moves_takes_the_material_along() {
    let moving = wall(0, 0.0, Contact::Stick, [0.4, -0.3]);
    let mut field = constrained::<Quadratic, 3>(Boundaries::new(vec![moving], Vec::new()));
    let v = field.velocity([0.0, 0.5]);
    assert!((v[0] - 0.4).abs() < 1e-12 && (v[1] + 0.3).abs() < 1e-12);
}

/// Mirrored pairs exchange momentum along the wall, and lose none of it.
fn keeps_tangential_momentum<S: Spline<W>, const W: usize>() {
    let slip = wall(0, 0.0, Contact::Slip, [0.0; 2]);
    let field = constrained::<S, W>(Boundaries::new(vec![slip], Vec::new()));
    let along = |nodes: &[VelocityNode<2>]| Constrained::<SplineGrid<S, W, 2>>::momentum(nodes, 1);
    assert!(
        (along(&field.after) - along(&field.before)).abs() < 1e-12,
        "{}",
        S::NAME
    );
    assert!(field.basis.node_number(&[0.0, 0.5]).is_some());
}

#[test]
fn sliding_walls_keep_the_momentum_along_them() {
    keeps_tangential_momentum::<Linear, 2>();
    keeps_tangential_momentum::<Quadratic, 3>();
    keeps_tangential_momentum::<Cubic, 4>();
}

#[test]
fn mirroring_is_a_projection() {
    let once = constrained::<Cubic, 4>(box_of(Contact::Stick));
    let twice = once.again(box_of(Contact::Stick));
    for (first, second) in once.after.iter().zip(&twice) {
        for a in 0..2 {
            assert!((first.velocity()[a] - second.velocity()[a]).abs() < 1e-12);
        }
    }
}

/// The nodes at x = 0 and those behind it, each with the image of `sources` before it.
fn surface(
    field: &Constrained<SplineGrid<Quadratic, 3, 2>>,
    slides: bool,
    sources: impl Fn([f64; 2]) -> Vec<([f64; 2], f64)>,
) -> HeldSurface<2> {
    let node = |x: &[f64; 2]| HeldNode {
        position: *x,
        normal: [1.0, 0.0],
        velocity: [0.2, -0.1],
    };
    let on = field.positions.iter().filter(|x| x[0] == 0.0);
    let behind = field.positions.iter().filter(|x| x[0] < 0.0);
    let image = |x: &[f64; 2]| ImageNode {
        node: node(x),
        sources: sources([-x[0], x[1]]),
    };
    HeldSurface::new(on.map(node).collect(), behind.map(image).collect(), slides)
}

#[test]
fn a_surface_of_mirror_images_is_a_wall() {
    for (slides, contact) in [(false, Contact::Stick), (true, Contact::Slip)] {
        let wall = constrained::<Quadratic, 3>(Boundaries::new(vec![wall(0, 0.0, contact, [0.2, -0.1])], Vec::new()));
        let surface = surface(&wall, slides, |mirror| vec![(mirror, 1.0)]);
        let held = Boundaries::new(Vec::new(), Vec::new()).with_surfaces(vec![surface]);
        let held = constrained::<Quadratic, 3>(held);
        for (one, other) in wall.after.iter().zip(&held.after) {
            for a in 0..2 {
                let difference = one.velocity()[a] - other.velocity()[a];
                assert!(
                    difference.abs() < 1e-12,
                    "{slides}: {:?} {:?}",
                    one.velocity(),
                    other.velocity()
                );
            }
        }
    }
}

/// Images of two nodes each: energy relative to the surface falls, what is an image is one, and a second time nothing changes.
#[test]
fn images_between_nodes_are_a_projection() {
    let free = constrained::<Quadratic, 3>(Boundaries::new(Vec::new(), Vec::new()));
    let sources = |mirror: [f64; 2]| {
        let beside = [mirror[0], mirror[1] + 0.5];
        match free.basis.node_number(&beside) {
            Some(_) => vec![(mirror, 0.75), (beside, 0.25)],
            None => vec![(mirror, 1.0)],
        }
    };
    for slides in [false, true] {
        let act = || Boundaries::new(Vec::new(), Vec::new()).with_surfaces(vec![surface(&free, slides, sources)]);
        let once = constrained::<Quadratic, 3>(act());
        let relative = |node: &VelocityNode<2>| [node.velocity()[0] - 0.2, node.velocity()[1] + 0.1];
        let energy = |nodes: &[VelocityNode<2>]| -> f64 {
            nodes
                .iter()
                .map(|node| node.mass() * relative(node).iter().map(|c| c * c).sum::<f64>())
                .sum()
        };
        assert!(energy(&once.after) < energy(&once.before));
        let at = |x: &[f64; 2]| relative(&once.after[once.basis.node_number(x).expect("active") as usize]);
        let mut compared = 0;
        for image in surface(&once, slides, sources).images {
            if image.sources.iter().any(|(x, _)| once.basis.node_number(x).is_none()) {
                continue;
            }
            let own = at(&image.node.position);
            for (a, sign) in [(0, -1.0), (1, if slides { 1.0 } else { -1.0 })] {
                let mirror: f64 = image.sources.iter().map(|(x, share)| share * at(x)[a]).sum();
                assert!((own[a] - sign * mirror).abs() < 1e-12);
            }
            compared += 1;
        }
        assert!(compared > 3, "{compared}");
        let twice = once.again(act());
        for (first, second) in once.after.iter().zip(&twice) {
            for a in 0..2 {
                assert!((first.velocity()[a] - second.velocity()[a]).abs() < 1e-11, "{slides}");
            }
        }
    }
}

#[test]
fn shares_of_images_are_checked() {
    let field = constrained::<Quadratic, 3>(Boundaries::new(Vec::new(), Vec::new()));
    for share in [-0.1, 1.5, f64::NAN] {
        let surface = surface(&field, false, |mirror| vec![(mirror, share)]);
        let boundaries = Boundaries::new(Vec::new(), Vec::new()).with_surfaces(vec![surface]);
        let message = boundaries.check().expect_err("refused").to_string();
        assert!(message.contains("share of an image"), "{message}");
    }
}

#[test]
fn a_wall_between_nodes_and_a_half_space_act_alike() {
    let wall = Plane {
        point: [0.1, 0.0],
        ..wall(0, 0.0, Contact::Separate { friction: 0.3 }, [0.0; 2])
    };
    let half_space = Obstacle {
        shape: Box::new(HalfSpace {
            point: [0.1, 7.0],
            normal: [1.0, 0.0],
        }),
        contact: Contact::Separate { friction: 0.3 },
        velocity: [0.0; 2],
    };
    let first = constrained::<Quadratic, 3>(Boundaries::new(vec![wall], Vec::new()));
    let second = constrained::<Quadratic, 3>(Boundaries::new(Vec::new(), vec![half_space]));
    assert!(first.after == second.after && first.after != first.before);
}

#[test]
fn a_body_comes_to_rest_on_a_disk_and_not_inside() {
    let ball = Obstacle {
        shape: Box::new(Disk),
        contact: Contact::Separate { friction: 0.2 },
        velocity: [0.0; 2],
    };
    let positions: Vec<[f64; 2]> = uniform_cloud::<2>(200, 0.4, 8)
        .iter()
        .map(|x| [x[0] + 0.3, x[1] + 0.45])
        .collect();
    let particles = Particles::at_rest(positions, 0.16).with_elastic_state(vec![0.0008; 200]);
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 0.05).unwrap();
    let down = Pull::at_particles(|_| [0.0, -1.0]);
    let mut body = Mpm::new(particles, grid, Apic, neo_hookean(500.0), down)
        .with_boundary(Boundaries::new(Vec::new(), vec![ball]));
    for _ in 0..200 {
        body.step(&free(5e-4)).unwrap();
    }
    let depth = |x: &[f64; 2]| 0.4 - ((x[0] - 0.5).powi(2) + x[1].powi(2)).sqrt();
    let deepest = body.particles.positions.iter().map(depth).fold(f64::MIN, f64::max);
    assert!(deepest < 0.05, "a particle is {deepest} inside");
}

#[test]
fn a_particle_that_leaves_its_box_is_named() {
    let particles = Particles::at_rest(vec![[0.5, 0.5], [0.5, 0.9]], 1.0);
    let grid = SplineGrid::<Linear, 2, 2>::new([0.0; 2], 0.1).unwrap();
    let grid = grid.with_limits([0.0; 2], [1.0, 0.8]).unwrap();
    let gas = mpm_materials::IsothermalGas::CALIBRATED;
    let mut body = Mpm::new(particles, grid, mpm_core::Pic, gas, Pull::none());
    let error = body.step(&free(0.1)).unwrap_err();
    assert!(matches!(&error, MpmError::OutsideDomain { particle: 1, .. }), "{error}");
    let empty = SplineGrid::<Linear, 2, 2>::new([0.0; 2], 0.1).unwrap();
    assert!(empty.with_limits([0.0; 2], [1.0, 0.0]).is_err());
}

/// A body of 100 particles that moves within the unit square.
fn block<C: Boundary<2>>(
    boundary: C,
) -> Mpm<2, SplineGrid<Quadratic, 3, 2>, Apic, crate::scenes::Solid<2>, Pull<'static, 2>, C> {
    let mut particles = Particles::at_rest(uniform_cloud::<2>(100, 1.0, 9), 1.0).with_elastic_state(vec![0.01; 100]);
    particles.velocities.fill([0.3, -1.0]);
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], H).unwrap();
    Mpm::new(particles, grid, Apic, neo_hookean(10.0), Pull::none()).with_boundary(boundary)
}

/// A boundary that gives the nodes what is no velocity.
struct Undefined(f64);

impl Boundary<2> for Undefined {
    fn constrain<B: Basis<2>, N: GridNode<2>>(&mut self, _: &B, _: &GridMotion<2>, nodes: &mut [N]) {
        nodes[3].velocity_mut()[1] = self.0;
    }
}

#[test]
fn a_boundary_that_is_not_finite_is_an_error_and_moves_nothing() {
    for value in [f64::NAN, f64::INFINITY] {
        let mut body = block(Undefined(value));
        let before = body.particles.in_creation_order(&body.particles.positions);
        let error = body.step(&free(1e-3)).expect_err("no velocity");
        assert!(matches!(error, MpmError::VelocityNotFinite { .. }), "{error}");
        assert_eq!(body.particles.in_creation_order(&body.particles.positions), before);
        assert!(
            body.particles
                .deformation_gradients
                .iter()
                .all(|gradient| *gradient == mpm_tensor::Matrix::IDENTITY)
        );
    }
}

#[test]
fn surfaces_without_a_place_or_a_velocity_are_refused() {
    for value in [f64::NAN, f64::INFINITY] {
        for (point, velocity, field) in [([value, 0.0], [0.0; 2], "point"), ([0.0; 2], [0.0, value], "velocity")] {
            let floor = Plane {
                point,
                ..wall(1, 0.0, Contact::Slip, velocity)
            };
            let below = Obstacle {
                shape: Box::new(HalfSpace {
                    point,
                    normal: [0.0, 1.0],
                }),
                contact: Contact::Slip,
                velocity,
            };
            let walled = Boundaries::new(vec![floor], Vec::new());
            let blocked = Boundaries::new(Vec::new(), vec![below]);
            for boundaries in [walled, blocked] {
                match block(boundaries).step(&free(1e-3)) {
                    Err(MpmError::InvalidParameter { field: named, .. }) => assert_eq!(named, field),
                    other => panic!("{field} {value}: {other:?}"),
                }
            }
        }
    }
}

#[test]
fn surfaces_without_a_unit_normal_or_a_friction_are_refused() {
    let rough = |friction| Contact::Separate { friction };
    let floor = |contact, normal| Plane {
        normal,
        ..wall(1, 0.0, contact, [0.0; 2])
    };
    let below = |contact, normal| Obstacle {
        shape: Box::new(HalfSpace {
            point: [0.0; 2],
            normal,
        }),
        contact,
        velocity: [0.0; 2],
    };
    for (contact, normal, field) in [
        (Contact::Slip, [0.0, 2.0], "normal"),
        (Contact::Stick, [0.0, 0.0], "normal"),
        (rough(0.0), [f64::NAN, 1.0], "normal"),
        (rough(-1.0), [0.0, 1.0], "friction"),
        (rough(f64::NAN), [0.0, 1.0], "friction"),
    ] {
        let walled = Boundaries::new(vec![floor(contact, normal)], Vec::new());
        let blocked = Boundaries::new(Vec::new(), vec![below(contact, normal)]);
        for boundaries in [walled, blocked] {
            match block(boundaries).step(&free(1e-3)) {
                Err(MpmError::InvalidParameter { field: named, .. }) => assert_eq!(named, field),
                other => panic!("{contact:?}, {normal:?}: {other:?}"),
            }
        }
    }
}
