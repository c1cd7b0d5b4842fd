//! No deformation gradient and no parameter panics; inadmissible ones are errors and never yield finite stresses.
#![allow(non_snake_case)]

use mpm_materials::{DeformationError, ElasticModuli, IsothermalGas, LinearElastic, Material, NeoHookean};
use mpm_tensor::Matrix;
use proptest::prelude::*;

fn entry() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -2.0..2.0,
        1 => any::<u64>().prop_map(f64::from_bits),
        1 => prop::sample::select(vec![0.0, -1e-310, 1e300, f64::MAX, f64::NAN, f64::INFINITY]),
    ]
}

fn survives<const D: usize>(material: &dyn Material<D>, numbers: &[f64]) -> Result<(), TestCaseError> {
    let F = Matrix::<D>::from_fn(|i, j| numbers[D * i + j]);
    let stress = material.kirchhoff_stress(&F);
    let energy = material.energy_density(&F);
    let piola = material.first_piola_kirchhoff(&F);
    let speed = material.wave_speed(&F, 1.0);
    match material.check(&F) {
        Ok(()) => prop_assert!(F.is_finite()),
        Err(error) => {
            prop_assert!(!stress.is_finite() && !energy.is_finite() && !piola.is_finite() && !speed.is_finite());
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

fn all_survive<const D: usize>(numbers: &[f64]) -> Result<(), TestCaseError> {
    let moduli = ElasticModuli::new(1.0, 0.0).expect("in range");
    let gas = IsothermalGas::CALIBRATED.with_reference_density(1.0).expect("positive");
    survives::<D>(&LinearElastic::new(moduli), numbers)?;
    survives::<D>(&NeoHookean::new(moduli), numbers)?;
    survives::<D>(&gas, numbers)
}

proptest! {
    #[test]
    fn any_deformation(numbers in prop::collection::vec(entry(), 36)) {
        all_survive::<1>(&numbers)?;
        all_survive::<2>(&numbers)?;
        all_survive::<3>(&numbers)?;
        all_survive::<4>(&numbers)?;
        all_survive::<6>(&numbers)?;
    }

    #[test]
    fn any_parameters(first in entry(), second in entry()) {
        for moduli in [ElasticModuli::new(first, second), ElasticModuli::from_lame(first, second)].into_iter().flatten() {
            prop_assert!(moduli.shear_modulus() > 0.0 && moduli.shear_modulus().is_finite());
            prop_assert!(moduli.first_lame_parameter().is_finite());
        }
        if let Ok(gas) = IsothermalGas::new(first) {
            prop_assert!(gas.wave_speed() > 0.0);
            prop_assert_eq!(gas.with_reference_density(second).is_ok(), second > 0.0 && second.is_finite());
        }
    }
}
