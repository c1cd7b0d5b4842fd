//! What every material must satisfy, D = 1…4, through `&dyn Material<D>`.

use mpm_materials::{
    ElasticModuli, FixedCorotated, Hencky, IsothermalGas, LinearElastic, Material, NeoHookean, conformance,
};
use mpm_tensor::Matrix;
use proptest::prelude::*;

use crate::common::{Sample, is_exact_at_rest, rotation, sample, stiffness_of};

/// A material and what its documentation promises.
struct Member<'a, const D: usize> {
    name: &'static str,
    material: &'a dyn Material<D>,
    /// ψ(Q F) = ψ(F) for every rotation Q.
    objective: bool,
    /// ψ(I) = 0 and τ(I) = 0.
    stress_free_at_rest: bool,
}

/// Runs `check` on every member.
fn for_each_member<const D: usize>(
    sample: &Sample,
    check: impl Fn(&Member<D>, &Sample) -> Result<(), TestCaseError>,
) -> Result<(), TestCaseError> {
    let moduli = ElasticModuli::new(sample.young_modulus, sample.poisson_ratio).expect("in range");
    let gas = IsothermalGas::new(sample.young_modulus).expect("positive");
    let gas = gas.with_reference_density(sample.reference_density).expect("positive");
    let (linear, neo_hookean) = (LinearElastic::new(moduli), NeoHookean::new(moduli));
    let fixed_corotated = FixedCorotated::new(moduli);
    let hencky = Hencky::new(moduli);
    let members: [Member<D>; 5] = [
        Member {
            name: "linear elastic",
            material: &linear,
            objective: false,
            stress_free_at_rest: true,
        },
        Member {
            name: "Neo-Hookean",
            material: &neo_hookean,
            objective: true,
            stress_free_at_rest: true,
        },
        Member {
            name: "fixed corotated",
            material: &fixed_corotated,
            objective: true,
            stress_free_at_rest: true,
        },
        Member {
            name: "Hencky",
            material: &hencky,
            objective: true,
            stress_free_at_rest: true,
        },
        Member {
            name: "isothermal gas",
            material: &gas,
            objective: true,
            stress_free_at_rest: false,
        },
    ];
    members.iter().try_for_each(|member| check(member, sample))
}

/// A size of stresses, for tolerances.
fn stress_scale<const D: usize>(member: &Member<D>, sample: &Sample) -> f64 {
    let F = sample.deformation::<D>();
    10.0 * sample.young_modulus * sample.reference_density.max(1.0)
        + member.material.first_piola_kirchhoff(&F).frobenius_norm()
}

/// P_ij = ∂ψ/∂F_ij; τ = P Fᵀ.
fn stress_is_the_derivative_of_energy<const D: usize>(
    member: &Member<D>,
    sample: &Sample,
) -> Result<(), TestCaseError> {
    let scale = stress_scale(member, sample);
    conformance::stress_is_the_derivative_of_energy(member.material, &sample.deformation(), scale, member.name);
    Ok(())
}

/// ψ(Q F) = ψ(F) and τ(Q F) = Q τ Qᵀ where promised, and with it τ = τᵀ; ψ(Q F Qᵀ) = ψ(F) for all, being isotropic.
fn frames_and_axes_do_not_matter<const D: usize>(member: &Member<D>, sample: &Sample) -> Result<(), TestCaseError> {
    let (F, Q) = (sample.deformation::<D>(), rotation(&sample.block::<D>(2)));
    let tolerance = 1e-13 * stress_scale(member, sample);
    let material = member.material;
    let energy = material.energy_density(&F);
    let turned_axes = material.energy_density(&(Q * F * Q.transpose()));
    prop_assert!(
        (turned_axes - energy).abs() < tolerance,
        "{}: not isotropic",
        member.name
    );
    if member.objective {
        conformance::rotations_do_not_matter(material, &F, &Q, stress_scale(member, sample), member.name);
        prop_assert_eq!(material.kirchhoff_stress(&F), material.kirchhoff_stress(&F).transpose());
    } else {
        // Symmetric to first order: P is, and τ − τᵀ = P (F − I)ᵀ − (F − I) P.
        let strain = (F - Matrix::IDENTITY).frobenius_norm();
        let P = material.first_piola_kirchhoff(&F);
        prop_assert_eq!(P, P.transpose());
        let stress = material.kirchhoff_stress(&F);
        let asymmetry = (stress - stress.transpose()).frobenius_norm();
        prop_assert!(asymmetry <= 2.0 * strain * P.frobenius_norm() + tolerance);
    }
    Ok(())
}

