//! A random configuration from a seed and its number.

use std::ops::RangeInclusive;

use parvi_options::MethodName::{Mpm, PaperApic, PaperPic};
use parvi_options::{Correction, Draws, Material, Switch, Transfer};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use crate::study::prelude::*;

/// Factor of the target's frame.
const SCALES: [f64; 2] = [1e-3, 1e3];
/// Spacing in units of the default.
pub const SPACINGS: [f64; 2] = [0.1, 10.0];
/// Time step in units of the default for the spacing.
pub const TIME_STEPS: [f64; 2] = [0.1, 30.0];
/// Standard deviation of the start in units of the frame.
const START_DEVIATIONS: [f64; 2] = [0.1, 10.0];
/// Largest mean of the start in units of the frame.
const LARGEST_START_MEAN: f64 = 10.0;
/// Friction where there is some.
const FRICTIONS: [f64; 2] = [0.01, 100.0];
/// M.
const PARTICLES: [f64; 2] = [2.0, 2000.0];
/// Steps.
const STEPS: RangeInclusive<i64> = 5..=100;
/// The largest dimension in which a tensor product of splines is drawn.
const LARGEST_TENSOR_DIMENSION: usize = 4;
/// The most entries that the stencils of all particles may have; M is lowered to it.
const MOST_ENTRIES: usize = 60_000;
/// What an entry costs on `wells`, whose score is a sum over thousands of rows and may be taken at every node.
const ROWS_COST: usize = 40;

/// A random configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct Configuration {
    /// The target.
    pub target: TargetSpecification,
    /// d.
    pub dim: usize,
    /// One of `mpm`, `paper-pic` and `paper-apic`.
    pub method: MethodName,
    /// The options of the method but for spacing and time step.
    pub options: MethodOptions,
    /// The basis, which is one of the options.
    pub basis: Basis,
    /// Spacing in units of the default.
    pub spacing_factor: f64,
    /// Time step in units of the default for the spacing.
    pub time_step_factor: f64,
    /// Factor of the target's frame.
    pub scale: f64,
    /// Seed of a turn of the frame.
    pub turn: Option<u64>,
    /// M.
    pub particles: usize,
    /// Seed of the run.
    pub seed: u64,
}

/// One of several, each as likely.
fn one_of<T: Clone>(generator: &mut ChaCha8Rng, choices: &[T]) -> T {
    choices[generator.random_range(0..choices.len())].clone()
}

/// A number whose logarithm is uniform.
fn spread(generator: &mut ChaCha8Rng, [least, most]: [f64; 2]) -> f64 {
    (least * (most / least).powf(generator.random::<f64>())).clamp(least, most)
}

