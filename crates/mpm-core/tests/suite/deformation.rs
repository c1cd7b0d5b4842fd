//! When and how particles deform: the orders of a step, averaged volume ratios, moving least squares, materials with memory.

use mpm_core::{
    Apic, Basis, Continuum, Flip, Medium, Mls, Mpm, MpmError, Particles, Pic, SplineGrid, StressUpdate, Transfer,
    VolumeAveraging,
};
use mpm_kernels::{Cubic, Linear, Quadratic, SecondMoment, Spline};
use mpm_materials::{DeformationError, ElasticModuli, Law, NeoHookean};
use mpm_tensor::Matrix;

use crate::scenes::{AnyOrder, Pull, Solid, bits, free, neo_hookean, uniform_cloud};

const COUNT: usize = 300;

const ALL: [VolumeAveraging; 3] = [VolumeAveraging::Off, VolumeAveraging::Ratios, VolumeAveraging::Changes];

fn body<S: Spline<W>, T: Transfer<2>, M: Medium<2, State = ()>, const W: usize>(
    transfer: T,
    medium: M,
) -> Mpm<2, SplineGrid<S, W, 2>, T, M, Pull<'static, 2>> {
    let mut particles = Particles::at_rest(uniform_cloud::<2>(COUNT, 1.0, 11), 1.0);
    particles.velocities = particles.positions.iter().map(|x| [0.3 * x[1], x[0] * x[0]]).collect();
    let particles = particles.with_elastic_state(vec![1.0 / COUNT as f64; COUNT]);
    let grid = SplineGrid::new([0.0; 2], 0.2).unwrap();
    Mpm::new(particles, grid, transfer, medium, Pull::none())
}

/// The same of a solid, in the order that is the default.
fn solid<S: Spline<W>, T: Transfer<2>, const W: usize>(
    transfer: T,
) -> Mpm<2, SplineGrid<S, W, 2>, T, Solid<2>, Pull<'static, 2>> {
    body(transfer, neo_hookean(20.0))
}

/// A solid that deforms in whatever order.
fn any_order(young: f64) -> AnyOrder<2> {
    neo_hookean(young).0
}

/// Where the particles are at time 0.04.
fn after<T: Transfer<2>>(transfer: T, order: StressUpdate, averaging: VolumeAveraging, steps: usize) -> Vec<[f64; 2]> {
    let mut body = body::<Quadratic, _, _, 3>(transfer, any_order(20.0));
    body.stress_update = order;
    body.volume_averaging = averaging;
    for _ in 0..steps {
        body.step(&free(0.04 / steps as f64)).unwrap();
    }
    assert!((body.time - 0.04).abs() < 1e-12);
    body.particles.in_creation_order(&body.particles.positions)
}

fn distance(a: &[[f64; 2]], b: &[[f64; 2]]) -> f64 {
    a.iter()
        .zip(b)
        .map(|(a, b)| (a[0] - b[0]).hypot(a[1] - b[1]))
        .fold(0.0, f64::max)
}

#[test]
fn the_orders_of_a_step_differ_by_the_time_step() {
    for averaging in ALL {
        let reference = after(Flip::blend(1.0), StressUpdate::Last, averaging, 192);
        for order in [StressUpdate::First, StressUpdate::Last, StressUpdate::ModifiedLast] {
            let coarse = distance(&after(Flip::blend(1.0), order, averaging, 8), &reference);
            let fine = distance(&after(Flip::blend(1.0), order, averaging, 32), &reference);
            assert!(coarse > 1e-9 && fine < 0.35 * coarse, "{order:?}: {coarse} then {fine}");
        }
    }
}

