//! Densities that are a prior times many terms.

use mpm_tensor::vector;

/// log p(x) = ℓ₀(x) + Σ_{i<n} ℓ_i(x): a log prior ℓ₀ and a term for each of n independent rows of data.
///
/// [`MinibatchScore`](crate::MinibatchScore) makes a [`Target`](crate::Target) of it.
pub trait SumTarget<const D: usize>: Sync {
    /// n.
    fn terms(&self) -> usize;

    /// ℓ₀(x), up to a constant.
    fn prior_log_density(&self, x: &[f64; D]) -> f64;

    /// ∇ℓ₀(x).
    fn prior_score(&self, x: &[f64; D]) -> [f64; D];

    /// ℓ_i(x), up to a constant, for i = `term` below n.
    fn term_log_density(&self, term: usize, x: &[f64; D]) -> f64;

    /// ∇ℓ_i(x), for i = `term` below n.
    fn term_score(&self, term: usize, x: &[f64; D]) -> [f64; D];

    /// `out[p]` = Σ_{i ∈ terms} ∇ℓ_i(xs\[p\]): the same terms for every point.
    ///
    /// Override it where a batch is cheaper than its parts. `xs` and `out` have the same length, the sum of a point is the same
    /// bits wherever it stands in `xs`. Parallel over the points unless overridden.
    fn sums_of_term_scores(&self, terms: &[usize], xs: &[[f64; D]], out: &mut [[f64; D]]) {
        mpm_parallel::write(xs, out, &|x| {
            let mut sum = [0.0; D];
            for &term in terms {
                vector::accumulate(&mut sum, 1.0, &self.term_score(term, x));
            }
            sum
        });
    }

    /// log p(x), the sum over all terms.
    fn full_log_density(&self, x: &[f64; D]) -> f64 {
        let terms: f64 = (0..self.terms()).map(|term| self.term_log_density(term, x)).sum();
        self.prior_log_density(x) + terms
    }
}

/// A sum may be lent to what takes one.
impl<T: SumTarget<D> + ?Sized, const D: usize> SumTarget<D> for &T {
    fn terms(&self) -> usize {
        (**self).terms()
    }

    fn prior_log_density(&self, x: &[f64; D]) -> f64 {
        (**self).prior_log_density(x)
    }

    fn prior_score(&self, x: &[f64; D]) -> [f64; D] {
        (**self).prior_score(x)
    }

    fn term_log_density(&self, term: usize, x: &[f64; D]) -> f64 {
        (**self).term_log_density(term, x)
    }

    fn term_score(&self, term: usize, x: &[f64; D]) -> [f64; D] {
        (**self).term_score(term, x)
    }

    fn sums_of_term_scores(&self, terms: &[usize], xs: &[[f64; D]], out: &mut [[f64; D]]) {
        (**self).sums_of_term_scores(terms, xs, out);
    }

    fn full_log_density(&self, x: &[f64; D]) -> f64 {
        (**self).full_log_density(x)
    }
}
