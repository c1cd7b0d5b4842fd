//! The triangular map nearest to the target, by natural gradients of the Kullback–Leibler divergence.

use mpm_tensor::vector;

use super::density::Density;
use crate::cholesky::Cholesky;
use crate::triangular_map::{Image, TriangularMap, features, location_count};

/// Steps at most.
const STEPS: usize = 10;

/// The search ends where a step would lower the divergence by less than this.
const TOLERANCE: f64 = 2e-3;

/// A step changes no log scale by more than this at any node.
const STRETCH: f64 = 1.0;

/// Share of the predicted fall that a step has to bring (Armijo).
const SUFFICIENT_FALL: f64 = 1e-3;

/// Relative ridge under the Fisher information.
const RIDGE: f64 = 1e-6;

/// A map with what the target says at the images of some nodes.
#[derive(Clone, Debug)]
pub(super) struct Mapped<const D: usize> {
    pub map: TriangularMap<D>,
    images: Vec<Image<D>>,
    pub log_densities: Vec<f64>,
    /// r = ∇_z [log p(x(z)) + log det] + z: the scores' deviation from those of N(0, I).
    residuals: Vec<[f64; D]>,
}

impl<const D: usize> Mapped<D> {
    /// `None` where the target is not finite at an image.
    pub fn new(density: &mut Density<'_, D>, map: TriangularMap<D>, nodes: &[[f64; D]]) -> Option<Self> {
        let images: Vec<Image<D>> = nodes.iter().map(|z| map.image(z)).collect();
        let points: Vec<[f64; D]> = images.iter().map(|image| image.x).collect();
        let values = density.values(&points)?;
        let residuals: Vec<[f64; D]> = nodes
            .iter()
            .zip(&images)
            .zip(&values)
            .map(|((z, image), value)| vector::add(z, &map.pull_back_score(z, image, &value.score)))
            .collect();
        let finite = residuals.iter().all(vector::is_finite);
        finite.then(|| Self {
            log_densities: values.iter().map(|value| value.log_density).collect(),
            map,
            images,
            residuals,
        })
    }

    /// E\[|r|²\] / D, the Fisher divergence between N(0, I) and the target in the coordinates z, per dimension: 0 where the map is exact.
    pub fn fisher_divergence(&self) -> f64 {
        let sum: f64 = self.residuals.iter().map(vector::norm_squared).sum();
        sum / (self.residuals.len() * D) as f64
    }

    /// log p/q at the images, q the density of the map: constant where the map is exact.
    pub fn log_ratios(&self) -> Vec<f64> {
        let ratio = |(log_density, image): (&f64, &Image<D>)| log_density - self.map.log_density(&image.x);
        self.log_densities.iter().zip(&self.images).map(ratio).collect()
    }

    /// E\[log p − log q\], the evidence lower bound: −KL(q ‖ p) up to a constant of the target.
    pub fn lower_bound(&self) -> f64 {
        mean(self.log_ratios())
    }

    /// A step of all parameters and the fall of KL(q ‖ p) that it predicts; `None` where the information is singular.
    fn natural_step(&self, nodes: &[[f64; D]]) -> Option<(Vec<f64>, f64)> {
        let mut step = vec![0.0; self.map.parameters().len()];
        let mut fall = 0.0;
        for i in 0..D {
            let curvature = 1.0 - mean(self.residuals.iter().zip(nodes).map(|(r, z)| r[i] * z[i]));
            let excess = (curvature - 1.0).max(1e-9);
            let begin = TriangularMap::<D>::offset(i);
            let (location, rest) = step[begin..].split_at_mut(location_count(i));
            let scale = &mut rest[..=i];
            for (part, quadratic, share) in [
                (location, true, 1.0 / (1.0 + excess)),
                (scale, false, excess.ln_1p() / excess),
            ] {
                let (information, gradient) = self.information(nodes, i, quadratic);
                let natural = Cholesky::new(information)?.solve(&gradient);
                for ((entry, n), g) in part.iter_mut().zip(natural).zip(gradient) {
                    *entry = share * n;
                    fall += *entry * g;
                }
            }
        }
        Some((step, fall))
    }

    /// The Fisher information of the parameters of m_i (`quadratic`) or l_i, E\[e^{−2 l_i} φ φᵀ\] and 2 E\[κ′² ψ ψᵀ\] with a small ridge, and the path
    /// gradient E\[r_i e^{−l_i} φ\] or E\[r_i z_i κ′ ψ\].
    fn information(&self, nodes: &[[f64; D]], i: usize, quadratic: bool) -> (Vec<Vec<f64>>, Vec<f64>) {
        let size = if quadratic { location_count(i) } else { i + 1 };
        let share = 1.0 / nodes.len() as f64;
        let (mut information, mut gradient) = (vec![vec![0.0; size]; size], vec![0.0; size]);
        for ((z, image), residual) in nodes.iter().zip(&self.images).zip(&self.residuals) {
            let (precision, slope, before) = self.map.sensitivity(i, image);
            let (pull, weight) = if quadratic {
                (precision, precision * precision)
            } else {
                (z[i] * slope, 2.0 * slope * slope)
            };
            let features: Vec<f64> = features(before, quadratic).collect();
            for (row, &a) in features.iter().enumerate() {
                gradient[row] += share * pull * residual[i] * a;
                for (entry, &b) in information[row].iter_mut().zip(&features[..=row]) {
                    *entry += share * weight * a * b;
                }
            }
        }
        for k in 0..size {
            information[k][k] += RIDGE * (information[k][k] + RIDGE);
        }
        (information, gradient)
    }

