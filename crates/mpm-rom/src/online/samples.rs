//! Which material points are the sample points 𝒫.

use mpm_scenes::Kinematics;
use mpm_tensor::vector;
use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::SliceRandom;

use super::OnlineError;

/// Sample points on each kinematic region, at least; all of a region that has fewer (ours).
const ON_EACH_REGION: usize = 5;

/// How sample points are chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleChoice {
    /// Every material point.
    All,
    /// So many, drawn evenly: five from each kinematic region, the others from the points that are in none (ours: the paper only says how many).
    Drawn {
        /// |𝒫|.
        count: usize,
        /// Seed of the draw.
        seed: u64,
    },
    /// As many from each region, but each point the farthest at rest from those before it, the first one drawn (ours): few points then see all of the body.
    Spread {
        /// |𝒫|.
        count: usize,
        /// Seed of the first point.
        seed: u64,
    },
}

impl SampleChoice {
    /// The numbers of the sample points among material points with these reference positions, ascending.
    ///
    /// # Errors
    /// [`OnlineError::TooFewSamples`] for fewer than max(⌈r / D⌉, 1), or too few for the regions; [`OnlineError::TooManySamples`].
    pub fn choose<const D: usize>(
        &self,
        reference: &[[f64; D]],
        coordinates: usize,
        kinematics: &Kinematics<D>,
    ) -> Result<Vec<u32>, OnlineError> {
        let points = reference.len();
        let per_region = |members: usize| members.min(ON_EACH_REGION);
        let held: usize = kinematics
            .regions()
            .iter()
            .map(|region| per_region(region.members.len()))
            .sum();
        let needed = coordinates.div_ceil(D).max(held).max(1);
        let (found, seed) = match *self {
            Self::All => (points, None),
            Self::Drawn { count, seed } | Self::Spread { count, seed } => (count, Some(seed)),
        };
        if found < needed {
            return Err(OnlineError::TooFewSamples {
                found,
                needed,
                coordinates,
                dimension: D,
            });
        }
        if found > points {
            return Err(OnlineError::TooManySamples { found, points });
        }
        let Some(seed) = seed else {
            return Ok((0..points as u32).collect());
        };
        let mut generator = ChaCha8Rng::seed_from_u64(seed);
        let mut chosen = Vec::with_capacity(found);
        let mut free = vec![true; points];
        let mut take = |mut from: Vec<u32>, count: usize| {
            from.shuffle(&mut generator);
            if matches!(self, Self::Spread { .. }) {
                spread(reference, &mut from, count);
            }
            from.truncate(count);
            chosen.extend(from);
        };
        for region in kinematics.regions() {
            for &p in &region.members {
                if let Some(free) = free.get_mut(p) {
                    *free = false;
                }
            }
            let members: Vec<u32> = region.members.iter().map(|&p| p as u32).collect();
            let share = per_region(members.len());
            take(members, share);
        }
        let others: Vec<u32> = (0..points as u32)
            .filter(|&p| free.get(p as usize) == Some(&true))
            .collect();
        let drawn = others.len().min(found - held);
        take(others, drawn);
        // More than there are free points: the rest of the regions' points too.
        let mut taken = vec![false; points];
        chosen.iter().for_each(|&p| taken[p as usize] = true);
        let rest = (0..points as u32).filter(|&p| !taken[p as usize]);
        let missing = found - held - drawn;
        chosen.extend(rest.take(missing));
        chosen.sort_unstable();
        Ok(chosen)
    }
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
            SampleChoice::Spread { count: 40, seed: 3 },
        ] {
            let chosen = choice.choose(&line, 6, &Kinematics::default()).expect("enough");
            assert!(
                chosen.len() == 40 && chosen.windows(2).all(|pair| pair[0] < pair[1]),
                "{chosen:?}"
            );
        }
    }
}