/// No energy and no stress at F = I, or the pressure κ ρ₀ of the gas.
fn rest_is_as_promised<const D: usize>(member: &Member<D>, sample: &Sample) -> Result<(), TestCaseError> {
    let rest = Matrix::<D>::IDENTITY;
    prop_assert_eq!(member.material.energy_density(&rest), 0.0);
    let pressure = if member.stress_free_at_rest {
        0.0
    } else {
        sample.young_modulus * sample.reference_density
    };
    prop_assert_eq!(member.material.kirchhoff_stress(&rest), rest * -pressure);
    prop_assert_eq!(member.material.first_piola_kirchhoff(&rest), rest * -pressure);
    Ok(())
}

/// ρ₀ c² bounds d²/dε² ψ((I + ε a nᵀ) F) for all unit a, n, and equals it at rest for a = n.
fn wave_speed_bounds_the_acoustic_tensor<const D: usize>(
    member: &Member<D>,
    sample: &Sample,
) -> Result<(), TestCaseError> {
    let density = sample.reference_density;
    let scale = stress_scale(member, sample);
    let stiffness =
        |F: &Matrix<D>, a: &[f64; D], n: &[f64; D]| stiffness_of(|F| member.material.energy_density(F), F, a, n);
    let (a, n) = (sample.direction(0), sample.direction(1));
    let F = sample.deformation::<D>();
    conformance::wave_speed_bounds_stiffness(member.material, &F, density, scale, member.name);
    let speed = member.material.wave_speed(&F, density);
    for polarisation in [a, n] {
        let stiffness = stiffness(&F, &polarisation, &n);
        prop_assert!(stiffness <= density * speed * speed + 1e-4 * scale, "{}", member.name);
    }
    let rest = Matrix::IDENTITY;
    let speed = member.material.wave_speed(&rest, density);
    let stiffness = stiffness(&rest, &n, &n);
    is_exact_at_rest::<D>(member.name, density * speed * speed, stiffness, 1e-4 * scale)
}

fn undefined_is_not_finite<const D: usize>(member: &Member<D>, _: &Sample) -> Result<(), TestCaseError> {
    conformance::undefined_is_not_finite(member.material, member.name);
    Ok(())
}

macro_rules! conform {
    ($($name:ident: $check:ident;)*) => {
        proptest! {
            $(#[test]
            fn $name(sample in sample()) {
                mpm_tensor::in_dimensions!(for_each_member(&sample, $check)?, 1, 2, 3, 4);
            })*
        }
    };
}

conform! {
    derivative: stress_is_the_derivative_of_energy;
    objectivity_and_isotropy: frames_and_axes_do_not_matter;
    rest: rest_is_as_promised;
    wave_speed: wave_speed_bounds_the_acoustic_tensor;
    undefined: undefined_is_not_finite;
}

/// A Neo-Hookean solid of which one promise is not kept.
struct Lying(NeoHookean, &'static str);

impl Material<2> for Lying {
    fn energy_density(&self, F: &Matrix<2>) -> f64 {
        self.0.energy_density(F)
    }

    fn kirchhoff_stress(&self, F: &Matrix<2>) -> Matrix<2> {
        match self.1 {
            "stress" => self.0.kirchhoff_stress(F) * 1.01,
            "undefined" if F.determinant() < 0.0 => Matrix::ZERO,
            _ => self.0.kirchhoff_stress(F),
        }
    }

    fn first_piola_kirchhoff(&self, F: &Matrix<2>) -> Matrix<2> {
        self.0.first_piola_kirchhoff(F)
    }

    fn wave_speed(&self, F: &Matrix<2>, reference_density: f64) -> f64 {
        let speed = Material::wave_speed(&self.0, F, reference_density);
        speed * if self.1 == "wave speed" { 0.5 } else { 1.0 }
    }
}

fn holds(promise: &'static str) {
    let F = Matrix([[1.1, 0.2], [-0.1, 0.9]]);
    let material = Lying(
        NeoHookean::new(ElasticModuli::new(1.0, 0.3).expect("in range")),
        promise,
    );
    conformance::stress_is_the_derivative_of_energy(&material, &F, 1.0, "lying");
    conformance::wave_speed_bounds_stiffness(&material, &F, 2.0, 1.0, "lying");
    conformance::undefined_is_not_finite(&material, "lying");
}

#[test]
fn a_sound_material_holds() {
    holds("none");
}

#[test]
#[should_panic(expected = "lying, D = 2: P Fᵀ is off by")]
fn a_stress_that_is_not_that_of_the_energy_is_seen() {
    holds("stress");
}

#[test]
#[should_panic(expected = "is below the stiffness")]
fn a_wave_speed_that_is_too_low_is_seen() {
    holds("wave speed");
}

#[test]
#[should_panic(expected = "lying, D = 2: τ is finite at F")]
fn a_stress_of_what_is_turned_inside_out_is_seen() {
    holds("undefined");
}
