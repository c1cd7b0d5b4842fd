//! No deformation gradient and no parameter panics; inadmissible ones are errors and never yield finite stresses.

use mpm_materials::{
    DeformationError, DeformingGas, DruckerPrager, DruckerPragerState, ElasticModuli, FixedCorotated, GasState, Hencky,
    IsothermalGas, KelvinVoigt, Law, LinearCauchy, LinearElastic, Material, NeoHookean, Snow, SnowState,
    SofteningHencky, SofteningState, TaitFluid,
};
use mpm_tensor::Matrix;
use proptest::prelude::*;

fn entry() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -2.0..2.0,
        1 => any::<u64>().prop_map(f64::from_bits),
        1 => prop::sample::select(vec![0.0, -1e-310, 1e300, f64::MAX, f64::NAN, f64::INFINITY]),
    ]
}

fn survives<const D: usize, L: Law<D> + ?Sized>(
    law: &L,
    state: L::State,
    numbers: &[f64],
) -> Result<(), TestCaseError> {
    let F = Matrix::<D>::from_fn(|i, j| numbers[D * i + j]);
    let velocity_gradient = Matrix::<D>::from_fn(|i, j| numbers[D * j + i]);
    let stress = law.kirchhoff_stress(&F, &state, &velocity_gradient);
    let energy = law.energy_density(&F, &state);
    let speed = law.wave_speed(&F, &state, 1.0);
    let mut advanced_state = state;
    let advanced = law.advance(&F, &mut advanced_state);
    match law.check(&F) {
        Ok(()) => prop_assert!(F.is_finite()),
        Err(error) => {
            prop_assert!(!stress.is_finite() && !energy.is_finite() && !speed.is_finite());
            prop_assert_eq!(bits(&advanced), bits(&F));
            match error {
                DeformationError::NotFinite { row, column, value } => {
                    prop_assert_eq!(F.0[row][column].to_bits(), value.to_bits());
                }
                DeformationError::VolumeRatio { volume_ratio } => {
                    prop_assert!(volume_ratio <= 0.0 || !volume_ratio.is_finite());
                }
            }
        }
    }
    Ok(())
}

fn bits<const D: usize>(matrix: &Matrix<D>) -> [[u64; D]; D] {
    matrix.0.map(|row| row.map(f64::to_bits))
}

fn material_survives<const D: usize>(material: &dyn Material<D>, numbers: &[f64]) -> Result<(), TestCaseError> {
    let F = Matrix::<D>::from_fn(|i, j| numbers[D * i + j]);
    let piola = material.first_piola_kirchhoff(&F);
    prop_assert!(Material::check(material, &F).is_ok() || !piola.is_finite());
    survives(material, (), numbers)
}

fn all_survive<const D: usize>(numbers: &[f64]) -> Result<(), TestCaseError> {
    let moduli = ElasticModuli::new(1.0, 0.0).expect("in range");
    let gas = IsothermalGas::CALIBRATED.with_reference_density(1.0).expect("positive");
    material_survives::<D>(&LinearElastic::new(moduli), numbers)?;
    material_survives::<D>(&NeoHookean::new(moduli), numbers)?;
    material_survives::<D>(&FixedCorotated::new(moduli), numbers)?;
    material_survives::<D>(&Hencky::new(moduli), numbers)?;
    material_survives::<D>(&gas, numbers)?;
    survives::<D, _>(&LinearCauchy::new(moduli), (), numbers)?;
    for viscosity in [0.0, 0.1] {
        survives::<D, _>(&KelvinVoigt::new(moduli, viscosity).expect("in range"), (), numbers)?;
    }
    let breathing = DeformingGas {
        gas: IsothermalGas::CALIBRATED,
    };
    for reference_density in [1.0, numbers[0]] {
        survives::<D, _>(&breathing, GasState { reference_density }, numbers)?;
    }
    let metal = SofteningHencky::new(moduli, 0.1, 0.0, 1e3).expect("in range");
    let spoiled = SofteningState {
        accumulated_plastic_strain: numbers[0],
        out_of_plane_strain: numbers[1],
    };
    for state in [SofteningState::default(), spoiled] {
        survives::<D, _>(&metal, state, numbers)?;
    }
    let sand = DruckerPrager::new(moduli, 0.5).expect("in range");
    let open = DruckerPragerState {
        volume_correction: numbers[0],
    };
    for law in [sand, sand.with_cohesion(0.1).expect("in range")] {
        survives::<D, _>(&law, DruckerPragerState::default(), numbers)?;
        survives::<D, _>(&law, open, numbers)?;
    }
    let snow = Snow::fresh(moduli);
    let packed = SnowState {
        log_plastic_volume: numbers[0],
    };
    for state in [SnowState::default(), packed] {
        survives::<D, _>(&snow, state, numbers)?;
    }
    for viscosity in [0.0, 0.1] {
        let fluid = TaitFluid::new(1.0, 1.0, viscosity).expect("in range");
        survives::<D, _>(&fluid, (), numbers)?;
        survives::<D, _>(&fluid.forgetting_expansion(), (), numbers)?;
    }
    Ok(())
}

