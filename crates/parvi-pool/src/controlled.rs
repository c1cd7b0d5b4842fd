//! The measure as a sample: points and free draws with weights of which none is negative.

use crate::order::extent;
use crate::pool::Pool;

/// Mass that negative weights may have before it is taken from where points are near: with more of it, the way to these costs more than control variates gain.
const LARGEST_DEBT: f64 = 0.02;

/// Mass of the proposals where p is zero from which on free draws, most of which nobody has looked at, are not to be had: beyond an edge of the target there must be none.
const LARGEST_OUTSIDE: f64 = 1e-6;

/// Halvings of the interval in which the weight of the measure is sought.
const HALVINGS: usize = 20;

impl<const D: usize> Pool<D> {
    /// Points with weights that are positive and sum to one, as a rule nearer to the target than all evaluations with their [`weights`](Self::weights) are, of which they are a part, the more so the nearer the last proposals are to it: the others are free draws of
    /// the last proposals, by which [`measure`](Self::measure) takes most of the weights' noise away. Where these proposals reach over an edge of the target it is the evaluations alone.
    ///
    /// θ c + (1 − θ) w, c the weights of the measure, w those of the pool, 0 where nothing was evaluated, and θ in [0, 1] the largest number for which negative ones sum to no less than −0.02.
    /// In coordinates of the measure's frame space is halved along the longest side of its points, again and again; from the smallest halves up, one that owes more than it has
    /// takes the rest from the other, whose weights shrink by a factor. So mass moves no farther than it has to.
    pub fn controlled(&self) -> (Vec<[f64; D]>, Vec<f64>) {
        let (measure, own) = (&self.measure, self.measured());
        let of_pool = |values: &[f64]| -> Vec<f64> {
            let value = |number: &Option<usize>| number.and_then(|number| values.get(number).copied());
            let found = own.iter().take(measure.weights.len()).map(value);
            found.map(Option::unwrap_or_default).collect()
        };
        let (mut weights, logs) = (of_pool(&self.weights), of_pool(&self.log_densities));
        let outside = measure
            .weights
            .iter()
            .zip(&logs)
            .filter(|(_, log)| **log == f64::NEG_INFINITY);
        if outside.map(|(c, _)| c.abs()).sum::<f64>() > LARGEST_OUTSIDE {
            return self.weighing();
        }
        let share = largest_share(&measure.weights, &weights);
        for (w, c) in weights.iter_mut().zip(&measure.weights) {
            *w += share * (c - *w);
        }
        let frame = measure.frame();
        let places: Vec<[f64; D]> = measure.points.iter().map(|y| frame.to_reference(y)).collect();
        let mut order: Vec<u32> = (0..weights.len() as u32).collect();
        let total = Debts {
            places: &places,
            weights: &mut weights,
        }
        .settle(&mut order);
        if total <= 0.0 {
            return self.weighing();
        }
        let kept = measure.points.iter().zip(weights).filter(|(_, w)| *w > 0.0);
        kept.map(|(y, w)| (*y, w / total)).unzip()
    }

    /// The number in the pool of every point of the measure that was evaluated; they are in the same order.
    fn measured(&self) -> Vec<Option<usize>> {
        let mut positions = self.positions.iter().enumerate();
        let points = self.measure.points.iter().zip(&self.measure.evaluated);
        let mut number = |point: &[f64; D]| positions.find(|(_, y)| *y == point).map(|(number, _)| number);
        points
            .map(|(point, evaluated)| if *evaluated { number(point) } else { None })
            .collect()
    }
}

/// The largest θ with no more debt in θ c + (1 − θ) w than may be.
fn largest_share(controlled: &[f64], plain: &[f64]) -> f64 {
    let is_small = |share: f64| {
        let negative = controlled
            .iter()
            .zip(plain)
            .map(|(c, w)| (w + share * (c - w)).min(0.0));
        negative.sum::<f64>() >= -LARGEST_DEBT
    };
    if is_small(1.0) {
        return 1.0;
    }
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if is_small(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    low
}

/// Weights, some of them negative, and where they are.
struct Debts<'a, const D: usize> {
    places: &'a [[f64; D]],
    weights: &'a mut [f64],
}

