//! What the sample points count.

use rayon::prelude::*;

use super::SampleWeights;
use crate::nearest::nearest;

impl SampleWeights {
    /// ω_p of the sample points with these numbers; none where all are 1.
    pub(super) fn of<const D: usize>(self, reference: &[[f64; D]], samples: &[u32]) -> Vec<f64> {
        if self == Self::Equal || samples.len() == reference.len() {
            return Vec::new();
        }
        let places: Vec<[f64; D]> = samples.iter().map(|&p| reference[p as usize]).collect();
        let nearest: Vec<usize> = reference.par_iter().map(|x| nearest(x, &places)).collect();
        let mut weights = vec![0.0; samples.len()];
        nearest.into_iter().for_each(|sample| weights[sample] += 1.0);
        weights
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sample_counts_the_points_around_it() {
        let line: Vec<[f64; 1]> = (0..10).map(|k| [f64::from(k)]).collect();
        let weights = |samples: &[u32]| SampleWeights::Nearest.of(&line, samples);
        assert_eq!(weights(&[0, 1, 7]), [1.0, 4.0, 5.0], "4 is as far from 1 as from 7");
        assert!(weights(&(0..10).collect::<Vec<_>>()).is_empty());
        assert!(SampleWeights::Equal.of(&line, &[0, 1, 7]).is_empty());
    }
}
