//! Posteriors of posteriordb: models of the field on their data, which have published reference draws.
//!
//! Source: M. Magnusson, P. Bürkner, A. Vehtari et al., posteriordb, <https://github.com/stan-dev/posteriordb>, commit 28f8d3d6.

mod arma;
mod garch;
mod gaussian_process;
mod hidden_markov;
mod linear;
mod lotka_volterra;
mod model_posterior;
mod normal_mixture;
mod prior;

pub use arma::Arma;
pub use garch::Garch;
pub use gaussian_process::GaussianProcess;
pub use hidden_markov::HiddenMarkov;
pub use linear::LinearModel;
pub use lotka_volterra::LotkaVolterra;
pub use model_posterior::ModelPosterior;
pub use normal_mixture::NormalMixture;
pub use prior::Prior;

/// The coordinates that a sampler moves, in the names of posteriordb's parameters (`ilr`: isometric log ratios of a simplex);
/// `None` for the name of another target.
pub(crate) fn coordinate_names(target: &str) -> Option<Vec<String>> {
    let names = match target {
        "arma" => "mu, phi, theta, log sigma",
        "garch" => "mu, log alpha0, ilr alpha1, ilr beta1",
        "gaussian-process" => "log rho, log alpha, log sigma",
        "hidden-markov" => "logit theta1[1], logit theta2[1], log mu[1], log (mu[2] - mu[1])",
        "gaussian-mixture-posterior" => "mu[1], log (mu[2] - mu[1]), log sigma[1], log sigma[2], logit theta",
        "kidscore" | "mesquite" => "beta[1], beta[2], beta[3], beta[4], log sigma",
        "blr" => "beta[1], beta[2], beta[3], beta[4], beta[5], log sigma",
        "lotka-volterra" => {
            "log theta[1], log theta[2], log theta[3], log theta[4], log z_init[1], log z_init[2], log sigma[1], log sigma[2]"
        }
        _ => return None,
    };
    Some(names.split(", ").map(str::to_owned).collect())
}