impl<const D: usize> Debts<'_, D> {
    /// Leaves no negative weight at the points with these numbers, and the same sum unless that is negative: then all weights are zero. Returns the sum.
    fn settle(&mut self, numbers: &mut [u32]) -> f64 {
        let weight = |number: &u32| self.weights[*number as usize];
        if numbers.iter().all(|number| weight(number) >= 0.0) {
            return numbers.iter().map(weight).sum();
        }
        if let [number] = numbers {
            return std::mem::replace(&mut self.weights[*number as usize], 0.0);
        }
        let axis = self.longest_side(numbers);
        let place = |number: &u32| self.places[*number as usize][axis];
        let middle = numbers.len() / 2;
        numbers.select_nth_unstable_by(middle, |a, b| place(a).total_cmp(&place(b)));
        let (low, high) = numbers.split_at_mut(middle);
        let sums = [self.settle(low), self.settle(high)];
        let total = sums[0] + sums[1];
        for (half, sum) in [low, high].into_iter().zip(sums) {
            if sum > total {
                self.scale(half, total.max(0.0) / sum);
            }
        }
        total
    }

    fn scale(&mut self, numbers: &[u32], factor: f64) {
        for number in numbers {
            self.weights[*number as usize] *= factor;
        }
    }

    fn longest_side(&self, numbers: &[u32]) -> usize {
        let sides: [f64; D] = std::array::from_fn(|axis| {
            let (low, high) = extent(numbers.iter().map(|number| self.places[*number as usize][axis]));
            high - low
        });
        (0..D).max_by(|&a, &b| sides[a].total_cmp(&sides[b])).unwrap_or(0)
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use parvi_targets::{Frame, Gaussian, Target};
    use rand::rngs::ChaCha8Rng;
    use rand::{RngExt, SeedableRng};

    use crate::{Beginning, PoolOptions, explore};

    use super::*;

    /// e^(−t) where t > 0, and elsewhere zero.
    struct HalfLine;

    impl Target<1> for HalfLine {
        fn log_density(&self, &[t]: &[f64; 1]) -> f64 {
            if t > 0.0 { -t } else { f64::NEG_INFINITY }
        }
        fn score(&self, _: &[f64; 1]) -> [f64; 1] {
            [-1.0]
        }
    }

    fn pool<const D: usize>(target: &dyn Target<D>) -> Pool<D> {
        let (frame, options) = (Frame::identity(), PoolOptions::default());
        let explored = explore(
            target,
            Beginning::in_frame(&frame).with_seed(1),
            200,
            &options,
            &mut |_| ControlFlow::Continue(()),
        );
        explored.unwrap()
    }

    #[test]
    fn free_draws_join_the_points_unless_the_target_has_an_edge() {
        let smooth = pool(&Gaussian::<2>::standard());
        let evaluated = smooth.measure.evaluated.iter().filter(|evaluated| **evaluated).count();
        assert_eq!(smooth.measured().iter().flatten().count(), evaluated);
        let (points, weights) = smooth.controlled();
        assert!(points.len() > 2 * smooth.positions.len());
        assert!((weights.iter().sum::<f64>() - 1.0).abs() < 1e-12);
        let edged = pool(&HalfLine);
        let (points, weights) = edged.controlled();
        assert!(points.iter().all(|[t]| *t > 0.0) && weights.iter().all(|w| *w > 0.0));
        assert!(points.len() <= edged.positions.len());
        // The fields are anyone's to change.
        let mut short = smooth;
        short.weights.truncate(100);
        short.log_densities.clear();
        short.measure.weights.truncate(50);
        assert!((1..=100).contains(&short.controlled().0.len()));
    }

    fn settled(places: &[[f64; 1]], weights: &[f64]) -> (Vec<f64>, f64) {
        let (mut weights, mut order) = (weights.to_vec(), (0..places.len() as u32).collect::<Vec<u32>>());
        let total = Debts {
            places,
            weights: &mut weights,
        }
        .settle(&mut order);
        (weights, total)
    }

    #[test]
    fn debts_are_paid_by_the_nearest() {
        let places = [[0.0], [0.1], [5.0], [5.1], [9.0], [9.1], [9.2], [9.3]];
        let (weights, total) = settled(&places, &[-0.1, 0.3, 0.2, 0.2, 0.1, -0.2, 0.3, 0.1]);
        let expected = [0.0, 0.2, 0.2, 0.2, 0.0, 0.0, 0.225, 0.075];
        assert!((total - 0.9).abs() < 1e-15);
        for (weight, expected) in weights.iter().zip(expected) {
            assert!((weight - expected).abs() < 1e-15, "{weights:?}");
        }
        assert_eq!(settled(&places[..2], &[-0.5, 0.2]).0, [0.0; 2]);
    }

    #[test]
    fn no_weight_is_negative_afterwards_and_their_sum_is_the_same() {
        let mut rng = ChaCha8Rng::seed_from_u64(1);
        for count in 1..200 {
            let places: Vec<[f64; 1]> = (0..count).map(|_| [rng.random()]).collect();
            let weights: Vec<f64> = (0..count).map(|_| rng.random_range(-0.4..1.0)).collect();
            let (found, total) = settled(&places, &weights);
            let sum: f64 = weights.iter().sum();
            assert!((total - sum).abs() < 1e-12);
            assert!(found.iter().all(|w| *w >= 0.0));
            assert!((found.iter().sum::<f64>() - sum.max(0.0)).abs() < 1e-12);
        }
    }

    #[test]
    fn as_much_of_the_measure_is_taken_as_leaves_little_debt() {
        let (controlled, plain) = ([0.7, 0.4, -0.1], [0.4, 0.5, 0.1]);
        // 0.1 − 0.2 θ = −0.02.
        assert!((largest_share(&controlled, &plain) - 0.6).abs() < 1e-5);
        assert_eq!(largest_share(&plain, &plain), 1.0);
    }
}
