//! Hares and lynxes: a predator–prey model in ordinary differential equations.

use super::model_posterior::{Description, LOGARITHM, ModelPosterior};
use super::prior::Prior;
use crate::catalogue::numbers::rows;
use crate::{Constraints, Target, TargetError};

/// Runge–Kutta steps per year.
const STEPS: usize = 16;

/// Populations are followed between e^−12 and e^12 thousand.
const LARGEST_LOGARITHM: f64 = 12.0;

/// Slopes are followed up to this.
const LARGEST_SLOPE: f64 = 1e100;

/// The likelihood of x = (α, β, γ, δ, u_0, v_0, σ_1, σ_2) for yearly numbers y_t1 of hares and y_t2 of lynxes:
/// log y_t1 ~ N(log u(t), σ_1²), log y_t2 ~ N(log v(t), σ_2²), t = 0, 1, …, where u(0) = u_0, v(0) = v_0 and
///
/// d log u/dt = α − β v, d log v/dt = δ u − γ.
///
/// With z_tk the residuals over σ_k, log L = −Σ (½ z_tk² + log σ_k), score_{σ_k} = Σ_t (z_tk² − 1)/σ_k and
/// score_j = Σ z_tk ∂_j log (u, v)_k/σ_k for the others, whose slopes obey the linearised equations. The classical Runge–Kutta
/// scheme takes 16 steps per year for populations and slopes together, so that the score is that of the discrete
/// solution to rounding. Populations that leave [e⁻¹², e¹²] thousand stay what they were before.
///
/// Source of the model: B. Carpenter, *Predator–prey population dynamics: the Lotka–Volterra model in Stan* (2018).
#[derive(Clone, Debug)]
pub struct LotkaVolterra {
    /// log y_t.
    logarithms: Vec<[f64; 2]>,
}

/// log u and log v, each followed by its W − 1 slopes by (α, β, γ, δ, u_0, v_0).
type State<const W: usize> = [[f64; W]; 2];

impl LotkaVolterra {
    /// Pelts of the Hudson's Bay Company in thousands, 1900 to 1920; α, γ ~ N(1, 0.5²), β, δ ~ N(0.05, 0.05²),
    /// u_0, v_0 ~ log-normal(log 10, 1), σ ~ log-normal(−1, 1), all positive.
    ///
    /// Source: posteriordb, `hudson_lynx_hare-lotka_volterra`.
    ///
    /// # Errors
    /// Those of [`Laplace::find`](crate::Laplace::find) and [`ImportanceSample::new`](crate::ImportanceSample::new).
    pub fn posterior() -> Result<ModelPosterior<Self, 8, 8>, TargetError> {
        let file = include_str!("../../../data/posteriordb/hudson_lynx_hare.csv");
        let numbers = rows::<2>("hudson_lynx_hare.csv", file)?;
        let logarithms = numbers.iter().map(|pair| pair.map(f64::ln)).collect();
        let normal = |mean, standard_deviation| Prior::Normal {
            mean,
            standard_deviation,
        };
        let log_normal = |mean, standard_deviation| Prior::LogNormal {
            mean,
            standard_deviation,
        };
        let (growth, encounter) = (normal(1.0, 0.5), normal(0.05, 0.05));
        let (first, scale) = (log_normal(10_f64.ln(), 1.0), log_normal(-1.0, 1.0));
        let description = Description {
            name: "lotka-volterra",
            priors: [growth, encounter, growth, encounter, first, first, scale, scale],
            constraints: Constraints::builder().positive(8).build()?,
            reach: [LOGARITHM; 8],
            start: [0.55, 0.028, 0.8, 0.024, 34.0, 5.9, 0.25, 0.25],
        };
        ModelPosterior::new(Self { logarithms }, description)
    }

    /// Visits the state at every observation.
    fn follow<const W: usize>(&self, x: &[f64; 8], mut visit: impl FnMut(&[f64; 2], &State<W>)) {
        let mut state = [[0.0; W]; 2];
        for k in 0..2 {
            state[k][0] = x[4 + k].ln();
            if let Some(slope) = state[k].get_mut(5 + k) {
                *slope = x[4 + k].recip();
            }
        }
        let mut inside = is_inside(&state);
        for observed in &self.logarithms {
            visit(observed, &state);
            for _ in 0..STEPS {
                if inside {
                    let next = step(x, &state);
                    inside = is_inside(&next);
                    state = if inside { next } else { state };
                }
            }
        }
    }
}

