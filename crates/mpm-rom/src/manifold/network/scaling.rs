use serde::{Deserialize, Serialize};

/// How lengths enter and leave the network: u_k = (X_k − centre_k) factor_k runs through [−1, 1] over the body at rest, and
/// g̃_c = mean_c + deviation_c y_c has the mean and the standard deviation of the training positions where y has 0 and 1.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Scaling {
    /// Middle of the body's extent at rest (m), D entries.
    pub centre: Vec<f64>,
    /// 2 / extent (1/m), D entries.
    pub factor: Vec<f64>,
    /// Mean of the training positions (m), D entries.
    pub mean: Vec<f64>,
    /// Standard deviation of the training positions (m), D entries.
    pub deviation: Vec<f64>,
}

impl Scaling {
    /// The scaling of reference positions and of the positions that a network is trained on. An axis without extent or deviation gets the
    /// largest one of the others, or 1 if there is none: its scaled coordinate is constant anyhow.
    pub fn fit<'a, const D: usize>(
        reference: &[[f64; D]],
        positions: impl Iterator<Item = &'a [f64; D]> + Clone,
    ) -> Self {
        let (mut lower, mut upper) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
        for position in reference {
            for k in 0..D {
                lower[k] = lower[k].min(position[k]);
                upper[k] = upper[k].max(position[k]);
            }
        }
        let extent: [f64; D] = std::array::from_fn(|k| upper[k] - lower[k]);
        let (mut sum, mut count) = ([0.0; D], 0.0);
        for position in positions.clone() {
            count += 1.0;
            for k in 0..D {
                sum[k] += position[k];
            }
        }
        let mean: [f64; D] = std::array::from_fn(|k| sum[k] / count);
        let mut square = [0.0; D];
        for position in positions {
            for k in 0..D {
                square[k] += (position[k] - mean[k]).powi(2);
            }
        }
        let deviation: [f64; D] = std::array::from_fn(|k| (square[k] / count).sqrt());
        Self {
            centre: (0..D).map(|k| 0.5 * (lower[k] + upper[k])).collect(),
            factor: positive(extent).map(|extent| 2.0 / extent).to_vec(),
            mean: mean.to_vec(),
            deviation: positive(deviation).to_vec(),
        }
    }

    /// The unit of length of the loss: the root of the mean of deviation_c² (m).
    pub fn length(&self) -> f64 {
        let squares: f64 = self.deviation.iter().map(|deviation| deviation * deviation).sum();
        (squares / self.deviation.len() as f64).sqrt()
    }

    /// Whether every list has D finite entries and factors and deviations are positive.
    pub fn is_sound(&self, dimension: usize) -> bool {
        let lists = [&self.centre, &self.factor, &self.mean, &self.deviation];
        let scales = self.factor.iter().chain(&self.deviation);
        lists
            .iter()
            .all(|list| list.len() == dimension && list.iter().all(|value| value.is_finite()))
            && scales.clone().all(|&scale| scale > 0.0)
    }
}

/// Entries that are not positive replaced by the largest one, or by 1.
fn positive<const D: usize>(sizes: [f64; D]) -> [f64; D] {
    let largest = sizes.iter().copied().fold(0.0, f64::max);
    let substitute = if largest > 0.0 { largest } else { 1.0 };
    sizes.map(|size| {
        if size > 1e-12 * largest && size > 0.0 {
            size
        } else {
            substitute
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extent_becomes_two_and_deviation_is_that_of_the_positions() {
        let reference = [[1.0, 5.0], [3.0, 5.0]];
        let positions = [[0.0, 2.0], [4.0, 2.0]];
        let scaling = Scaling::fit(&reference, positions.iter());
        assert_eq!(scaling.centre, [2.0, 5.0]);
        assert_eq!(scaling.factor, [1.0, 1.0], "the flat axis takes the other's extent");
        assert_eq!(scaling.mean, [2.0, 2.0]);
        assert_eq!(scaling.deviation, [2.0, 2.0]);
        assert_eq!(scaling.length(), 2.0);
        assert!(scaling.is_sound(2) && !scaling.is_sound(3));
    }
}