/// J̄ by sums over all pairs of particles and nodes, from particles that have been strained.
#[test]
fn averaged_volume_ratios_are_those_of_the_formula() {
    let strained = |averaging| {
        let mut body = body::<Quadratic, _, _, 3>(Pic, any_order(20.0));
        let strain = |x: &[f64; 2]| Matrix([[1.0 + 0.02 * x[0], 0.01], [0.0, 1.0 - 0.03 * x[1] * x[0]]]);
        body.particles.deformation_gradients = body.particles.positions.iter().map(strain).collect();
        body.volume_averaging = averaging;
        let before = body.particles.deformation_gradients.clone();
        body.step(&free(0.0005)).unwrap();
        let after = body.particles.in_creation_order(&body.particles.deformation_gradients);
        (before, after)
    };
    let start = uniform_cloud::<2>(COUNT, 1.0, 11);
    let (before, trial) = strained(VolumeAveraging::Off);
    let weight = |x: &[f64; 2], i: i32, j: i32| {
        Quadratic.value(x[0] / 0.2 - f64::from(i)) * Quadratic.value(x[1] / 0.2 - f64::from(j))
    };
    for averaging in [VolumeAveraging::Ratios, VolumeAveraging::Changes] {
        let changes = averaging == VolumeAveraging::Changes;
        let was = |q: usize| if changes { before[q].determinant() } else { 1.0 };
        let drawn = |q: usize| {
            let change = trial[q] * before[q].inverse().unwrap();
            let symmetric = (change + change.transpose()) * 0.5;
            let shear = symmetric - Matrix::IDENTITY * (0.5 * symmetric.trace());
            if changes {
                (100.0 * shear.frobenius_norm()).min(1.0)
            } else {
                0.0
            }
        };
        let result = strained(averaging).1;
        for p in 0..COUNT {
            let (mut change, mut mean) = (0.0, 0.0);
            for i in -2..8 {
                for j in -2..8 {
                    let sum =
                        |of: &dyn Fn(usize) -> f64| (0..COUNT).map(|q| weight(&start[q], i, j) * of(q)).sum::<f64>();
                    let (volume, old, new) = (sum(&|_| 1.0), sum(&was), sum(&|q| trial[q].determinant()));
                    if volume > 0.0 {
                        change += weight(&start[p], i, j) * new / old;
                        mean += weight(&start[p], i, j) * new / volume;
                    }
                }
            }
            let averaged = (was(p) * change).powf(1.0 - drawn(p)) * mean.powf(drawn(p));
            let expected = trial[p] * (averaged / trial[p].determinant()).sqrt();
            assert!((result[p] - expected).frobenius_norm() < 1e-13, "{averaging:?}");
            assert!((result[p].determinant() - averaged).abs() < 1e-13, "{averaging:?}");
        }
    }
}

/// On hat functions C_p is the gradient of the velocity, so that both transfers are one.
#[test]
fn moving_least_squares_on_hats_are_apic() {
    let mut apic = solid::<Linear, _, 2>(Apic);
    let mut mls = solid::<Linear, _, 2>(Mls);
    for _ in 0..10 {
        apic.step(&free(0.002)).unwrap();
        mls.step(&free(0.002)).unwrap();
    }
    assert!(distance(&apic.particles.positions, &mls.particles.positions) < 1e-14);
}

/// F_p of a linear field of velocities is exact with either gradient.
fn linear_field<S: Spline<W>, T: Transfer<2>, const W: usize>(transfer: T, tolerance: f64) {
    let gradient = Matrix([[0.1, 0.4], [-0.2, 0.3]]);
    let mut body = solid::<S, T, W>(transfer);
    body.particles.velocities = body.particles.positions.iter().map(|x| gradient.apply(x)).collect();
    let SecondMoment::Constant(moment) = S::SECOND_MOMENT else {
        panic!("{} has no second moment for all positions", S::NAME);
    };
    let moment = moment * 0.04;
    body.particles.affine.fill(gradient * moment);
    body.step(&free(0.01)).unwrap();
    for deformation in &body.particles.deformation_gradients {
        let error = *deformation - (Matrix::IDENTITY + gradient * 0.01);
        assert!(error.frobenius_norm() < tolerance, "{} off by {error:?}", S::NAME);
    }
}

#[test]
fn a_linear_field_deforms_all_particles_alike() {
    linear_field::<Quadratic, Apic, 3>(Apic, 1e-15);
    linear_field::<Quadratic, Mls, 3>(Mls, 1e-15);
    linear_field::<Cubic, Mls, 4>(Mls, 1e-15);
}

/// Remembers how often it was asked to admit a deformation, and resists the rate of volume change.
struct Remembering(NeoHookean);

#[allow(non_snake_case)]
impl Law<2> for Remembering {
    type State = (u32, f64);

    fn rate_dependent(&self) -> bool {
        true
    }

    fn advance(&self, trial: &Matrix<2>, state: &mut (u32, f64)) -> Matrix<2> {
        state.0 += 1;
        *trial
    }

    fn energy_density(&self, F: &Matrix<2>, _: &(u32, f64)) -> f64 {
        Law::energy_density(&self.0, F, &())
    }

    fn kirchhoff_stress(&self, F: &Matrix<2>, state: &(u32, f64), velocity_gradient: &Matrix<2>) -> Matrix<2> {
        let elastic = Law::kirchhoff_stress(&self.0, F, &(), velocity_gradient);
        elastic + Matrix::IDENTITY * (state.1 * velocity_gradient.trace())
    }

    fn wave_speed(&self, F: &Matrix<2>, _: &(u32, f64), reference_density: f64) -> f64 {
        Law::wave_speed(&self.0, F, &(), reference_density)
    }

    fn check(&self, F: &Matrix<2>) -> Result<(), DeformationError> {
        Law::check(&self.0, F)
    }
}

