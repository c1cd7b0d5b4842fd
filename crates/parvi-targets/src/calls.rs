//! Many points of a target, in calls of as many as it takes, side by side.

use crate::Target;

/// ∇ log p at all of `xs`, into `out`: [`points_per_call`](Target::points_per_call) points in a call, calls side by side; all of them in one call where [scores depend on
/// calls](Target::scores_depend_on_calls).
pub fn scores_in_calls<const D: usize>(target: &(impl Target<D> + ?Sized), xs: &[[f64; D]], out: &mut [[f64; D]]) {
    if target.scores_depend_on_calls() {
        target.scores(xs, out);
    } else {
        in_calls(target.points_per_call(), xs, out, |xs, out| target.scores(xs, out));
    }
}

/// log p at all of `xs`, into `out`: [`points_per_call`](Target::points_per_call) points in a call, calls side by side.
pub fn log_densities_in_calls<const D: usize>(target: &(impl Target<D> + ?Sized), xs: &[[f64; D]], out: &mut [f64]) {
    in_calls(target.points_per_call(), xs, out, |xs, out| {
        target.log_densities(xs, out);
    });
}

/// So many points in a call, calls side by side.
fn in_calls<const D: usize, R: Send>(
    points: usize,
    xs: &[[f64; D]],
    out: &mut [R],
    call: impl Fn(&[[f64; D]], &mut [R]) + Sync,
) {
    let points = points.max(1);
    if xs.len() <= points {
        call(xs, out);
    } else {
        let calls = xs.chunks(points).zip(out.chunks_mut(points));
        mpm_parallel::each(calls, &|(xs, out): (&[[f64; D]], &mut [R])| call(xs, out));
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;

    /// x ↦ −x, and the lengths of all calls.
    struct Told {
        points: usize,
        depends: bool,
        calls: Mutex<Vec<usize>>,
    }

    impl Target<1> for Told {
        fn log_density(&self, x: &[f64; 1]) -> f64 {
            -0.5 * x[0] * x[0]
        }

        fn score(&self, x: &[f64; 1]) -> [f64; 1] {
            [-x[0]]
        }

        fn points_per_call(&self) -> usize {
            self.points
        }

        fn scores_depend_on_calls(&self) -> bool {
            self.depends
        }

        fn scores(&self, xs: &[[f64; 1]], out: &mut [[f64; 1]]) {
            self.calls.lock().unwrap().push(xs.len());
            xs.iter().zip(out).for_each(|(x, out)| *out = self.score(x));
        }

        fn log_densities(&self, xs: &[[f64; 1]], out: &mut [f64]) {
            self.calls.lock().unwrap().push(xs.len());
            xs.iter().zip(out).for_each(|(x, out)| *out = self.log_density(x));
        }
    }

    #[test]
    fn calls_have_as_many_points_as_the_target_takes() {
        let xs: Vec<[f64; 1]> = (0..10).map(|i| [f64::from(i)]).collect();
        for (points, depends, expected) in [
            (0, false, vec![1; 10]),
            (1, false, vec![1; 10]),
            (4, false, vec![2, 4, 4]),
            (256, false, vec![10]),
            (4, true, vec![10]),
        ] {
            let target = Told {
                points,
                depends,
                calls: Mutex::default(),
            };
            let called = || {
                let mut calls = std::mem::take(&mut *target.calls.lock().unwrap());
                calls.sort_unstable();
                calls
            };
            let mut scores = vec![[0.0]; 10];
            scores_in_calls(&target, &xs, &mut scores);
            assert_eq!(called(), expected, "{points}");
            assert!(scores.iter().zip(&xs).all(|(score, x)| score[0] == -x[0]));
            let mut log_densities = vec![0.0; 10];
            log_densities_in_calls(&target, &xs, &mut log_densities);
            assert!(depends || called() == expected, "{points}");
            assert_eq!(log_densities[9], -40.5);
        }
    }
}
