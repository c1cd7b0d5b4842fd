//! How large a load is over time.

/// A share of a load as a function of time: linear between given moments, constant before the first and after the last, 1 where there are none.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Amplitude {
    /// Times, ascending, and shares.
    points: Vec<[f64; 2]>,
}

impl Amplitude {
    /// min(t / `time`, 1); at once where `time` is not positive.
    pub fn ramp(time: f64) -> Self {
        let points = if time > 0.0 {
            vec![[0.0, 0.0], [time, 1.0]]
        } else {
            Vec::new()
        };
        Self { points }
    }

    /// Through pairs of a time and a share; `None` unless they are finite and times ascend.
    pub fn through(points: Vec<[f64; 2]>) -> Option<Self> {
        let finite = points.iter().flatten().all(|number| number.is_finite());
        let ascending = points.windows(2).all(|pair| pair[0][0] < pair[1][0]);
        (finite && ascending).then_some(Self { points })
    }

    /// The share at a time.
    pub fn at(&self, time: f64) -> f64 {
        let next = self.points.partition_point(|point| point[0] <= time);
        match (next.checked_sub(1).map(|last| self.points[last]), self.points.get(next)) {
            (Some([before, from]), Some(&[after, to])) => from + (to - from) * ((time - before) / (after - before)),
            (Some([_, share]), None) | (None, Some(&[_, share])) => share,
            (None, None) => 1.0,
        }
    }

    /// Whether it is 1 at all times.
    pub fn is_one(&self) -> bool {
        self.points.iter().all(|point| point[1] == 1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn is_linear_between_its_points_and_constant_beyond() {
        let pulse = Amplitude::through(vec![[1.0, 2.0], [2.0, 4.0], [4.0, 0.0]]).expect("times ascend");
        for (time, share) in [
            (0.0, 2.0),
            (1.0, 2.0),
            (1.5, 3.0),
            (2.0, 4.0),
            (3.0, 2.0),
            (4.0, 0.0),
            (9.0, 0.0),
        ] {
            assert_eq!(pulse.at(time), share, "{time}");
        }
        let ramp = Amplitude::ramp(3.0);
        assert_eq!(
            [ramp.at(0.0), ramp.at(0.7), ramp.at(3.0), ramp.at(5.0)],
            [0.0, 0.7 / 3.0, 1.0, 1.0]
        );
        assert!(Amplitude::ramp(0.0).is_one() && Amplitude::default().at(7.0) == 1.0 && !ramp.is_one());
    }

    #[test]
    fn times_ascend() {
        for wrong in [
            [[1.0, 0.0], [1.0, 1.0]],
            [[1.0, 0.0], [0.5, 1.0]],
            [[0.0, f64::NAN], [1.0, 1.0]],
        ] {
            assert_eq!(Amplitude::through(wrong.to_vec()), None);
        }
    }
}
