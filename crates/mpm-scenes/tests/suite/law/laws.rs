//! The laws of a scene as one.

#![allow(non_snake_case)]

use std::sync::Arc;

use mpm_materials::{DruckerPrager, ElasticModuli, Law, NeoHookean, Numbered, Remembered, SofteningHencky, TaitFluid};
use mpm_scenes::law::AnyLaw;
use mpm_scenes::{LawState, Laws};
use mpm_tensor::Matrix;

fn moduli() -> ElasticModuli {
    ElasticModuli::new(100.0, 0.3).expect("in range")
}

#[test]
fn many_particles_at_once_are_as_one_by_one() {
    let clay = SofteningHencky::new(moduli(), 1.0, 0.5, 3.0).expect("in range");
    let water = TaitFluid::new(2.0, 10.0, 0.1).expect("in range");
    let table: Vec<AnyLaw<2>> = vec![
        Arc::new(Numbered(NeoHookean::new(moduli()))),
        Arc::new(Numbered(clay)),
        Arc::new(Numbered(water)),
    ];
    let laws = Laws::new(table).expect("three");
    let count = 150;
    let number = |k: usize, a: usize| ((7 * k + 3 * a) % 13) as f64 / 130.0;
    let F: Vec<Matrix<2>> = (0..count)
        .map(|k| Matrix([[1.0 + number(k, 0), number(k, 1)], [-number(k, 2), 1.1 - number(k, 3)]]))
        .collect();
    let rates: Vec<Matrix<2>> = F.iter().map(|F| *F * 3.0).collect();
    // Long runs, short runs and single particles.
    let law = |k: usize| if k < 70 { 0 } else { (k / (1 + k % 4) % 3) as u32 };
    let mut states: Vec<LawState> = (0..count).map(|k| LawState::virgin(law(k))).collect();
    let F: Vec<Matrix<2>> = F
        .iter()
        .zip(&mut states)
        .map(|(F, state)| laws.advance(F, state))
        .collect();
    let densities: Vec<f64> = (0..count).map(|k| 1.0 + number(k, 5)).collect();

    let (mut stresses, mut speeds) = (vec![Matrix::ZERO; count], vec![0.0; count]);
    laws.kirchhoff_stresses(&F, &states, &rates, &mut stresses);
    laws.wave_speeds(&F, &states, &densities, &mut speeds);
    for k in 0..count {
        let stress = laws.kirchhoff_stress(&F[k], &states[k], &rates[k]);
        assert!(
            (stresses[k] - stress).maximum_norm() <= 1e-13 * (1.0 + stress.maximum_norm()),
            "particle {k}"
        );
        let speed = laws.wave_speed(&F[k], &states[k], densities[k]);
        assert!((speeds[k] - speed).abs() <= 1e-13 * speed, "particle {k}");
    }
}

#[test]
fn every_particle_follows_its_own_law_and_remembers_by_it() {
    let metal = SofteningHencky::new(moduli(), 1.0, 0.5, 3.0).expect("in range");
    let sand = DruckerPrager::new(moduli(), 0.5).expect("in range");
    let water = TaitFluid::new(2.0, 10.0, 0.1).expect("in range");
    let rubber = NeoHookean::new(moduli());
    let table: Vec<AnyLaw<2>> = vec![
        Arc::new(Numbered(metal)),
        Arc::new(Numbered(sand)),
        Arc::new(Numbered(water)),
        Arc::new(Numbered(rubber)),
    ];
    let laws = Laws::new(table).expect("four");
    assert_eq!(
        laws.internal_variables(),
        ["plastic_strain", "out_of_plane_strain", "volume_correction"]
    );
    let trial = Matrix([[1.1, 0.2], [0.0, 1.05]]);
    let rate = Matrix([[0.0, 1.0], [2.0, 0.5]]);
    let mut states: Vec<LawState> = (0..4).map(LawState::virgin).collect();
    let advanced: Vec<Matrix<2>> = states.iter_mut().map(|state| laws.advance(&trial, state)).collect();

    let mut own = Default::default();
    let F = Law::advance(&metal, &trial, &mut own);
    assert!(own.accumulated_plastic_strain > 0.0);
    assert_eq!(
        laws.internal_variable(&states[0], "plastic_strain"),
        Some(own.accumulated_plastic_strain)
    );
    assert_eq!(laws.internal_variable(&states[0], "volume_correction"), None);
    assert_eq!((advanced[0], states[0].memory), (F, own.store()));
    assert_eq!(laws.energy_density(&F, &states[0]), metal.energy_density(&F, &own));
    let mut own = Default::default();
    let F = Law::advance(&sand, &trial, &mut own);
    assert!(own.volume_correction > 0.0);
    assert_eq!((advanced[1], states[1].memory), (F, own.store()));
    assert_eq!(
        laws.volume_ratio(&F, &states[1]),
        Law::<2>::volume_ratio(&sand, &F, &own)
    );
    let F = Law::advance(&water, &trial, &mut ());
    assert_eq!(
        laws.kirchhoff_stress(&F, &states[2], &rate),
        water.kirchhoff_stress(&F, &(), &rate)
    );
    assert_eq!(
        laws.wave_speed(&trial, &states[3], 2.0),
        Law::wave_speed(&rubber, &trial, &(), 2.0)
    );
    assert!(laws.rate_dependent());
    let viscous_step = |law: u32, F: Matrix<2>| laws.viscous_step(0.1, &[F], &[LawState::virgin(law)]);
    assert!((viscous_step(2, Matrix::IDENTITY) - 0.01 * 2.0 / 0.4).abs() < 1e-15);
    assert!((viscous_step(2, Matrix::IDENTITY * 2.0) - 0.01 * 0.5 / 0.4).abs() < 1e-15);
    assert_eq!(viscous_step(3, Matrix::IDENTITY), f64::INFINITY);
    assert!(Law::<2>::check(&laws, &Matrix([[1.0, 0.0], [0.0, -1.0]])).is_err());
}