fn is_inside<const W: usize>(state: &State<W>) -> bool {
    let of_one = |of_one: &[f64; W]| {
        of_one[0].abs() <= LARGEST_LOGARITHM && of_one[1..].iter().all(|slope| slope.abs() <= LARGEST_SLOPE)
    };
    state.iter().all(of_one)
}

/// d(state)/dt.
fn rate<const W: usize>(&[alpha, beta, gamma, delta, ..]: &[f64; 8], [hare, lynx]: &State<W>) -> State<W> {
    let [u, v] = [hare[0].exp(), lynx[0].exp()];
    let mut rate = [[0.0; W]; 2];
    for k in 1..W {
        rate[0][k] = -beta * v * lynx[k];
        rate[1][k] = delta * u * hare[k];
    }
    if W > 4 {
        rate[0][1] += 1.0;
        rate[0][2] -= v;
        rate[1][3] -= 1.0;
        rate[1][4] += u;
    }
    rate[0][0] = alpha - beta * v;
    rate[1][0] = delta * u - gamma;
    rate
}

/// A step of the classical Runge–Kutta scheme.
fn step<const W: usize>(x: &[f64; 8], state: &State<W>) -> State<W> {
    const STEP: f64 = 1.0 / STEPS as f64;
    let moved = |by: f64, rate: &State<W>| -> State<W> {
        std::array::from_fn(|k| std::array::from_fn(|j| state[k][j] + by * rate[k][j]))
    };
    let first = rate(x, state);
    let second = rate(x, &moved(0.5 * STEP, &first));
    let third = rate(x, &moved(0.5 * STEP, &second));
    let fourth = rate(x, &moved(STEP, &third));
    let mean = std::array::from_fn(|k| {
        std::array::from_fn(|j| (first[k][j] + 2.0 * (second[k][j] + third[k][j]) + fourth[k][j]) / 6.0)
    });
    moved(STEP, &mean)
}

impl Target<8> for LotkaVolterra {
    fn log_density(&self, x: &[f64; 8]) -> f64 {
        let mut sum = -(self.logarithms.len() as f64) * (x[6].ln() + x[7].ln());
        self.follow::<1>(x, |observed, state| {
            for k in 0..2 {
                let residual = (observed[k] - state[k][0]) / x[6 + k];
                sum -= 0.5 * residual * residual;
            }
        });
        sum
    }

    fn score(&self, x: &[f64; 8]) -> [f64; 8] {
        let mut score = [0.0; 8];
        self.follow::<7>(x, |observed, state| {
            for k in 0..2 {
                let residual = (observed[k] - state[k][0]) / x[6 + k];
                for j in 0..6 {
                    score[j] += residual / x[6 + k] * state[k][1 + j];
                }
                score[6 + k] += (residual * residual - 1.0) / x[6 + k];
            }
        });
        score
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// δ u − γ log u + β v − α log v does not change along an orbit.
    #[test]
    fn orbits_are_closed() {
        let x = [0.55, 0.028, 0.8, 0.024, 34.0, 5.9, 0.25, 0.25];
        let model = LotkaVolterra {
            logarithms: vec![[0.0; 2]; 21],
        };
        let mut energies = Vec::new();
        model.follow::<1>(&x, |_, &[[hare], [lynx]]| {
            energies.push(x[3] * hare.exp() - x[2] * hare + x[1] * lynx.exp() - x[0] * lynx);
        });
        let change = |energy: &f64| (energy - energies[0]).abs();
        assert!(energies.iter().all(|energy| change(energy) < 1e-5), "{energies:?}");
    }

    #[test]
    fn populations_that_explode_are_held() {
        let x = [20.0, 1e-20, 0.8, 0.024, 34.0, 5.9, 0.25, 0.25];
        let model = LotkaVolterra {
            logarithms: vec![[0.0; 2]; 21],
        };
        let mut states = Vec::new();
        model.follow::<7>(&x, |_, state| states.push(*state));
        assert_ne!(states[0], states[1]);
        assert!(states[1..].iter().all(|state| state == &states[1] && is_inside(state)));
        assert!(model.score(&x).iter().all(|score| score.is_finite()));
    }
}
