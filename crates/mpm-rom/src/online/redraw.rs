//! Sample points that are drawn anew in every step.

use rand::SeedableRng;
use rand::rngs::ChaCha8Rng;
use rand::seq::index;

/// The lists that 𝒫 is drawn from. They are made once; the draw of a step takes a time of the order of |𝒫|, whatever the number of points.
pub(super) struct Redraw {
    /// Lists of points, with how many are drawn from each.
    groups: Vec<(Vec<u32>, usize)>,
    seed: u64,
    /// Whether a point is in the draw under way; all false between draws.
    taken: Vec<bool>,
}

impl Redraw {
    /// From lists of a body's points, with how many are drawn from each.
    pub fn new(groups: Vec<(Vec<u32>, usize)>, points: usize, seed: u64) -> Self {
        let taken = vec![false; points];
        Self { groups, seed, taken }
    }

    /// 𝒫 of step n = 1, 2, …, ascending: every step has a stream of random numbers of its own, so that its draw does not depend on those of other steps.
    pub fn of_step(&mut self, step: u64) -> Vec<u32> {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(step);
        let mut chosen: Vec<u32> = Vec::new();
        for (members, share) in &self.groups {
            // So many more than are needed as may be taken already: regions may overlap, and the last list is that of all points.
            let most = members.len().min(share + chosen.len());
            let before = chosen.len();
            for place in index::sample(&mut generator, members.len(), most) {
                let point = members[place];
                if chosen.len() < before + share && !std::mem::replace(&mut self.taken[point as usize], true) {
                    chosen.push(point);
                }
            }
        }
        for &point in &chosen {
            self.taken[point as usize] = false;
        }
        chosen.sort_unstable();
        chosen
    }
}

#[cfg(test)]
mod tests {
    use mpm_scenes::Kinematics;

    use super::super::SampleChoice;
    use super::*;

    const POINTS: usize = 40;

    fn redraw(count: usize, seed: u64) -> Redraw {
        let choice = SampleChoice::Redrawn { count, seed };
        let made = choice.redraw(POINTS, 4, &Kinematics::<2>::default()).expect("enough");
        made.expect("drawn in every step")
    }

    #[test]
    fn draws_hang_on_seed_and_step_alone() {
        let (mut forward, mut backward) = (redraw(7, 5), redraw(7, 5));
        let draws: Vec<_> = (1..=20).map(|step| forward.of_step(step)).collect();
        for step in (1..=20).rev() {
            assert_eq!(backward.of_step(step), draws[step as usize - 1]);
        }
        assert!((1..20).all(|n| draws[n] != draws[n - 1]));
        assert_ne!(redraw(7, 6).of_step(1), draws[0]);
    }

    /// 4,000 draws of 10 of 40 points: each point is in 1,000 of them, give or take √750.
    #[test]
    fn all_points_are_drawn_equally_often() {
        let (mut redraw, mut often) = (redraw(10, 1), [0_u32; POINTS]);
        for step in 1..=4000 {
            let chosen = redraw.of_step(step);
            assert!(chosen.len() == 10 && chosen.windows(2).all(|pair| pair[0] < pair[1]));
            chosen.iter().for_each(|&p| often[p as usize] += 1);
        }
        assert!(
            often
                .iter()
                .all(|&n| f64::from(n.abs_diff(1000)) < 5.0 * 750_f64.sqrt()),
            "{often:?}"
        );
    }

    #[test]
    fn lists_that_overlap_give_each_point_once() {
        // Two regions that share points 3 and 4, the points in none, and three more of all.
        let lists = [(0..5).collect(), (3..9).collect(), (9..20).collect(), (0..20).collect()];
        let mut redraw = Redraw {
            groups: lists.into_iter().zip([5, 4, 6, 3]).collect(),
            seed: 2,
            taken: vec![false; 20],
        };
        for step in 1..=200 {
            let chosen = redraw.of_step(step);
            assert!(chosen.len() == 18 && chosen.windows(2).all(|pair| pair[0] < pair[1]));
            assert!(chosen.starts_with(&[0, 1, 2, 3, 4]) && chosen.iter().filter(|&&p| p < 9).count() >= 9);
            assert!(redraw.taken.iter().all(|taken| !taken));
        }
    }
}
