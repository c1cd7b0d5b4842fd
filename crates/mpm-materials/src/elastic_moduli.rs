//! The two moduli of isotropic elasticity.

use crate::ParameterError;
use crate::error::{positive, within};

/// Lamé's parameters λ and μ of an isotropic elastic solid, in units of stress.
///
/// From Young's modulus E and Poisson's ratio ν by μ = E / 2(1+ν), λ = Eν / ((1+ν)(1−2ν)), the relations of three
/// dimensions (and of plane strain in two). The law in D dimensions uses λ and μ as they are, as in the ParVI paper, so
/// E and ν keep their measured meaning for D = 3 only.
///
/// A bar (D = 1) whose stress is E times its strain has λ + 2μ = E: take ν = 0, where λ = 0 and μ = E/2, and
/// [`LinearElastic`](crate::LinearElastic) is P = E (F − 1). Any other ν adds the stiffness of sides held in place
/// (uniaxial strain).
///
/// E > 0 and −1 < ν < 1/2 are required, that is μ > 0 and λ > −2μ/3. Then waves of small amplitude are stable in any D
/// (μ > 0, λ + 2μ > 0). In D > 3 dimensions the bulk modulus λ + 2μ/D is positive only for ν > −1/(D−2); below, a
/// uniform expansion releases energy. ν ≥ 0 is safe everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ElasticModuli {
    first_lame_parameter: f64,
    shear_modulus: f64,
}

impl ElasticModuli {
    /// From Young's modulus E (stress) and Poisson's ratio ν (no unit).
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < E < ∞ and −1 < ν < 1/2, and unless λ and μ are finite and μ is positive to rounding.
    pub fn new(young_modulus: f64, poisson_ratio: f64) -> Result<Self, ParameterError> {
        let E = positive("young_modulus", young_modulus)?;
        let between = poisson_ratio > -1.0 && poisson_ratio < 0.5;
        let nu = within("poisson_ratio", poisson_ratio, between, "strictly between -1 and 1/2")?;
        let moduli = Self::from_lame(E * nu / ((1.0 + nu) * (1.0 - 2.0 * nu)), E / (2.0 * (1.0 + nu)));
        within(
            "young_modulus",
            E,
            moduli.is_ok(),
            "of a size that leaves both moduli finite",
        )?;
        moduli
    }

    /// From Lamé's first parameter λ and the shear modulus μ (both stress).
    ///
    /// # Errors
    ///
    /// [`ParameterError`] unless 0 < μ < ∞ and −2μ/3 < λ < ∞.
    pub fn from_lame(first_lame_parameter: f64, shear_modulus: f64) -> Result<Self, ParameterError> {
        let shear_modulus = positive("shear_modulus", shear_modulus)?;
        let above = first_lame_parameter > -2.0 / 3.0 * shear_modulus && first_lame_parameter.is_finite();
        let expected = "finite and above -2/3 of the shear modulus";
        Ok(Self {
            first_lame_parameter: within("first_lame_parameter", first_lame_parameter, above, expected)?,
            shear_modulus,
        })
    }

    /// Lamé's first parameter λ.
    #[inline]
    pub fn first_lame_parameter(&self) -> f64 {
        self.first_lame_parameter
    }

    /// The shear modulus μ.
    #[inline]
    pub fn shear_modulus(&self) -> f64 {
        self.shear_modulus
    }

    /// The P-wave modulus λ + 2μ; √((λ + 2μ)/ρ₀) is the speed of pressure waves at rest.
    #[inline]
    pub fn p_wave_modulus(&self) -> f64 {
        self.first_lame_parameter + 2.0 * self.shear_modulus
    }

    /// The bulk modulus λ + 2μ/D of a body of D dimensions; infinite or NaN for D = 0.
    #[inline]
    pub fn bulk_modulus(&self, dimension: usize) -> f64 {
        self.first_lame_parameter + 2.0 * self.shear_modulus / dimension as f64
    }

    /// Young's modulus E = μ (3λ + 2μ) / (λ + μ).
    #[inline]
    pub fn young_modulus(&self) -> f64 {
        let (lambda, mu) = (self.first_lame_parameter, self.shear_modulus);
        mu * ((3.0 * lambda + 2.0 * mu) / (lambda + mu))
    }

    /// Poisson's ratio ν = λ / 2(λ + μ).
    #[inline]
    pub fn poisson_ratio(&self) -> f64 {
        self.first_lame_parameter / (2.0 * (self.first_lame_parameter + self.shear_modulus))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn moduli_follow_their_formulas_and_back() {
        let moduli = ElasticModuli::new(5.2, 0.3).expect("in range");
        assert!((moduli.shear_modulus() - 2.0).abs() < 1e-15);
        assert!((moduli.first_lame_parameter() - 3.0).abs() < 1e-14);
        assert!((moduli.p_wave_modulus() - 7.0).abs() < 1e-14);
        assert!((moduli.bulk_modulus(3) - 13.0 / 3.0).abs() < 1e-14);
        for nu in [-0.99, -0.5, 0.0, 0.25, 0.4999] {
            let moduli = ElasticModuli::new(1e5, nu).expect("in range");
            assert!((moduli.young_modulus() / 1e5 - 1.0).abs() < 1e-12);
            assert!((moduli.poisson_ratio() - nu).abs() < 1e-12);
            assert!(moduli.bulk_modulus(3) > 0.0);
        }
    }

    #[test]
    fn the_bulk_modulus_in_many_dimensions_changes_sign_where_stated() {
        let at = |nu| ElasticModuli::new(1.0, nu).expect("in range").bulk_modulus(6);
        assert!(at(-0.24) > 0.0 && at(-0.26) < 0.0);
    }

    fn refused(moduli: Result<ElasticModuli, ParameterError>) -> (&'static str, f64) {
        moduli.expect_err("out of range").parameter()
    }

    #[test]
    fn parameters_out_of_range_are_named() {
        for value in [0.0, -1.0, f64::INFINITY] {
            assert_eq!(refused(ElasticModuli::new(value, 0.3)), ("young_modulus", value));
            assert_eq!(refused(ElasticModuli::from_lame(1.0, value)), ("shear_modulus", value));
        }
        for value in [-1.0, 0.5, 2.0, f64::NEG_INFINITY] {
            assert_eq!(refused(ElasticModuli::new(1.0, value)), ("poisson_ratio", value));
        }
        assert!(ElasticModuli::new(f64::NAN, 0.3).is_err() && ElasticModuli::new(1.0, f64::NAN).is_err());
        let border = ElasticModuli::from_lame(-1.0, 1.5);
        assert_eq!(refused(border), ("first_lame_parameter", -1.0));
        let message = ElasticModuli::new(1.0, 0.5).expect_err("incompressible").to_string();
        assert_eq!(message, "poisson_ratio must be strictly between -1 and 1/2, not 0.5");
        let overflow = ElasticModuli::new(1e308, 0.5 - 1e-16);
        assert_eq!(refused(overflow), ("young_modulus", 1e308), "lambda overflows");
    }
}
