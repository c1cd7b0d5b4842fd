//! Which material points are the sample points 𝒫.

use mpm_scenes::Kinematics;
use mpm_tensor::vector;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::SliceRandom;

use super::OnlineError;
use super::redraw::Redraw;

/// Sample points on each kinematic region, at least; all of a region that has fewer (ours).
pub(super) const ON_EACH_REGION: usize = 5;

/// How sample points are chosen.
#[derive(Clone, Debug, PartialEq)]
pub enum SampleChoice {
    /// Every material point.
    All,
    /// So many, drawn evenly: five from each kinematic region, the others from the points that are in none. Once for a run (ours).
    Drawn {
        /// |𝒫|.
        count: usize,
        /// Seed of the draw.
        seed: u64,
    },
    /// As many from each region, but drawn anew in every step (the paper's, §3.2.1): over many steps all of the body is seen. The draw of a step hangs on the seed and the number of the step alone.
    Redrawn {
        /// |𝒫|.
        count: usize,
        /// Seed of the draws.
        seed: u64,
    },
    /// As many from each region, but each point the farthest at rest from those before it, the first one drawn (ours): few points then see all of the body.
    Spread {
        /// |𝒫|.
        count: usize,
        /// Seed of the first point.
        seed: u64,
    },
    /// The points with these numbers, ascending: those of [`choose_greedily`](super::choose_greedily), for example.
    Given(Vec<u32>),
    /// Given points with weights ω_p ≥ 0 of their own: those of [`choose_cubature`](super::choose_cubature), for example.
    Weighted(Vec<(u32, f64)>),
}

impl SampleChoice {
    /// The draws of a choice that has one for every step; `None` for other choices.
    ///
    /// # Errors
    /// As [`groups`].
    pub(super) fn redraw<const D: usize>(
        &self,
        points: usize,
        coordinates: usize,
        kinematics: &Kinematics<D>,
    ) -> Result<Option<Redraw>, OnlineError> {
        let &Self::Redrawn { count, seed } = self else {
            return Ok(None);
        };
        let groups = groups(kinematics, points, coordinates, count)?;
        Ok(Some(Redraw::new(groups, points, seed)))
    }

    /// The numbers of the sample points among material points with these reference positions, ascending; those of the first step where every step has its own.
    ///
    /// # Errors
    /// [`OnlineError::TooFewSamples`] for fewer than ⌈r / D⌉ beside those of the regions, whose motion is given, or none; [`OnlineError::TooManySamples`]; for given numbers [`OnlineError::Samples`] and
    /// [`OnlineError::TooFewOnRegion`].
    pub fn choose<const D: usize>(
        &self,
        reference: &[[f64; D]],
        coordinates: usize,
        kinematics: &Kinematics<D>,
    ) -> Result<Vec<u32>, OnlineError> {
        let points = reference.len();
        let groups = |count| groups(kinematics, points, coordinates, count);
        let given = |numbers: Vec<u32>| {
            groups(numbers.len())?;
            check_given(&numbers, points, kinematics)?;
            Ok(numbers)
        };
        let (count, seed) = match self {
            Self::All => return given((0..points as u32).collect()),
            Self::Given(numbers) => return given(numbers.clone()),
            Self::Weighted(weighted) => return given(weighted.iter().map(|(number, _)| *number).collect()),
            Self::Redrawn { count, seed } => return Ok(Redraw::new(groups(*count)?, points, *seed).of_step(1)),
            Self::Drawn { count, seed } | Self::Spread { count, seed } => (*count, *seed),
        };
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        let (mut chosen, mut free) = (Vec::with_capacity(count), vec![true; points]);
        for (mut members, share) in groups(count)? {
            members.retain(|&point| free[point as usize]);
            members.shuffle(&mut generator);
            if matches!(self, Self::Spread { .. }) {
                spread(reference, &mut members, share);
            }
            members.truncate(share);
            members.iter().for_each(|&point| free[point as usize] = false);
            chosen.append(&mut members);
        }
        chosen.sort_unstable();
        Ok(chosen)
    }

    /// ω_p of the points where the choice says them.
    ///
    /// # Errors
    /// [`OnlineError::Option`] for a weight below 0 or one that is not finite.
    pub(super) fn weights(&self) -> Result<Option<Vec<f64>>, OnlineError> {
        let Self::Weighted(weighted) = self else {
            return Ok(None);
        };
        let weights: Vec<f64> = weighted.iter().map(|(_, weight)| *weight).collect();
        match weights.iter().find(|weight| !(**weight >= 0.0 && weight.is_finite())) {
            None => Ok(Some(weights)),
            Some(&value) => Err(OnlineError::Option {
                field: "weight",
                value,
                expected: "at least 0 and finite",
            }),
        }
    }
}

