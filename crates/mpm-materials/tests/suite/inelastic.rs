//! What every law with a return mapping must satisfy along random walks, D = 1…4.

use mpm_materials::{DruckerPrager, DruckerPragerState, ElasticModuli, Law, SofteningHencky, SofteningState};
use mpm_tensor::Matrix;
use proptest::prelude::*;

use crate::common::{STEPS, Sample, derivative_of, is_exact_at_rest, rotation, sample, stiffness_of};

/// A law and how far a stress is outside what it admits, in units of stress.
struct Member<const D: usize, L: Law<D>> {
    name: &'static str,
    law: L,
    excess: fn(&L, &Matrix<D>, &L::State) -> f64,
}

/// A trial along a walk and what becomes of it.
struct Step<const D: usize, S> {
    trial: Matrix<D>,
    before: S,
    F: Matrix<D>,
    after: S,
}

/// The steps F ← advance((I + Δt L) F) from rest.
fn walk<const D: usize, L: Law<D>>(law: &L, sample: &Sample) -> Vec<Step<D, L::State>> {
    let (mut F, mut after) = (Matrix::IDENTITY, L::State::default());
    let step = |index| {
        let trial = (Matrix::IDENTITY + sample.increment(index)) * F;
        let before = after;
        F = law.advance(&trial, &mut after);
        Step {
            trial,
            before,
            F,
            after,
        }
    };
    (0..STEPS).map(step).collect()
}

/// ‖dev τ‖ of the given principal or other diagonal part and the rest of the matrix.
fn deviator_norm<const D: usize>(stress: &Matrix<D>, out_of_plane: f64, left_out: f64) -> f64 {
    let mean = (stress.trace() + left_out * out_of_plane) / (D as f64 + left_out);
    let deviator = *stress - Matrix::IDENTITY * mean;
    let rest = out_of_plane - mean;
    (deviator.contract(&deviator) + left_out * rest * rest).sqrt()
}

/// f = ‖dev τ‖ − κ, with the stress along the axes left out by Hooke's law.
fn yield_excess<const D: usize>(law: &SofteningHencky, F: &Matrix<D>, state: &SofteningState) -> f64 {
    let stress = law.kirchhoff_stress(F, state, &Matrix::ZERO);
    let left_out = 3.0 - D.min(3) as f64;
    let strain = state.out_of_plane_strain;
    let moduli = law.moduli();
    let out_of_plane = 2.0 * moduli.shear_modulus() * strain
        + moduli.first_lame_parameter() * (F.determinant().ln() + left_out * strain);
    deviator_norm(&stress, out_of_plane, left_out) - law.yield_stress(state.accumulated_plastic_strain)
}

/// How far the stress is outside the cone, which ends at the apex; a gap admits no stress at all.
fn cone_excess<const D: usize>(law: &DruckerPrager, F: &Matrix<D>, state: &DruckerPragerState) -> f64 {
    let stress = law.kirchhoff_stress(F, state, &Matrix::ZERO);
    if state.volume_correction > 0.0 {
        return stress.frobenius_norm();
    }
    let above_apex = law.tensile_strength() - stress.trace() / D as f64;
    let outside = deviator_norm(&stress, 0.0, 0.0) - law.cone_slope(D) * above_apex;
    outside.max(-above_apex)
}

/// Runs the check on every law.
macro_rules! for_each_member {
    ($check:ident::<$D:literal>($sample:expr)) => {{
        let sample: &Sample = $sample;
        let modulus = sample.young_modulus;
        let moduli = ElasticModuli::new(modulus, sample.poisson_ratio).expect("in range");
        let rate = 10.0 * (1.0 + sample.numbers[64]);
        let softening = SofteningHencky::new(moduli, 0.05 * modulus, 0.01 * modulus, rate);
        let sand = DruckerPrager::new(moduli, 0.8 + 0.7 * sample.numbers[65]).expect("in range");
        for law in [
            softening,
            SofteningHencky::new(moduli, 0.02 * modulus, 0.02 * modulus, 0.0),
        ] {
            let law = law.expect("in range");
            let excess = yield_excess;
            $check::<$D, _>(
                &Member {
                    name: "softening Hencky",
                    law,
                    excess,
                },
                sample,
            )?;
        }
        for law in [sand, sand.with_cohesion(0.01 * modulus).expect("in range")] {
            let excess = cone_excess;
            $check::<$D, _>(
                &Member {
                    name: "Drucker–Prager",
                    law,
                    excess,
                },
                sample,
            )?;
        }
    }};
}

/// advance gives a stress that the law admits, and advancing that again changes nothing.
fn the_return_is_a_projection<const D: usize, L: Law<D>>(
    member: &Member<D, L>,
    sample: &Sample,
) -> Result<(), TestCaseError> {
    let tolerance = 1e-13 * sample.young_modulus;
    for step in walk(&member.law, sample) {
        prop_assert_eq!(member.law.check(&step.F), Ok(()));
        let excess = (member.excess)(&member.law, &step.F, &step.after);
        prop_assert!(excess <= tolerance, "{}, D = {D}: outside by {excess:e}", member.name);
        let mut again = step.after;
        let F = member.law.advance(&step.F, &mut again);
        let change = (F - step.F).frobenius_norm();
        prop_assert!(change <= 1e-13, "{}, D = {D}: moved by {change:e}", member.name);
        if (member.excess)(&member.law, &step.trial, &step.before) < -tolerance {
            prop_assert_eq!((step.F, step.after), (step.trial, step.before));
        }
    }
    Ok(())
}

