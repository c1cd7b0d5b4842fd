//! Which material points are the sample points 𝒫.

use mpm_scenes::Kinematics;
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
}

impl SampleChoice {
    /// The numbers of the sample points among N material points, ascending.
    ///
    /// # Errors
    /// [`OnlineError::TooFewSamples`] for fewer than max(⌈r / D⌉, 1), or too few for the regions; [`OnlineError::TooManySamples`].
    pub fn choose<const D: usize>(
        &self,
        points: usize,
        coordinates: usize,
        kinematics: &Kinematics<D>,
    ) -> Result<Vec<u32>, OnlineError> {
        let per_region = |members: usize| members.min(ON_EACH_REGION);
        let held: usize = kinematics
            .regions()
            .iter()
            .map(|region| per_region(region.members.len()))
            .sum();
        let needed = coordinates.div_ceil(D).max(held).max(1);
        let (found, seed) = match *self {
            Self::All => (points, None),
            Self::Drawn { count, seed } => (count, Some(seed)),
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
        let (mut chosen, mut rest) = (Vec::with_capacity(found), Vec::new());
        let mut free = vec![true; points];
        for region in kinematics.regions() {
            let mut members = region.members.clone();
            members
                .iter()
                .for_each(|&p| free.iter_mut().skip(p).take(1).for_each(|free| *free = false));
            members.shuffle(&mut generator);
            let share = per_region(members.len());
            chosen.extend(members.iter().take(share).map(|&p| p as u32));
            rest.extend(members.iter().skip(share).map(|&p| p as u32));
        }
        let mut others: Vec<u32> = (0..points as u32)
            .filter(|&p| free.get(p as usize) == Some(&true))
            .collect();
        others.shuffle(&mut generator);
        rest.shuffle(&mut generator);
        let missing = found - chosen.len();
        chosen.extend(others.into_iter().chain(rest).take(missing));
        chosen.sort_unstable();
        Ok(chosen)
    }
}