proptest! {
    #[test]
    fn any_deformation(numbers in prop::collection::vec(entry(), 36)) {
        mpm_tensor::in_dimensions!(all_survive(&numbers)?, 1, 2, 3, 6);
    }

    #[test]
    fn any_parameters(first in entry(), second in entry(), third in entry()) {
        for moduli in [ElasticModuli::new(first, second), ElasticModuli::from_lame(first, second)].into_iter().flatten() {
            prop_assert!(moduli.shear_modulus() > 0.0 && moduli.shear_modulus().is_finite());
            prop_assert!(moduli.first_lame_parameter().is_finite());
        }
        let is_range = |low: f64, value: f64, high: f64| low <= value && value <= high;
        let moduli = ElasticModuli::new(1.0, 0.3).expect("in range");
        let metal = SofteningHencky::new(moduli, first, second, third);
        prop_assert_eq!(
            metal.is_ok(),
            first > 0.0 && first.is_finite() && is_range(0.0, second, first) && is_range(0.0, third, f64::MAX)
        );
        if let Ok(sand) = DruckerPrager::new(moduli, first) {
            prop_assert!(sand.cone_slope(3) > 0.0 && sand.tensile_strength() == 0.0);
            prop_assert_eq!(sand.with_cohesion(second).is_ok(), is_range(0.0, second, f64::MAX));
        }
        if let Ok(fluid) = TaitFluid::new(first, second, third) {
            prop_assert!(fluid.pressure(0.9) >= 0.0);
        }
        if let Ok(gas) = IsothermalGas::new(first) {
            prop_assert!(gas.wave_speed() > 0.0);
            prop_assert_eq!(gas.with_reference_density(second).is_ok(), second > 0.0 && second.is_finite());
        }
    }
}

/// A diagonal of the stress alone may be NaN.
#[test]
fn an_element_turned_inside_out_is_an_error_with_its_volume_ratio() {
    let moduli = ElasticModuli::new(1.0, 0.3).expect("in range");
    let materials: [&dyn Material<2>; 3] = [
        &NeoHookean::new(moduli),
        &Hencky::new(moduli),
        &FixedCorotated::new(moduli),
    ];
    for material in materials {
        for (stretches, volume_ratio) in [([1.0, -0.5], -0.5), ([0.0, 2.0], 0.0)] {
            let F = Matrix::diagonal(&stretches);
            let error = material.checked_kirchhoff_stress(&F).expect_err("inside out");
            assert_eq!(error, DeformationError::VolumeRatio { volume_ratio });
            assert!(material.kirchhoff_stress(&F).trace().is_nan());
            assert!(material.first_piola_kirchhoff(&F).trace().is_nan());
            assert!(material.energy_density(&F).is_nan() && material.wave_speed(&F, 1.0).is_nan());
        }
    }
}
