//! From a material's table to its law.

use mpm_materials::{
    DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, LinearElastic, NeoHookean, ParameterError,
    SofteningHencky, TaitFluid,
};

use super::AnyLaw;
use crate::SceneFault;
use crate::scene::{MaterialTable, SolidTable};
use crate::values::positive;

/// The law that a table describes; `field` is what errors call it.
///
/// # Errors
/// [`SceneFault::Value`] for a density that is not positive or a parameter that the law refuses.
pub fn build(field: &str, table: &MaterialTable) -> Result<AnyLaw, SceneFault> {
    positive(&format!("{field}.density"), table.density())?;
    if let MaterialTable::SofteningHencky(metal) = table {
        positive(&format!("{field}.norm_per_strength"), metal.norm_per_strength)?;
    }
    law(table).map_err(|error| refused(field, error))
}

fn law(table: &MaterialTable) -> Result<AnyLaw, ParameterError> {
    let moduli = |solid: &SolidTable| ElasticModuli::new(solid.young_modulus, solid.poisson_ratio);
    Ok(match table {
        MaterialTable::LinearElastic(solid) => AnyLaw::LinearElastic(LinearElastic::new(moduli(solid)?)),
        MaterialTable::NeoHookean(solid) => AnyLaw::NeoHookean(NeoHookean::new(moduli(solid)?)),
        MaterialTable::FixedCorotated(solid) => AnyLaw::FixedCorotated(FixedCorotated::new(moduli(solid)?)),
        MaterialTable::Hencky(solid) => AnyLaw::Hencky(Hencky::new(moduli(solid)?)),
        MaterialTable::SofteningHencky(metal) => AnyLaw::SofteningHencky(SofteningHencky::new(
            ElasticModuli::new(metal.young_modulus, metal.poisson_ratio)?,
            metal.norm_per_strength * metal.peak_yield_stress,
            metal.norm_per_strength * metal.residual_yield_stress.unwrap_or(metal.peak_yield_stress),
            metal.softening_rate,
        )?),
        MaterialTable::DruckerPrager(sand) => {
            let moduli = ElasticModuli::new(sand.young_modulus, sand.poisson_ratio)?;
            let law = DruckerPrager::new(moduli, sand.friction_angle.to_radians())?;
            AnyLaw::DruckerPrager(law.with_cohesion(sand.cohesion)?)
        }
        MaterialTable::TaitFluid(fluid) => {
            let law = TaitFluid::new(fluid.density, fluid.sound_speed, fluid.viscosity)?;
            AnyLaw::TaitFluid(if fluid.forgets_expansion {
                law.forgetting_expansion()
            } else {
                law
            })
        }
        MaterialTable::IsothermalGas(gas) => {
            let law = IsothermalGas::new(gas.pressure_per_density)?;
            AnyLaw::IsothermalGas(law.with_reference_density(gas.density)?)
        }
    })
}

/// The parameter by the name that it has in the document.
fn refused(field: &str, error: ParameterError) -> SceneFault {
    let (parameter, value) = match error {
        ParameterError::YoungModulus { value } => ("young_modulus", value),
        ParameterError::PoissonRatio { value } => ("poisson_ratio", value),
        ParameterError::ShearModulus { value } => ("young_modulus: the shear modulus", value),
        ParameterError::FirstLameParameter { value } => ("poisson_ratio: Lame's first parameter", value),
        ParameterError::PressurePerDensity { value } => ("pressure_per_density", value),
        ParameterError::ReferenceDensity { value } => ("density", value),
        ParameterError::PeakYieldStress { value } => ("peak_yield_stress", value),
        ParameterError::ResidualYieldStress { value, .. } => ("residual_yield_stress", value),
        ParameterError::SofteningRate { value } => ("softening_rate", value),
        ParameterError::FrictionAngle { value } => {
            let field = format!("{field}.friction_angle");
            return SceneFault::value(field, value.to_degrees(), "strictly between 0 and 90 (degrees)");
        }
        ParameterError::Cohesion { value } => ("cohesion", value),
        ParameterError::SoundSpeed { value } => ("sound_speed", value),
        ParameterError::Viscosity { value } => ("viscosity", value),
    };
    // The error says "… must be RANGE, not VALUE".
    let message = error.to_string();
    let range = message
        .split_once(" must ")
        .map_or(message.as_str(), |(_, range)| range);
    let range = range.rsplit_once(", not").map_or(range, |(range, _)| range);
    SceneFault::value(
        format!("{field}.{parameter}"),
        value,
        range.strip_prefix("be ").unwrap_or(range),
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn metal(keys: &str) -> Result<AnyLaw, SceneFault> {
        let solid = "law = \"softening-hencky\"\ndensity = 1.0\nyoung_modulus = 10.0\npoisson_ratio = 0.3\nsoftening_rate = 2.0\n";
        let table: MaterialTable = toml::from_str(&format!("{solid}{keys}")).expect("a table");
        build("materials.metal", &table)
    }

    #[test]
    fn strengths_are_counted_in_norms_of_the_stress() {
        let law = |keys| metal(keys).expect("a law");
        let scaled = law("norm_per_strength = 0.5\npeak_yield_stress = 0.4\nresidual_yield_stress = 0.2\n");
        assert_eq!(scaled, law("peak_yield_stress = 0.2\nresidual_yield_stress = 0.1\n"));
        for bad in ["0.0", "-1.0", "nan", "inf"] {
            let error = metal(&format!("norm_per_strength = {bad}\npeak_yield_stress = 0.4\n"));
            let error = error.expect_err("refused").to_string();
            assert!(error.starts_with("materials.metal.norm_per_strength"), "{error}");
        }
    }
}
