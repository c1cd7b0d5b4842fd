//! Contact that is solved at the nodes, beside the same potential as a force on particles.

use mpm_core::{
    Apic, BodyForce, ContactPoint, ContactPotential, Flip, ForceLocation, Friction, Mpm, MpmError, Particles, Pic,
    Sites, SplineGrid, Transfer,
};
use mpm_kernels::Quadratic;
use mpm_materials::IsothermalGas;

use crate::scenes::{Pull, bits, free, neo_hookean, uniform_cloud};

/// A floor at y = 0 with b(g) = −k (g − ĝ)² ln(g/ĝ), and gravity.
#[derive(Clone, Copy)]
struct Floor {
    stiffness: f64,
    gap: f64,
    area: f64,
    gravity: f64,
    friction: f64,
    implicit: bool,
}

const FLOOR: Floor = Floor {
    stiffness: 3.0,
    gap: 0.1,
    area: 0.3,
    gravity: 0.0,
    friction: 0.0,
    implicit: true,
};

impl Floor {
    fn energy(&self, g: f64) -> f64 {
        if g < self.gap {
            -self.stiffness * (g - self.gap).powi(2) * (g / self.gap).ln()
        } else {
            0.0
        }
    }
}

impl BodyForce<2> for Floor {
    fn location(&self) -> ForceLocation {
        ForceLocation::Particles
    }

    /// With particles of mass 1.
    fn at_particles(&mut self, sites: &Sites<2>, accelerations: &mut [[f64; 2]]) -> Result<(), MpmError> {
        for (x, acceleration) in sites.positions.iter().zip(accelerations) {
            let pushed = if self.implicit {
                0.0
            } else {
                self.area * self.pressure_and_stiffness(x[1]).0
            };
            *acceleration = [0.0, pushed - self.gravity];
        }
        Ok(())
    }

    fn contact(&self) -> Option<&dyn ContactPotential<2>> {
        self.implicit.then_some(self)
    }

    fn friction(&self) -> Option<Friction<'_, 2>> {
        (self.friction > 0.0).then_some(Friction {
            coefficient: self.friction,
            full_speed: 0.0,
            normal_forces: &[],
        })
    }
}

impl ContactPotential<2> for Floor {
    fn points(&self, sites: &Sites<2>, reach: f64, points: &mut Vec<ContactPoint<2>>) {
        for (particle, x) in sites.positions.iter().enumerate() {
            if x[1] < self.gap + reach {
                points.push(ContactPoint {
                    particle,
                    area: self.area,
                    distance: x[1],
                    normal: [0.0, 1.0],
                });
            }
        }
    }

    fn pressure_and_stiffness(&self, g: f64) -> (f64, f64) {
        if g >= self.gap {
            return (0.0, 0.0);
        }
        let (overlap, logarithm) = (g - self.gap, (g / self.gap).ln());
        let quotient = overlap / g;
        (
            self.stiffness * (2.0 * overlap * logarithm + overlap * quotient),
            self.stiffness * (-2.0 * logarithm - 4.0 * quotient + quotient * quotient),
        )
    }
}

/// A body of particles of mass 1 that do not push each other.
fn dust<T: Transfer<2>>(
    positions: Vec<[f64; 2]>,
    velocity: [f64; 2],
    transfer: T,
    floor: Floor,
) -> Mpm<2, SplineGrid<Quadratic, 3, 2>, T, IsothermalGas, Pull<'static, 2>> {
    let total = positions.len() as f64;
    let mut particles = Particles::at_rest(positions, total);
    particles.velocities.fill(velocity);
    let grid = SplineGrid::new([0.013, 0.027], 0.5).expect("a grid");
    Mpm::new(
        particles,
        grid,
        transfer,
        IsothermalGas::new(1e-300).expect("a gas"),
        Pull::by(floor),
    )
}

/// The share of its energy that a particle has after a bounce, in steps of `share` / ω, ω² = A b''(g) / m where it turns. It comes with a tenth of k A ĝ².
fn kept(floor: Floor, share: f64) -> f64 {
    let energy = 0.1 * floor.stiffness * floor.area * floor.gap * floor.gap;
    let (mut low, mut high) = (1e-9 * floor.gap, floor.gap);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if floor.area * floor.energy(middle) > energy {
            low = middle;
        } else {
            high = middle;
        }
    }
    let rate = (floor.area * floor.pressure_and_stiffness(low).1).sqrt();
    let speed = (2.0 * energy).sqrt();
    let mut body = dust(vec![[0.3, 0.15]], [0.2, -speed], Flip::blend(1.0), floor);
    for _ in 0..100_000 {
        body.step(&free(share / rate)).expect("outside");
        let (x, v) = (body.particles.positions[0], body.particles.velocities[0]);
        if v[1] >= 0.0 && x[1] >= floor.gap {
            assert!((v[0] - 0.2).abs() < 1e-12, "no force along the floor");
            return v[1] * v[1] / (2.0 * energy);
        }
    }
    panic!("it never comes back");
}