fn remembering(viscosity: f64, order: StressUpdate, averaging: VolumeAveraging) -> Particles<2, (u32, f64)> {
    let mut particles = Particles::at_rest(uniform_cloud::<2>(COUNT, 1.0, 11), 1.0);
    particles.velocities = particles.positions.iter().map(|x| [2.0 * x[0], 2.0 * x[1]]).collect();
    let states = (0..COUNT).map(|_| (0, viscosity)).collect();
    let particles = particles.with_states(vec![1.0 / COUNT as f64; COUNT], states);
    let law = Remembering(NeoHookean::new(ElasticModuli::new(20.0, 0.3).unwrap()));
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 0.2).unwrap();
    let mut body = Mpm::new(particles, grid, Apic, Continuum { law }, Pull::none());
    body.stress_update = order;
    body.volume_averaging = averaging;
    for _ in 0..5 {
        body.step(&free(0.002)).unwrap();
    }
    body.particles
}

#[test]
fn a_material_remembers_and_feels_the_rate_of_deformation() {
    for order in [StressUpdate::First, StressUpdate::Last, StressUpdate::ModifiedLast] {
        for averaging in ALL {
            let thin = remembering(0.0, order, averaging);
            let thick = remembering(0.5, order, averaging);
            assert!(thin.states.iter().all(|state| state.0 == 5), "once per step, {order:?}");
            assert_eq!(thin.velocity_gradients.len(), COUNT);
            let volume = |p: &Particles<2, _>| p.deformation_gradients.iter().map(Matrix::determinant).sum::<f64>();
            assert!(volume(&thick) < volume(&thin), "viscosity resists expansion, {order:?}");
        }
    }
}

/// A step so long that it turns particles inside out says so by one of them, whether they have deformed before forces or are found by the step that follows.
#[test]
fn whoever_is_turned_inside_out_is_named_in_any_order() {
    for order in [StressUpdate::First, StressUpdate::Last, StressUpdate::ModifiedLast] {
        let mut body = body::<Quadratic, _, _, 3>(Apic, any_order(20.0));
        body.stress_update = order;
        body.particles.velocities = body.particles.positions.iter().map(|x| [-50.0 * x[0], 0.0]).collect();
        let error = (0..2).find_map(|_| body.step(&free(0.05)).err());
        assert!(
            matches!(error, Some(MpmError::Deformation { .. })),
            "{order:?}: {error:?}"
        );
    }
}

#[test]
fn states_travel_with_their_particles() {
    let positions = uniform_cloud::<2>(COUNT, 1.0, 11);
    let states: Vec<(u32, f64)> = positions.iter().map(|x| (0, x[0])).collect();
    let particles = Particles::at_rest(positions.clone(), 1.0).with_states(vec![1.0 / COUNT as f64; COUNT], states);
    let law = Remembering(NeoHookean::new(ElasticModuli::new(20.0, 0.3).unwrap()));
    let grid = SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 0.05).unwrap();
    let mut body = Mpm::new(particles, grid, Apic, Continuum { law }, Pull::none());
    body.step(&free(0.001)).unwrap();
    let sorted = body.particles.in_creation_order(&body.particles.states);
    assert!(sorted.iter().zip(&positions).all(|(state, x)| state.1 == x[0]));
    assert!(bits(&body.particles.positions) != bits(&positions) && body.basis.node_count() > 0);
}

#[test]
fn a_medium_with_a_fixed_order_moves_as_without_and_refuses_other_orders() {
    let cloud = uniform_cloud::<2>(200, 1.0, 4);
    let grid = || SplineGrid::<Quadratic, 3, 2>::new([0.0; 2], 0.2).unwrap();
    let particles = || Particles::at_rest(cloud.clone(), 1.0).with_elastic_state(vec![1.0 / 200.0; 200]);
    let mut free_order = Mpm::new(particles(), grid(), Apic, any_order(10.0), Pull::none());
    let mut fixed = Mpm::new(particles(), grid(), Apic, neo_hookean(10.0), Pull::none());
    free_order.particles.velocities = cloud.iter().map(|x| [x[1], -x[0]]).collect();
    fixed.particles.velocities.clone_from(&free_order.particles.velocities);
    for _ in 0..5 {
        free_order.step(&free(0.01)).unwrap();
        fixed.step(&free(0.01)).unwrap();
    }
    assert_eq!(free_order.particles.positions, fixed.particles.positions);
    assert_eq!(
        free_order.particles.deformation_gradients,
        fixed.particles.deformation_gradients
    );
    fixed.stress_update = StressUpdate::First;
    let error = fixed.step(&free(0.01)).unwrap_err().to_string();
    assert!(error.contains("stress_update"), "{error}");
}
