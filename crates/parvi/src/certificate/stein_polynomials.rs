//! Functions whose expectation is known: the Stein operator of the target on polynomials.

/// The polynomials ψ_a(z) = Π_i h_{a_i}(z_i) with 1 ≤ |a| ≤ n and their images under the second-order Stein operator
/// A ψ = Δψ + s·∇ψ, for which E\[A ψ\] = 0 under the target.
///
/// h_n = He_n / √n! are the normalised Hermite polynomials, h_n' = √n h_{n−1}, so that A ψ_a = −|a| ψ_a for N(0, I). Source: R. Assaraf, M.
/// Caffarel, Phys. Rev. Lett. 83 (1999) 4682; A. Mira, R. Solgi, D. Imparato, Stat. Comput. 23 (2013) 653–662, Eq. 8.
#[derive(Clone, Debug)]
pub(super) struct SteinPolynomials<const D: usize> {
    degree: usize,
    indices: Vec<[u8; D]>,
}

impl<const D: usize> SteinPolynomials<D> {
    /// Number of polynomials up to this degree: (D + n)! / (D! n!) − 1.
    pub fn count(degree: usize) -> usize {
        (1..=degree).fold(1, |count, k| count * (D + k) / k) - 1
    }

    /// All up to a total degree.
    pub fn new(degree: usize) -> Self {
        let mut indices = Vec::with_capacity(Self::count(degree));
        collect(&mut [0; D], 0, degree, &mut indices);
        indices.retain(|index| index.iter().any(|&a| a > 0));
        Self { degree, indices }
    }

    /// How many there are.
    pub fn len(&self) -> usize {
        self.indices.len()
    }

    /// A ψ_a at a point z with score s, for every a.
    pub fn evaluate(&self, z: &[f64; D], s: &[f64; D], mut out: impl FnMut(usize, f64)) {
        let mut hermite = [[1.0; D]; MAXIMUM_DEGREE + 1];
        for i in 0..D {
            for n in 1..=self.degree {
                let earlier = if n > 1 { hermite[n - 2][i] } else { 0.0 };
                hermite[n][i] = (z[i] * hermite[n - 1][i] - ((n - 1) as f64).sqrt() * earlier) / (n as f64).sqrt();
            }
        }
        for (k, index) in self.indices.iter().enumerate() {
            let mut sum = 0.0;
            for i in 0..D {
                let n = usize::from(index[i]);
                if n == 0 {
                    continue;
                }
                let mut term = s[i] * (n as f64).sqrt() * hermite[n - 1][i];
                if n > 1 {
                    term += ((n * (n - 1)) as f64).sqrt() * hermite[n - 2][i];
                }
                for j in 0..D {
                    if j != i {
                        term *= hermite[usize::from(index[j])][j];
                    }
                }
                sum += term;
            }
            out(k, sum);
        }
    }
}

/// Degrees beyond this are not offered.
pub(super) const MAXIMUM_DEGREE: usize = 12;

fn collect<const D: usize>(index: &mut [u8; D], axis: usize, left: usize, all: &mut Vec<[u8; D]>) {
    if axis == D {
        all.push(*index);
        return;
    }
    for n in 0..=left {
        index[axis] = n as u8;
        collect(index, axis + 1, left - n, all);
    }
    index[axis] = 0;
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hermite_polynomials_are_eigenfunctions_for_the_standard_normal() {
        let polynomials = SteinPolynomials::<3>::new(4);
        assert_eq!(polynomials.len(), SteinPolynomials::<3>::count(4));
        let z = [0.3, -1.2, 2.0];
        let h = |n: u8, x: f64| match n {
            0 => 1.0,
            1 => x,
            2 => (x * x - 1.0) / 2f64.sqrt(),
            3 => (x * x * x - 3.0 * x) / 6f64.sqrt(),
            _ => (x * x * x * x - 6.0 * x * x + 3.0) / 24f64.sqrt(),
        };
        polynomials.evaluate(&z, &z.map(|c| -c), |k, value| {
            let index = polynomials.indices[k];
            let psi: f64 = (0..3).map(|i| h(index[i], z[i])).product();
            let degree: u8 = index.iter().sum();
            assert!(
                (value + f64::from(degree) * psi).abs() < 1e-12 * psi.abs().max(1.0),
                "{index:?}"
            );
        });
    }

    #[test]
    fn the_operator_is_the_divergence_of_the_gradient_weighted_with_the_density() {
        // A ψ = ∇·(p ∇ψ) / p by differences, p = exp(−x⁴ − y²/2 + x y).
        let polynomials = SteinPolynomials::<2>::new(3);
        let density = |x: f64, y: f64| (-x.powi(4) - 0.5 * y * y + x * y).exp();
        let (x, y, step) = (0.4, -0.7, 1e-4);
        let gradient = |x: f64, y: f64| {
            // ∇ψ from A ψ of two scores: A ψ is affine in s with slope ∇ψ.
            let at = |s: [f64; 2]| {
                let mut values = vec![0.0; polynomials.len()];
                polynomials.evaluate(&[x, y], &s, |k, value| values[k] = value);
                values
            };
            let (base, first, second) = (at([0.0; 2]), at([1.0, 0.0]), at([0.0, 1.0]));
            (0..base.len())
                .map(|k| [first[k] - base[k], second[k] - base[k]])
                .collect::<Vec<_>>()
        };
        let flux = |x: f64, y: f64, axis: usize| -> Vec<f64> {
            gradient(x, y).iter().map(|g| density(x, y) * g[axis]).collect()
        };
        let (right, left) = (flux(x + step, y, 0), flux(x - step, y, 0));
        let (up, down) = (flux(x, y + step, 1), flux(x, y - step, 1));
        polynomials.evaluate(&[x, y], &[-4.0 * x.powi(3) + y, x - y], |k, value| {
            let divergence = (right[k] - left[k] + up[k] - down[k]) / (2.0 * step);
            assert!((value - divergence / density(x, y)).abs() < 1e-6, "{k}");
        });
    }
}
