//! The stress along axes that fewer than three dimensions leave out is that of space with F = 1 there.

use mpm_materials::{
    DeformingGas, DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, KelvinVoigt, Law, LinearCauchy,
    LinearElastic, NeoHookean, Snow, SofteningHencky, TaitFluid,
};
use mpm_tensor::Matrix;

/// Trial deformations of a walk, and the law in D dimensions and in space along it.
fn agrees<const D: usize, S>(
    name: &str,
    flat: &(impl Law<D, State = S> + ?Sized),
    space: &(impl Law<3, State = S> + ?Sized),
) where
    S: Copy,
{
    let mut here = (Matrix::<D>::IDENTITY, flat.virgin(1.3));
    let mut there = (Matrix::<3>::IDENTITY, space.virgin(1.3));
    let mut largest = 0.0f64;
    for k in 0..12 {
        let rate: Matrix<D> = Matrix::from_fn(|i, j| 0.02 * ((3 * k + 2 * i + j) as f64).sin() - 0.008);
        let wide = Matrix::<3>::from_fn(|i, j| if i < D && j < D { rate.0[i][j] } else { 0.0 });
        here.0 = flat.advance(&((Matrix::IDENTITY + rate) * here.0), &mut here.1);
        there.0 = space.advance(&((Matrix::IDENTITY + wide) * there.0), &mut there.1);
        let across = flat.kirchhoff_stress_across(&here.0, &here.1).expect("known");
        let expected = space.kirchhoff_stress(&there.0, &there.1, &Matrix::ZERO).0[2][2];
        largest = largest.max(expected.abs());
        assert!(
            (across - expected).abs() < 1e-13 * (1.0 + largest),
            "{name}, D = {D}: {across} in place of {expected}"
        );
    }
    assert!(largest > 1e-3, "{name}: {largest}");
}

macro_rules! in_line_and_plane {
    ($name:literal, $law:expr) => {{
        let law = $law;
        agrees::<1, _>($name, &law, &law);
        agrees::<2, _>($name, &law, &law);
    }};
}

#[test]
fn the_stress_across_is_that_of_space() {
    let moduli = ElasticModuli::new(1.0, 0.3).expect("in range");
    in_line_and_plane!("linear elastic", LinearElastic::new(moduli));
    in_line_and_plane!("linear between strain and Cauchy stress", LinearCauchy::new(moduli));
    in_line_and_plane!("Neo-Hookean", NeoHookean::new(moduli));
    in_line_and_plane!("fixed corotated", FixedCorotated::new(moduli));
    in_line_and_plane!("Hencky", Hencky::new(moduli));
    in_line_and_plane!("Kelvin–Voigt", KelvinVoigt::new(moduli, 0.2).expect("in range"));
    in_line_and_plane!("snow", Snow::fresh(moduli));
    let gas = IsothermalGas::new(0.7).expect("positive");
    in_line_and_plane!("gas", gas.with_reference_density(1.3).expect("positive"));
    // Fluids keep their volume alone, and yielding metal flows across too.
    in_line_and_plane!(
        "softening",
        SofteningHencky::new(moduli, 0.02, 0.01, 2.0).expect("in range")
    );
    in_line_and_plane!("Tait fluid", TaitFluid::new(1.3, 1.0, 0.0).expect("in range"));
    in_line_and_plane!("deforming gas", DeformingGas { gas });
}

#[test]
fn what_grains_feel_across_is_not_known() {
    let moduli = ElasticModuli::new(1.0, 0.3).expect("in range");
    let sand = DruckerPrager::new(moduli, 0.5).expect("in range");
    let state = Law::<2>::virgin(&sand, 1.0);
    assert_eq!(sand.kirchhoff_stress_across(&Matrix::<2>::IDENTITY, &state), None);
}