/// advance(Q F) = Q advance(F) with the same state.
fn frames_do_not_matter<const D: usize, L: Law<D>>(
    member: &Member<D, L>,
    sample: &Sample,
) -> Result<(), TestCaseError> {
    let Q = rotation(&sample.block::<D>(2));
    for step in walk(&member.law, sample) {
        let mut turned_state = step.before;
        let turned = member.law.advance(&(Q * step.trial), &mut turned_state);
        let error = (turned - Q * step.F).frobenius_norm();
        prop_assert!(error < 1e-12, "{}, D = {D}: {error:e}", member.name);
        let stress = member.law.kirchhoff_stress(&step.F, &step.after, &Matrix::ZERO);
        let turned = member.law.kirchhoff_stress(&turned, &turned_state, &Matrix::ZERO);
        let error = (turned - Q * stress * Q.transpose()).frobenius_norm();
        prop_assert!(
            error < 1e-12 * sample.young_modulus,
            "{}, D = {D}: stress {error:e}",
            member.name
        );
        prop_assert_eq!(stress, stress.transpose());
    }
    Ok(())
}

/// Flow dissipates: the return never raises the energy. And it keeps the volume, in F and state together.
fn flow_dissipates_and_keeps_the_volume<const D: usize, L: Law<D>>(
    member: &Member<D, L>,
    sample: &Sample,
) -> Result<(), TestCaseError> {
    for step in walk(&member.law, sample) {
        let before = member.law.energy_density(&step.trial, &step.before);
        let after = member.law.energy_density(&step.F, &step.after);
        let rounding = 1e-14 * sample.young_modulus;
        prop_assert!(
            after <= before + rounding,
            "{}, D = {D}: {before:e} to {after:e}",
            member.name
        );
        let volume = member.law.volume_ratio(&step.trial, &step.before);
        let change = member.law.volume_ratio(&step.F, &step.after) / volume - 1.0;
        prop_assert!(change.abs() < 1e-13, "{}, D = {D}: volume by {change:e}", member.name);
    }
    Ok(())
}

/// τ = ∂ψ/∂F Fᵀ at fixed state.
fn stress_is_the_derivative_of_energy<const D: usize, L: Law<D>>(
    member: &Member<D, L>,
    sample: &Sample,
) -> Result<(), TestCaseError> {
    for Step { F, after, .. } in walk(&member.law, sample) {
        let differences = derivative_of(|F| member.law.energy_density(F, &after), &F) * F.transpose();
        let error = (member.law.kirchhoff_stress(&F, &after, &Matrix::ZERO) - differences).frobenius_norm();
        prop_assert!(
            error < 1e-8 * sample.young_modulus,
            "{}, D = {D}: {error:e}",
            member.name
        );
    }
    Ok(())
}

/// ρ₀ c² bounds the acoustic tensor of the elastic region, and equals its P-wave modulus at rest.
fn wave_speed_bounds_the_acoustic_tensor<const D: usize, L: Law<D>>(
    member: &Member<D, L>,
    sample: &Sample,
) -> Result<(), TestCaseError> {
    let (a, n) = (sample.direction(0), sample.direction(1));
    let (density, tolerance) = (sample.reference_density, 1e-4 * sample.young_modulus);
    let stiffness =
        |F: &Matrix<D>, state: &L::State, a: &[f64; D]| stiffness_of(|F| member.law.energy_density(F, state), F, a, &n);
    for Step { F, after, .. } in walk(&member.law, sample) {
        let speed = member.law.wave_speed(&F, &after, density);
        for polarisation in [a, n] {
            let stiffness = stiffness(&F, &after, &polarisation);
            prop_assert!(
                stiffness <= density * speed * speed + tolerance,
                "{}, D = {D}",
                member.name
            );
        }
    }
    let virgin = L::State::default();
    let speed = member.law.wave_speed(&Matrix::IDENTITY, &virgin, density);
    let stiffness = stiffness(&Matrix::IDENTITY, &virgin, &n);
    is_exact_at_rest::<D>(member.name, density * speed * speed, stiffness, tolerance)
}

macro_rules! conformance {
    ($($name:ident: $check:ident in $($dimension:literal)+;)*) => {
        proptest! {
            $(#[test]
            fn $name(sample in sample()) {
                $(for_each_member!($check::<$dimension>(&sample));)+
            })*
        }
    };
}

// Above three dimensions the return is the same sum over more axes.
conformance! {
    projection: the_return_is_a_projection in 1 2 3 4;
    objectivity: frames_do_not_matter in 1 2 3;
    dissipation_and_volume: flow_dissipates_and_keeps_the_volume in 1 2 3;
    derivative: stress_is_the_derivative_of_energy in 1 2 3;
    wave_speed: wave_speed_bounds_the_acoustic_tensor in 1 2 3;
}