/// One particle is one body of all its nodes, so that a step is backward Euler for it. What a bounce loses is 2.3 Δt ω where that is small, and some even where the step is a hundred times the
/// spring's; as a force at the start of the step the same potential keeps the energy, but only in short steps.
#[test]
fn a_bounce_loses_energy_in_proportion_to_the_step() {
    let explicit = Floor {
        implicit: false,
        ..FLOOR
    };
    assert!((1.0 - kept(explicit, 0.25)).abs() < 0.002);
    for (share, lost) in [
        (0.001, 0.0024),
        (0.01, 0.0233),
        (0.1, 0.205),
        (1.0, 0.835),
        (100.0, 1.0),
    ] {
        let found = 1.0 - kept(FLOOR, share);
        assert!((found / lost - 1.0).abs() < 0.03, "{share}: {found}");
        assert!(found > 0.0 && found < 1.0);
    }
}

/// However fast and however many, in steps that would carry them far through the floor.
#[test]
fn no_particle_reaches_a_plane_and_energy_never_grows() {
    for stiffness in [1e-3, 1.0, 1e6] {
        let floor = Floor {
            stiffness,
            gravity: 10.0,
            friction: 0.3,
            ..FLOOR
        };
        let cloud: Vec<[f64; 2]> = uniform_cloud::<2>(200, 1.0, 4)
            .iter()
            .map(|x| [x[0], x[1] + 1.05])
            .collect();
        let mut body = dust(cloud, [3.0, -20.0], Pic, floor);
        let energy = |body: &Mpm<2, SplineGrid<Quadratic, 3, 2>, Pic, IsothermalGas, Pull<2>>| {
            let each = body.particles.positions.iter();
            let stored: f64 = each
                .map(|x| floor.gravity * x[1] + floor.area * floor.energy(x[1]))
                .sum();
            stored + body.particles.kinetic_energy()
        };
        let mut before = energy(&body);
        for _ in 0..40 {
            body.step(&free(0.05)).expect("outside");
            let now = energy(&body);
            let lowest = body
                .particles
                .positions
                .iter()
                .fold(f64::INFINITY, |low, x| low.min(x[1]));
            assert!(lowest > 0.0, "{stiffness}: {lowest}");
            assert!(now <= before + 1e-9 * before.abs(), "{stiffness}: {now} from {before}");
            before = now;
        }
    }
}

/// Particles that lie on the floor press on it with their weight, in steps of fifty times the time of the contact's spring.
#[test]
fn what_rests_presses_with_its_weight() {
    let floor = Floor { gravity: 1e-3, ..FLOOR };
    let force = |g: f64| floor.area * floor.pressure_and_stiffness(g).0;
    let (mut low, mut high) = (0.5 * floor.gap, floor.gap);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if force(middle) > floor.gravity {
            low = middle;
        } else {
            high = middle;
        }
    }
    let rate = (floor.area * floor.pressure_and_stiffness(low).1).sqrt();
    let layer = (0..20).map(|k| [0.07 * f64::from(k), 1.01 * floor.gap]).collect();
    let mut body = dust(layer, [0.0, 0.0], Pic, floor);
    for _ in 0..30 {
        body.step(&free(50.0 / rate)).expect("outside");
    }
    for x in &body.particles.positions {
        let pressed = force(x[1]);
        assert!((pressed / floor.gravity - 1.0).abs() < 1e-6, "{pressed}");
    }
}

/// A step that a particle would have to be taken out of the floor in is an error with its number, and nothing has moved.
#[test]
fn a_particle_at_the_surface_is_an_error() {
    let mut body = dust(vec![[0.3, 0.15], [0.2, -0.01], [0.1, 0.4]], [0.0, 0.0], Apic, FLOOR);
    let error = body.step(&free(0.01)).expect_err("inside");
    assert_eq!(
        error,
        MpmError::Penetration {
            particle: 1,
            distance: -0.01
        }
    );
    assert_eq!(
        body.particles.in_creation_order(&body.particles.positions)[1],
        [0.2, -0.01]
    );
}

#[test]
fn any_number_of_threads_gives_the_same_bits() {
    let scene = || {
        let cloud = uniform_cloud::<2>(5000, 2.0, 9)
            .iter()
            .map(|x| [x[0], x[1] + 2.05])
            .collect();
        let mut particles = Particles::at_rest(cloud, 5000.0).with_elastic_state(vec![16.0 / 5000.0; 5000]);
        particles.velocities.fill([0.5, -3.0]);
        let floor = Floor {
            stiffness: 1e3,
            friction: 0.4,
            ..FLOOR
        };
        let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0, 0.0], 0.1).expect("a grid");
        let mut body = Mpm::new(particles, grid, Apic, neo_hookean(1e4), Pull::by(floor));
        // It touches the floor in the second step.
        for _ in 0..10 {
            body.step(&free(1e-2)).expect("outside");
        }
        let p = &body.particles;
        [bits(&p.positions), bits(&p.velocities)].concat()
    };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("threads");
        pool.install(scene)
    };
    let one = on(1);
    for threads in [2, 3] {
        assert!(one == on(threads), "{threads} threads give other bits than one");
    }
}