/// The configuration with a number; `places` are targets, each in at least one dimension.
pub fn draw(seed: u64, index: usize, places: &[Vec<TargetSpecification>]) -> Configuration {
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    generator.set_stream(index as u64);
    let draws = &mut generator;
    let place = one_of(draws, places);
    let target = one_of(draws, &place);
    let dim = target.dimension().unwrap_or(1);
    let method = one_of(draws, &[Mpm, Mpm, PaperPic, PaperApic]);
    let bases = [Basis::Lattice, Basis::Linear, Basis::Quadratic, Basis::Cubic];
    let allowed = if dim > LARGEST_TENSOR_DIMENSION { 1 } else { bases.len() };
    let basis = one_of(draws, &bases[..allowed]);
    let switches = [Switch::On, Switch::Off];
    let mut options = MethodOptions {
        steps: StepCount::new(draws.random_range(STEPS)),
        basis: Some(basis),
        score: Some(one_of(draws, &[Score::Particles, Score::Nodes])),
        start_mean: Some(LARGEST_START_MEAN * draws.random::<f64>()),
        start_sd: Some(spread(draws, START_DEVIATIONS)),
        start_draws: Some(one_of(draws, &[Draws::QuasiRandom, Draws::Independent])),
        ..MethodOptions::default()
    };
    if method == Mpm {
        options.survey = Some(Switch::Off);
        let transfer = one_of(draws, &[Transfer::Pic, Transfer::Apic, Transfer::Flip]);
        options.transfer = Some(transfer);
        options.flip_share = (transfer == Transfer::Flip).then_some(draws.random());
        let glides = draws.random_bool(0.125);
        options.friction = Some(if glides { 0.0 } else { spread(draws, FRICTIONS) });
        options.shifts = Some(one_of(draws, &switches));
        options.rotation = Some(one_of(draws, &switches));
        let settles = !draws.random_bool(0.25);
        options.settling = Some(if settles { 0.9 * draws.random::<f64>() } else { 0.0 });
        options.settling_shifts = Some(one_of(draws, &switches));
        let corrections = [Correction::Off, Correction::Mean, Correction::Affine];
        options.moment_correction = Some(one_of(draws, &corrections));
    } else {
        options.guards = Some(one_of(draws, &switches));
        options.material = Some(one_of(draws, &[Material::NeoHookean, Material::LinearElastic]));
    }
    let entry_cost = if target.name == "wells" { ROWS_COST } else { 1 };
    let most = (MOST_ENTRIES / (basis.stencil(dim) * entry_cost)).max(2);
    Configuration {
        target,
        dim,
        method,
        options,
        basis,
        spacing_factor: spread(draws, SPACINGS),
        time_step_factor: spread(draws, TIME_STEPS),
        scale: spread(draws, SCALES),
        turn: draws.random_bool(0.5).then_some(draws.random()),
        particles: (spread(draws, PARTICLES).round() as usize).clamp(2, most),
        seed: draws.random(),
    }
}

#[cfg(test)]
mod tests {
    use std::collections::HashSet;

    use super::*;

    fn places() -> Vec<Vec<TargetSpecification>> {
        let place = |name: &str, to: i64| {
            let dims = (1..=to).map(Dimension::new);
            dims.map(|dim| TargetSpecification::plain(name, dim)).collect()
        };
        vec![
            place("gaussian", 6),
            vec![TargetSpecification::plain("ring", None)],
            place("wells", 6),
        ]
    }

    #[test]
    fn a_case_depends_on_seed_and_number_only() {
        let cases: Vec<Configuration> = (0..50).map(|index| draw(7, index, &places())).collect();
        let again: Vec<Configuration> = (0..50).rev().map(|index| draw(7, index, &places())).collect();
        assert!(cases.iter().eq(again.iter().rev()));
        assert!(cases.windows(2).all(|pair| pair[0].seed != pair[1].seed));
        assert_ne!(cases[3], draw(8, 3, &places()));
    }

    #[test]
    fn every_case_fits_its_method_and_every_choice_occurs() {
        let mut seen = HashSet::new();
        for index in 0..2000 {
            let case = draw(1, index, &places());
            case.options.method(case.method).unwrap();
            assert_eq!(case.target.dimension().unwrap(), case.dim);
            assert!((2..=2000).contains(&case.particles));
            assert!(case.particles == 2 || case.particles * case.basis.stencil(case.dim) <= MOST_ENTRIES);
            assert!((1e-3..=1e3).contains(&case.scale));
            assert!(case.basis == Basis::Lattice || case.dim <= LARGEST_TENSOR_DIMENSION);
            seen.insert(format!("{} {}", case.method, case.basis));
            seen.insert(format!("{} d{}", case.target.name, case.dim));
            seen.insert(format!("paper {:?} {:?}", case.options.guards, case.options.material));
            seen.insert(format!(
                "mpm {:?} {:?}",
                case.options.transfer, case.options.moment_correction
            ));
        }
        // 3 × 4 methods and bases, 13 targets, 4 + 1 guards and laws, 9 + 1 transfers and corrections.
        assert_eq!(seen.len(), 12 + 13 + 5 + 10);
    }
}