/// Lists of points, with how many of each are to be chosen in their order: those of each kinematic region, those that are in none, and all, of which the points of
/// earlier lists have to be left out. The last two are empty where no more are needed.
///
/// # Errors
/// [`OnlineError::TooFewSamples`], [`OnlineError::TooManySamples`].
pub(super) fn groups<const D: usize>(
    kinematics: &Kinematics<D>,
    points: usize,
    coordinates: usize,
    count: usize,
) -> Result<Vec<(Vec<u32>, usize)>, OnlineError> {
    let mut free = vec![true; points];
    let mut groups = Vec::new();
    for region in kinematics.regions() {
        let members: Vec<u32> = region.members.iter().map(|&p| p as u32).collect();
        let share = members.len().min(ON_EACH_REGION);
        groups.push((members, share));
        for &p in &region.members {
            if let Some(free) = free.get_mut(p) {
                *free = false;
            }
        }
    }
    let held: usize = groups.iter().map(|(_, share)| share).sum();
    let needed = (held + coordinates.div_ceil(D)).max(1);
    if count < needed {
        return Err(OnlineError::TooFewSamples {
            found: count,
            needed,
            coordinates,
            dimension: D,
        });
    }
    if count > points {
        return Err(OnlineError::TooManySamples { found: count, points });
    }
    let others: Vec<u32> = (0..points as u32).filter(|&p| free[p as usize]).collect();
    let drawn = others.len().min(count - held);
    groups.push((others, drawn));
    groups.push(((0..points as u32).collect(), count - held - drawn));
    groups.retain(|(_, share)| *share > 0);
    Ok(groups)
}

/// Whether so many sample points can be chosen of a body with so many points.
///
/// # Errors
/// As [`groups`].
pub(crate) fn check_count<const D: usize>(
    kinematics: &Kinematics<D>,
    points: usize,
    coordinates: usize,
    count: usize,
) -> Result<(), OnlineError> {
    groups(kinematics, points, coordinates, count).map(drop)
}

fn check_given<const D: usize>(numbers: &[u32], points: usize, kinematics: &Kinematics<D>) -> Result<(), OnlineError> {
    let mut next = 0;
    for &number in numbers {
        if number < next || number as usize >= points {
            return Err(OnlineError::Samples { number, points });
        }
        next = number + 1;
    }
    for (region, members) in kinematics.regions().iter().map(|region| &region.members).enumerate() {
        let chosen = members.iter().filter(|&&p| numbers.binary_search(&(p as u32)).is_ok());
        let (found, needed) = (chosen.count(), members.len().min(ON_EACH_REGION));
        if found < needed {
            return Err(OnlineError::TooFewOnRegion { region, found, needed });
        }
    }
    Ok(())
}

/// Puts `count` points first, each the farthest from those before it; the first one stays.
fn spread<const D: usize>(reference: &[[f64; D]], points: &mut [u32], count: usize) {
    let mut nearest = vec![f64::INFINITY; points.len()];
    for next in 1..count.min(points.len()) {
        let last = reference[points[next - 1] as usize];
        let (mut farthest, mut largest) = (next, -1.0);
        for (k, &p) in points.iter().enumerate().skip(next) {
            nearest[k] = nearest[k].min(vector::distance_squared(&last, &reference[p as usize]));
            if nearest[k] > largest {
                (farthest, largest) = (k, nearest[k]);
            }
        }
        points.swap(next, farthest);
        nearest.swap(next, farthest);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spread_points_are_the_ends_then_the_middle_and_all_choices_are_distinct() {
        let line: Vec<[f64; 1]> = (0..101).map(|k| [f64::from(k)]).collect();
        let mut points: Vec<u32> = (0..101).collect();
        spread(&line, &mut points, 4);
        assert_eq!(points[..3], [0, 100, 50]);
        assert!(points[3] == 25 || points[3] == 75);
        for choice in [
            SampleChoice::Drawn { count: 40, seed: 3 },
            SampleChoice::Redrawn { count: 40, seed: 3 },
            SampleChoice::Spread { count: 40, seed: 3 },
        ] {
            let chosen = choice.choose(&line, 6, &Kinematics::default()).expect("enough");
            assert!(
                chosen.len() == 40 && chosen.windows(2).all(|pair| pair[0] < pair[1]),
                "{chosen:?}"
            );
        }
    }

    #[test]
    fn given_points_are_checked() {
        let line: Vec<[f64; 1]> = (0..5).map(|k| [f64::from(k)]).collect();
        let choose = |numbers: &[u32]| SampleChoice::Given(numbers.to_vec()).choose(&line, 2, &Kinematics::default());
        assert_eq!(choose(&[1, 4]).expect("points"), [1, 4]);
        for (numbers, wrong) in [([1, 5], 5), ([2, 2], 2), ([3, 1], 1)] {
            let error = choose(&numbers).expect_err("refused");
            assert!(
                matches!(error, OnlineError::Samples { number, points: 5 } if number == wrong),
                "{error}"
            );
        }
        assert!(matches!(choose(&[1]), Err(OnlineError::TooFewSamples { .. })));
    }
}