    /// The largest change of a log scale at a node by this step.
    fn stretch(&self, step: &[f64]) -> f64 {
        let of = |image: &Image<D>, i: usize| {
            let (_, slope, before) = self.map.sensitivity(i, image);
            let coefficients = &step[TriangularMap::<D>::offset(i) + location_count(i)..];
            let change: f64 = features(before, false).zip(coefficients).map(|(f, c)| f * c).sum();
            (slope * change).abs()
        };
        let largest = |image| (0..D).map(|i| of(image, i)).fold(0.0, f64::max);
        self.images.iter().map(largest).fold(0.0, f64::max)
    }

    /// KL(q ‖ p) less KL(q′ ‖ p) for q′ the density of `next`, estimated at the same nodes with the mean over z_i taken in closed form where it is one:
    /// E_q′\[log p/q\] − E_q\[log p/q\] − KL(q′ ‖ q). Without noise where q = p.
    fn fall_to(&self, next: &Self) -> f64 {
        let pairs = next.log_densities.iter().zip(&next.images);
        let seen = pairs.map(|(log_density, image)| {
            log_density - self.map.log_density(&image.x) - next.map.conditional_divergence(image, &self.map)
        });
        mean(seen) - self.lower_bound()
    }
}

/// The map of least KL(q ‖ p) near `start`: natural-gradient steps θ ← θ + F⁻¹ g with the Fisher information F of the map's density
/// (S. Amari, *Natural gradient works efficiently in learning*, Neural Computation 10, 1998, Thm 1).
///
/// The path gradient g leaves out the score of the map's own density, whose mean is zero (G. Roeder, Y. Wu, D. Duvenaud, *Sticking the
/// landing*, NeurIPS 2017, Eq. 7), so that a density which a map represents is found exactly, at any nodes. Where p is narrower than
/// q, by a curvature c = −E\[s_i z_i\] > 1, steps of m_i are divided by c, and those of l_i become ½ log c instead of ½ (c − 1).
/// Steps are shortened until the divergence falls.
pub(super) fn descend<const D: usize>(density: &mut Density<'_, D>, start: Mapped<D>, nodes: &[[f64; D]]) -> Mapped<D> {
    let mut here = start;
    let mut largest: f64 = 1.0;
    for _ in 0..STEPS {
        let Some((step, fall)) = here.natural_step(nodes) else {
            break;
        };
        if fall.is_nan() || fall < TOLERANCE {
            break;
        }
        let first = largest.min(STRETCH / here.stretch(&step).max(1e-12));
        let next = (0..8).map(|k| first * 0.4_f64.powi(k)).find_map(|fraction| {
            let there = Mapped::new(density, here.map.moved(fraction, &step), nodes)?;
            (here.fall_to(&there) >= SUFFICIENT_FALL * fraction * fall).then_some((fraction, there))
        });
        let Some((fraction, there)) = next else { break };
        largest = (2.5 * fraction).min(1.0);
        here = there;
    }
    here
}

/// The mean of some numbers.
pub(super) fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (sum, count) = values
        .into_iter()
        .fold((0.0, 0_usize), |(sum, count), value| (sum + value, count + 1));
    sum / count as f64
}

#[cfg(test)]
mod tests {
    use mpm_tensor::Matrix;
    use parvi_targets::{Frame, Funnel, Target};

    use super::*;
    use crate::survey::gaussian_fit::balanced_nodes;

    /// x₁ ~ N(0, 1), x₂ ~ N(cos 2x₁, 0.5²): a bend that no parabola follows.
    struct Wave;

    impl Target<2> for Wave {
        fn log_density(&self, x: &[f64; 2]) -> f64 {
            let e = x[1] - (2.0 * x[0]).cos();
            -0.5 * x[0] * x[0] - 2.0 * e * e
        }

        fn score(&self, x: &[f64; 2]) -> [f64; 2] {
            let e = x[1] - (2.0 * x[0]).cos();
            [-x[0] - 8.0 * e * (2.0 * x[0]).sin(), -4.0 * e]
        }
    }

    fn descended<const D: usize>(target: &dyn Target<D>) -> (Mapped<D>, Mapped<D>) {
        let frame = Frame::identity();
        let mut density = Density::new(target, &frame);
        let nodes = balanced_nodes::<D>(16 * D, 1).unwrap();
        let covariance = Matrix::IDENTITY * 0.5;
        let map = TriangularMap::gaussian(&[0.0; D], &covariance, std::array::from_fn(|i| i)).unwrap();
        let start = Mapped::new(&mut density, map, &nodes).unwrap();
        (start.clone(), descend(&mut density, start, &nodes))
    }

    #[test]
    fn a_density_that_a_map_represents_is_approached() {
        let (start, end) = descended(&Funnel::<2>::new(1.5).unwrap());
        assert!(start.fisher_divergence() > 0.3, "{}", start.fisher_divergence());
        assert!(end.fisher_divergence() < 0.01, "{}", end.fisher_divergence());
    }

    #[test]
    fn the_divergence_from_another_density_falls_too() {
        let (start, end) = descended(&Wave);
        assert!(
            end.lower_bound() > start.lower_bound() + 0.05,
            "{} {}",
            start.lower_bound(),
            end.lower_bound()
        );
    }
}
