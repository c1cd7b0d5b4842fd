//! How long a step is and how far it moves a particle.

use mpm_core::{Apic, Flip, Medium, Mpm, MpmError, Particles, Pic, SplineGrid, StepControl, Transfer};
use mpm_kernels::{Cubic, Linear, Quadratic, Spline};
use mpm_materials::{ElasticModuli, IsothermalGas, NeoHookean};
use mpm_tensor::Matrix;
use proptest::prelude::*;

use crate::scenes::{Pull, distance, free, gaussian_cloud, solid};

/// A force that would throw particles across the domain moves none farther than the limit.
fn stays_within<S: Spline<W>, T: Transfer<D>, const W: usize, const D: usize>(transfer: T, strength: f64, limit: f64) {
    let h = 0.5;
    let at_particles = Pull::at_particles(|x| x.map(|c| -strength * c));
    let at_nodes = Pull::at_nodes(|x, _| x.map(|c| -strength * c));
    for force in [at_particles, at_nodes] {
        let particles = Particles::at_rest(gaussian_cloud::<D>(60, 4), 1.0);
        let grid = SplineGrid::<S, W, D>::new([0.1; D], h).unwrap();
        let mut mpm = Mpm::new(particles, grid, transfer, IsothermalGas::CALIBRATED, force);
        let mut control = free(0.3);
        control.displacement = limit;
        for _ in 0..5 {
            let before = mpm.particles.in_creation_order(&mpm.particles.positions);
            let reported = mpm.step(&control).unwrap().displacement;
            let after = mpm.particles.in_creation_order(&mpm.particles.positions);
            let moves = before.iter().zip(&after).map(|(x, y)| distance(x, y));
            let farthest = moves.fold(0.0, f64::max);
            assert!(farthest <= limit * h * (1.0 + 1e-12), "{}: moved {farthest}", S::NAME);
            assert!(
                reported >= farthest / h * (1.0 - 1e-12),
                "{}: reported {reported}",
                S::NAME
            );
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    #[test]
    fn no_particle_moves_farther_than_the_limit(exponent in 0.0..150.0f64, limit in 0.01..2.0f64) {
        let strength = 10f64.powf(exponent);
        stays_within::<Linear, _, 2, 2>(Pic, strength, limit);
        stays_within::<Quadratic, _, 3, 2>(Pic, strength, limit);
        stays_within::<Quadratic, _, 3, 2>(Apic, strength, limit);
        stays_within::<Quadratic, _, 3, 1>(Pic, strength, limit);
        stays_within::<Quadratic, _, 3, 3>(Pic, strength, limit);
        stays_within::<Cubic, _, 4, 2>(Flip::blend(1.0), strength, limit);
        stays_within::<Linear, _, 2, 2>(Flip::blend(0.5), strength, limit);
    }

    #[test]
    fn the_time_step_is_the_courant_one(h in 0.01..10.0f64, c in 0.0..10.0f64, v in 0.0..10.0f64, courant in 0.01..2.0f64) {
        let mut control = free(0.1);
        prop_assert_eq!(control.next_time_step(h, c, v), Ok(0.1));
        control.courant = courant;
        let bound = courant * h / (c + v);
        prop_assert_eq!(control.next_time_step(h, c, v), Ok(if bound < 0.1 { bound } else { 0.1 }));
    }
}

#[test]
fn a_body_at_rest_without_waves_takes_the_longest_step() {
    let mut control = free(0.1);
    control.courant = 0.5;
    assert_eq!(control.next_time_step(1.0, 0.0, 0.0), Ok(0.1));
}

#[test]
fn speeds_that_leave_no_time_step_are_an_error() {
    let mut control = free(0.1);
    control.courant = 0.5;
    for (wave_speed, particle_speed) in [
        (f64::INFINITY, 0.0),
        (1.0, f64::INFINITY),
        (f64::NAN, 0.0),
        (0.0, f64::NAN),
    ] {
        let error = control.next_time_step(1.0, wave_speed, particle_speed);
        assert!(matches!(error, Err(MpmError::NoTimeStep { .. })), "{error:?}");
    }
}

/// The step of a gas moved by PIC, or of a solid by APIC.
fn time_step<T: Transfer<1>, M: Medium<1, State = ()>>(
    particles: Particles<1>,
    (transfer, medium): (T, M),
    control: &StepControl,
) -> f64 {
    let grid = SplineGrid::<Quadratic, 3, 1>::new([0.0], 0.5).unwrap();
    let mut mpm = Mpm::new(particles, grid, transfer, medium, Pull::none());
    mpm.step(control).unwrap().time_step
}

#[test]
fn the_step_knows_the_waves_of_its_medium() {
    let mut control = free(100.0);
    control.courant = 0.3;
    let mut particles = Particles::at_rest(vec![[0.0], [0.4], [1.3]], 3.0);
    let gas = IsothermalGas::new(4.0).unwrap(); // c = 2
    assert_eq!(time_step(particles.clone(), (Pic, gas), &control), 0.3 * 0.5 / 2.0);
    particles.velocities[1] = [-3.0];
    assert_eq!(time_step(particles.clone(), (Pic, gas), &control), 0.3 * 0.5 / 5.0);

    // λ + 2μ = 8, ρ₀ = 1 / ½: c = 2; the second particle is lighter per volume by 4: c = 4.
    let stiff = solid(NeoHookean::new(ElasticModuli::from_lame(0.0, 4.0).unwrap()));
    particles.velocities[1] = [0.0];
    let even = particles.clone().with_elastic_state(vec![0.5; 3]);
    assert!((time_step(even, (Apic, stiff), &control) - 0.3 * 0.5 / 2.0).abs() < 1e-15);
    let uneven = particles.with_elastic_state(vec![0.5, 2.0, 0.5]);
    assert!((time_step(uneven, (Apic, stiff), &control) - 0.3 * 0.5 / 4.0).abs() < 1e-15);
}

/// A particle alone, whose nodes carry nothing else, is the first to be unstable. With s = Σ_i w′² h² / w along each axis, 4 at a node and up to 6 between two, a volumetric strain is multiplied in a step by
/// 1 − C² D s with FLIP, which remembers no rate of it; affine velocities remember one. So C² D s < 2, or with these C² D (s − 2) < 2.
#[test]
fn a_particle_alone_is_stable_up_to_its_courant_number() {
    fn strain<T: Transfer<2>>(transfer: T, place: f64, courant: f64) -> f64 {
        let mut particles = Particles::at_rest(vec![[place; 2]], 1.0).with_elastic_state(vec![1.0]);
        particles.deformation_gradients[0] = Matrix::IDENTITY * (1.0 + 1e-9);
        let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 1.0).unwrap();
        let law = NeoHookean::new(ElasticModuli::from_lame(1.0, 1e-6).unwrap());
        let mut mpm = Mpm::new(particles, grid, transfer, solid(law), Pull::none());
        for _ in 0..300 {
            if mpm.step(&free(courant)).is_err() {
                return f64::INFINITY; // inside out
            }
        }
        (mpm.particles.deformation_gradients[0].determinant() - 1.0).abs()
    }
    let flip = |place, courant| strain(Flip::blend(1.0), place, courant);
    let affine = |place, courant| strain(Apic, place, courant);
    for place in [0.0f64, 0.3, 0.49] {
        let s = 4.0 + 4.0 * place * place / (0.75 - place * place);
        let (of_flip, of_affine) = ((1.0 / s).sqrt(), (1.0 / (s - 2.0)).sqrt());
        assert!(flip(place, 0.99 * of_flip) < 1e-7 && flip(place, 1.01 * of_flip) > 1e-5);
        assert!(affine(place, 0.99 * of_affine) < 1e-7 && affine(place, 1.01 * of_affine) > 1e-5);
    }
}

/// One particle alone keeps its velocity but for friction: with PIC and FLIP alike it decays as e^{−γt}.
#[test]
fn friction_decays_exponentially() {
    fn speed<T: Transfer<2>>(transfer: T) -> f64 {
        let mut particles = Particles::at_rest(vec![[0.2, 0.3]], 1.0);
        particles.velocities[0] = [1.0, -2.0];
        let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 1.0).unwrap();
        // The gas pushes no particle of its own: Σ_i w ∇w m / m_i = Σ_i ∇w = 0.
        let mut mpm = Mpm::new(particles, grid, transfer, IsothermalGas::CALIBRATED, Pull::none());
        let mut control = free(0.05);
        control.friction = 0.8;
        for _ in 0..20 {
            mpm.step(&control).unwrap();
        }
        let [x, y] = mpm.particles.velocities[0];
        assert!((y + 2.0 * x).abs() < 1e-12);
        x
    }
    let expected = (-0.8f64).exp();
    assert!((speed(Pic) - expected).abs() < 1e-12);
    assert!((speed(Flip::blend(1.0)) - expected).abs() < 1e-12);
    assert!((speed(Flip::blend(0.3)) - expected).abs() < 1e-12);
}

