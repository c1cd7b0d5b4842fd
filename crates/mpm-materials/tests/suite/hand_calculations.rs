//! Elastic solids against calculations by hand: λ = 3 and μ = 2, if nothing else is said.

use mpm_materials::{ElasticModuli, FixedCorotated, Hencky, LinearCauchy, LinearElastic, Material, NeoHookean};
use mpm_tensor::Matrix;

/// The solid of λ = 3 and μ = 2.
fn of_lame<M>(new: fn(ElasticModuli) -> M) -> M {
    new(ElasticModuli::from_lame(3.0, 2.0).expect("in range"))
}

/// A stretch of 2 along the first axis, which a quarter turn makes the second.
fn turned_stretch() -> Matrix<2> {
    Matrix([[0.0, -1.0], [1.0, 0.0]]) * Matrix::diagonal(&[2.0, 1.0])
}

/// The distance of the Kirchhoff stress at F from a diagonal one.
fn distance(material: &impl Material<2>, F: &Matrix<2>, stress: [f64; 2]) -> f64 {
    (material.kirchhoff_stress(F) - Matrix::diagonal(&stress)).frobenius_norm()
}

#[test]
fn linear_shear() {
    let material = of_lame(LinearElastic::new);
    let F = Matrix([[1.0, 0.2], [0.0, 1.0]]);
    assert!((material.energy_density(&F) - 0.04).abs() < 1e-16);
    let P = material.first_piola_kirchhoff(&F);
    assert!((P - Matrix([[0.0, 0.4], [0.4, 0.0]])).frobenius_norm() < 1e-15);
    let expected = Matrix([[0.08, 0.4], [0.4, 0.0]]);
    assert!((material.kirchhoff_stress(&F) - expected).frobenius_norm() < 1e-15);
}

#[test]
fn linear_elasticity_takes_a_half_turn_for_a_strain() {
    let half_turn = Matrix::diagonal(&[-1.0, -1.0, 1.0]);
    let energy = of_lame(LinearElastic::new).energy_density(&half_turn);
    assert_eq!(energy, 8.0 * 2.0 + 8.0 * 3.0);
}

#[test]
fn a_linear_bar_without_poisson_ratio_follows_hooke() {
    let bar = LinearElastic::new(ElasticModuli::new(7.0, 0.0).expect("in range"));
    let F = Matrix([[1.25]]);
    assert_eq!(bar.first_piola_kirchhoff(&F), Matrix([[7.0 * 0.25]]));
    assert_eq!(bar.energy_density(&F), 3.5 * 0.0625);
    assert_eq!(bar.wave_speed(&Matrix([[1.0]]), 7.0), 1.0);
}

#[test]
fn turned_stretch_of_hencky() {
    let (material, log_2) = (of_lame(Hencky::new), 2f64.ln());
    let energy = material.energy_density(&turned_stretch());
    assert!((energy - (2.0 + 1.5) * log_2 * log_2).abs() < 1e-15);
    assert!(distance(&material, &turned_stretch(), [3.0 * log_2, 7.0 * log_2]) < 1e-14);
}

#[test]
fn turned_stretch_of_the_fixed_corotated_solid() {
    let material = of_lame(FixedCorotated::new);
    assert!((material.energy_density(&turned_stretch()) - (2.0 + 1.5)).abs() < 1e-15);
    // Principal stresses 2μ·1·2 + λ·1·2 = 14 and 6; the first axis has become the second.
    assert!(distance(&material, &turned_stretch(), [6.0, 14.0]) < 1e-14);
}

#[test]
fn stretch_of_neo_hooke() {
    let (material, log_2) = (of_lame(NeoHookean::new), 2f64.ln());
    let F = Matrix::diagonal(&[2.0, 1.0]);
    assert!((material.energy_density(&F) - (3.0 - 2.0 * log_2 + 1.5 * log_2 * log_2)).abs() < 1e-15);
    assert!(distance(&material, &F, [6.0 + 3.0 * log_2, 3.0 * log_2]) < 1e-14);
}

#[test]
fn stretch_of_linear_cauchy() {
    use mpm_materials::Law;
    // ε = diag(0.5, 0), σ = diag(3.5, 1.5), J = 1.5.
    let (law, F) = (of_lame(LinearCauchy::new), Matrix::diagonal(&[1.5, 1.0]));
    let stress = law.kirchhoff_stress(&F, &(), &Matrix::ZERO);
    assert!((stress - Matrix::diagonal(&[5.25, 2.25])).frobenius_norm() < 1e-15);
    assert_eq!(law.energy_density(&F, &()), 0.5 + 0.375);
}

#[test]
fn a_body_turned_inside_out_has_a_stress_of_the_other_sign() {
    use mpm_materials::Law;
    let law = of_lame(LinearCauchy::new);
    let stress = law.kirchhoff_stress(&Matrix([[-0.5]]), &(), &Matrix::ZERO);
    assert_eq!(stress, Matrix([[7.0 * -1.5 * -0.5]]));
    assert!(Law::<1>::check(&law, &Matrix([[-0.5]])).is_ok());
    assert!(Law::<1>::check(&law, &Matrix([[f64::NAN]])).is_err());
}

#[test]
fn waves_of_linear_cauchy_at_rest_are_those_of_hooke() {
    use mpm_materials::Law;
    let speed = of_lame(LinearCauchy::new).wave_speed(&Matrix::<3>::IDENTITY, &(), 7.0);
    assert!((speed - 1.0).abs() < 1e-15);
}
