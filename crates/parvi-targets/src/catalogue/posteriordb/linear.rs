//! Normal linear models: test scores of children, the yield of mesquite bushes, a regression on correlated columns.

use mpm_tensor::vector;

use super::model_posterior::{Description, FREE, LOGARITHM, ModelPosterior};
use super::prior::{Prior, centred_normal};
use crate::catalogue::numbers::rows;
use crate::{Constraints, Target, TargetError};

/// The likelihood of x = (β_1, …, β_{N−1}, σ): y_i ~ N(Σ_k β_k x_ik, σ²), independently for i = 1, …, n.
///
/// With residuals e_i = y_i − Σ_k β_k x_ik and S = Σ e_i², log L = −½ S/σ² − n log σ,
/// score_{β_k} = Σ e_i x_ik/σ², score_σ = (S/σ² − n)/σ.
#[derive(Clone, Debug)]
pub struct LinearModel<const N: usize> {
    /// (x_i1, …, x_i(N−1), y_i).
    rows: Vec<[f64; N]>,
}

/// N = D = the number of coefficients and σ.
type LinearPosterior<const N: usize> = ModelPosterior<LinearModel<N>, N, N>;

impl LinearModel<5> {
    /// Test scores of 434 children of three or four years by their mothers' schooling h (finished high school: 1) and
    /// intelligence quotient q: x = (1, h, q, h q); flat priors of β, σ ~ half-Cauchy(2.5).
    ///
    /// Source: posteriordb, `kidiq-kidscore_interaction`; A. Gelman, J. Hill, *Data Analysis Using Regression and
    /// Multilevel/Hierarchical Models*, 2006, ch. 3.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn kidscore() -> Result<LinearPosterior<5>, TargetError> {
        let data = rows("kidiq.csv", include_str!("../../../data/posteriordb/kidiq.csv"))?;
        let rows = data
            .iter()
            .map(|&[school, quotient, score]| [1.0, school, quotient, school * quotient, score]);
        let scale = Prior::HalfCauchy { scale: 2.5 };
        Self::posterior("kidscore", rows, Prior::Flat, scale, [-10.0, 50.0, 1.0, -0.5, 18.0])
    }

    /// Leaf weight of 46 mesquite bushes in grams: log y on x = (1, log(a b h), log(a b), g), with the diameters a, b and the
    /// height h of the canopy in metres and the group of measurements g; flat priors of β and σ.
    ///
    /// Source: posteriordb, `mesquite-logmesquite_logva`; Gelman & Hill 2006, ch. 4.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn mesquite() -> Result<LinearPosterior<5>, TargetError> {
        let data = rows("mesquite.csv", include_str!("../../../data/posteriordb/mesquite.csv"))?;
        let rows = data.iter().map(|&[long, short, height, group, weight]: &[f64; 5]| {
            let area = long * short;
            [1.0, (area * height).ln(), area.ln(), group, weight.ln()]
        });
        Self::posterior("mesquite", rows, Prior::Flat, Prior::Flat, [5.2, 0.8, 0.2, -0.5, 0.35])
    }
}

impl LinearModel<6> {
    /// 100 synthetic responses to five strongly correlated covariates; β_k ~ N(0, 10²), σ ~ half-normal(10).
    ///
    /// Source: posteriordb, `sblrc-blr`.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn blr() -> Result<LinearPosterior<6>, TargetError> {
        let rows = rows("sblrc.csv", include_str!("../../../data/posteriordb/sblrc.csv"))?;
        let prior = centred_normal(10.0);
        Self::posterior("blr", rows, prior, prior, [1.0; 6])
    }
}

impl<const N: usize> LinearModel<N> {
    fn posterior(
        name: &'static str,
        rows: impl IntoIterator<Item = [f64; N]>,
        coefficient: Prior,
        scale: Prior,
        start: [f64; N],
    ) -> Result<LinearPosterior<N>, TargetError> {
        let rows = rows.into_iter().collect();
        let description = Description {
            name,
            priors: Self::of_each(coefficient, scale),
            constraints: Constraints::builder().free(N - 1).positive(1).build()?,
            reach: Self::of_each(FREE, LOGARITHM),
            start,
        };
        ModelPosterior::new(Self { rows }, description)
    }

    /// The same for every coefficient, and what holds for σ.
    fn of_each<T: Copy>(coefficient: T, scale: T) -> [T; N] {
        std::array::from_fn(|k| if k + 1 < N { coefficient } else { scale })
    }

    /// (β, −1), whose product with a row is −e_i.
    fn weights(x: &[f64; N]) -> [f64; N] {
        let mut weights = *x;
        weights[N - 1] = -1.0;
        weights
    }
}

impl<const N: usize> Target<N> for LinearModel<N> {
    fn log_density(&self, x: &[f64; N]) -> f64 {
        let (weights, sigma) = (Self::weights(x), x[N - 1]);
        let square = |row| (vector::dot(row, &weights) / sigma).powi(2);
        let squares: f64 = self.rows.iter().map(square).sum();
        -0.5 * squares - self.rows.len() as f64 * sigma.ln()
    }

    fn score(&self, x: &[f64; N]) -> [f64; N] {
        let (weights, sigma) = (Self::weights(x), x[N - 1]);
        let (mut score, mut squares) = ([0.0; N], 0.0);
        for row in &self.rows {
            let residual = -vector::dot(row, &weights) / sigma;
            squares += residual * residual;
            vector::accumulate(&mut score, residual / sigma, row);
        }
        score[N - 1] = (squares - self.rows.len() as f64) / sigma;
        score
    }
}