#[test]
fn limits_out_of_range_are_named() {
    let good = free(0.1);
    assert_eq!(good.check(), Ok(()));
    type Case<'a> = (&'a str, &'a [f64], fn(&mut StepControl, f64));
    let cases: [Case; 4] = [
        ("time_step", &[0.0, -1.0, f64::NAN, f64::INFINITY], |c, v| {
            c.time_step = v
        }),
        ("courant", &[0.0, -1.0, f64::NAN], |c, v| c.courant = v),
        ("displacement", &[0.0, -1.0, f64::NAN], |c, v| c.displacement = v),
        ("friction", &[-1e-9, f64::NAN, f64::INFINITY], |c, v| c.friction = v),
    ];
    for (name, values, set) in cases {
        for &bad in values {
            let mut control = good;
            set(&mut control, bad);
            let Err(MpmError::InvalidParameter { field, value, .. }) = control.check() else {
                panic!("{name} = {bad} was accepted");
            };
            assert!(field == name && value.to_bits() == bad.to_bits());
            let mut mpm = Mpm::new(
                Particles::at_rest(vec![[0.0]], 1.0),
                SplineGrid::<Quadratic, 3, 1>::new([0.0], 1.0).unwrap(),
                Pic,
                IsothermalGas::CALIBRATED,
                Pull::none(),
            );
            assert!(mpm.step(&control).is_err());
        }
    }
}
