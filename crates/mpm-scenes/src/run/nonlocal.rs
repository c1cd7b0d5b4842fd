//! Softening with a length of its own: what flows plastically is averaged over what is near.

use std::ops::Range;

use mpm_kernels::{LANES, Lanes};

use super::motion::Motion;
use crate::Scene;
use crate::population::Population;
use crate::scene::MaterialTable;

/// The internal variable that is averaged.
const VARIABLE: &str = "plastic_strain";

/// Receivers that are one piece of work.
const TOGETHER: usize = 64;

/// Increments of plastic strain in the bodies whose material has a radius R, averaged in every step (nonlocal as in
/// Z. P. Bažant & F.-B. Lin, *Non-local yield limit degradation*, Int. J. Numer. Methods Eng. 26, 1988, for increments):
///
/// Δε̄_q(x_p) = Σ_o w(|x_p − x_o|) V⁰_o Δε_q,o / Σ_o w(|x_p − x_o|) V⁰_o over the particles o of the same body, with the bell
/// w(r) = (1 − r²/R²)² for r < R (Bažant & Jirásek, J. Eng. Mech. 128, 2002). So bands are as wide as R says and not as cells are.
///
/// An increment is local within its step, as the return mapping knows it, and averaged from then on; as only increments are averaged, nothing has to be kept
/// from step to step, and what has flowed stays where it is in the material.
#[derive(Debug, Default)]
pub(super) struct Nonlocal {
    /// R by body, 0 without.
    radii: Vec<f64>,
    /// ε_q before the step, by particle in the order of creation.
    before: Vec<f64>,
}

impl Nonlocal {
    /// Of the materials of a scene.
    pub fn of(scene: &Scene) -> Self {
        let radius = |material: &String| match scene.materials.get(material) {
            Some(MaterialTable::SofteningHencky(metal)) => metal.nonlocal_radius.unwrap_or(0.0),
            _ => 0.0,
        };
        let radii: Vec<f64> = scene.bodies.iter().map(|body| radius(&body.material)).collect();
        Self {
            radii: if radii.iter().any(|&radius| radius > 0.0) {
                radii
            } else {
                Vec::new()
            },
            before: Vec::new(),
        }
    }

    /// Remembers what has flowed before a step.
    pub fn begin<const D: usize>(&mut self, motion: &dyn Motion<D>) {
        if self.radii.is_empty() {
            return;
        }
        let particles = motion.particles();
        self.before.resize(particles.len(), 0.0);
        for (index, state) in particles.states.iter().enumerate() {
            let flowed = motion.laws().internal_variable(state, VARIABLE);
            self.before[particles.identity(index)] = flowed.unwrap_or(0.0);
        }
    }

    /// Averages what has flowed since.
    pub fn end<const D: usize>(&self, motion: &mut dyn Motion<D>, start: &Population<D>) {
        for body in 0..self.radii.len() {
            if self.radii[body] > 0.0 {
                self.average(body as u32, motion, start);
            }
        }
    }

    fn average<const D: usize>(&self, body: u32, motion: &mut dyn Motion<D>, start: &Population<D>) {
        let (particles, radius) = (motion.particles(), self.radii[body as usize]);
        let increment = |index: usize| {
            let flowed = motion.laws().internal_variable(&particles.states[index], VARIABLE);
            flowed.unwrap_or(0.0) - self.before[particles.identity(index)]
        };
        let members = (0..particles.len()).filter(|&index| start.bodies[particles.identity(index)] == body);
        let members = members.map(|index| Site {
            position: particles.positions[index],
            volume: particles.reference_volumes[index],
            increment: increment(index),
            particle: particles.identity(index) as u32,
            index: index as u32,
        });
        let members: Vec<Site<D>> = members.collect();
        if members.iter().all(|site| site.increment == 0.0) {
            return;
        }
        for (index, averaged) in averaged(members, radius) {
            let identity = motion.particles().identity(index);
            motion.set_internal_variable(index, VARIABLE, self.before[identity] + averaged);
        }
    }
}

/// A particle to be averaged over.
#[derive(Clone, Copy, Debug)]
struct Site<const D: usize> {
    position: [f64; D],
    volume: f64,
    increment: f64,
    /// Number in the order of creation, in which sums are taken, and present place.
    particle: u32,
    index: u32,
}

/// Present place and average of all particles within the radius of one that has flowed.
fn averaged<const D: usize>(sites: Vec<Site<D>>, radius: f64) -> Vec<(usize, f64)> {
    let boxes = Boxes::new(sites, radius);
    let receivers: Vec<usize> = (0..boxes.sites.len()).filter(|&k| boxes.is_reached(k)).collect();
    mpm_parallel::collect(receivers.len(), TOGETHER, &|number| {
        let k = receivers[number];
        (boxes.sites[k].index as usize, boxes.average(k, radius))
    })
}

/// Particles in boxes of edge R, which follow each other along the last axis.
struct Boxes<const D: usize> {
    sites: Vec<Site<D>>,
    keys: Vec<[i64; D]>,
    /// Positions by component, V⁰, and V⁰ Δε_q of the sites.
    positions: [Vec<f64>; D],
    volumes: Vec<f64>,
    flows: Vec<f64>,
    /// Boxes in which something has flowed, sorted.
    flowing: Vec<[i64; D]>,
}

impl<const D: usize> Boxes<D> {
    fn new(sites: Vec<Site<D>>, radius: f64) -> Self {
        let key = |site: &Site<D>| site.position.map(|c| (c / radius).floor() as i64);
        let mut keyed: Vec<([i64; D], Site<D>)> = sites.into_iter().map(|site| (key(&site), site)).collect();
        keyed.sort_unstable_by_key(|(key, site)| (*key, site.particle));
        let flowing = keyed.iter().filter(|(_, site)| site.increment != 0.0);
        let mut flowing: Vec<[i64; D]> = flowing.map(|(key, _)| *key).collect();
        flowing.dedup();
        let (keys, sites): (Vec<[i64; D]>, Vec<Site<D>>) = keyed.into_iter().unzip();
        Self {
            positions: std::array::from_fn(|a| sites.iter().map(|site| site.position[a]).collect()),
            volumes: sites.iter().map(|site| site.volume).collect(),
            flows: sites.iter().map(|site| site.volume * site.increment).collect(),
            keys,
            sites,
            flowing,
        }
    }

    /// Whether something has flowed in the box of a site or in one beside it.
    fn is_reached(&self, site: usize) -> bool {
        self.rows(site).any(|(first, last)| {
            let place = self.flowing.partition_point(|key| *key < first);
            self.flowing.get(place).is_some_and(|key| *key <= last)
        })
    }

    /// First and last box of the rows of three around a site.
    fn rows(&self, site: usize) -> impl Iterator<Item = ([i64; D], [i64; D])> {
        let own = self.keys[site];
        (0..3usize.pow(D as u32 - 1)).map(move |row| {
            let (mut first, mut rest) = (own, row);
            for key in &mut first[..D - 1] {
                *key = key.saturating_add((rest % 3) as i64 - 1);
                rest /= 3;
            }
            let mut last = first;
            (first[D - 1], last[D - 1]) = (own[D - 1].saturating_sub(1), own[D - 1].saturating_add(1));
            (first, last)
        })
    }

    /// Σ w V⁰ Δε_q / Σ w V⁰ at a site.
    fn average(&self, site: usize, radius: f64) -> f64 {
        let (mut flow, mut volume) = (Lanes::ZERO, Lanes::ZERO);
        for (first, last) in self.rows(site) {
            let begin = self.keys.partition_point(|key| *key < first);
            let end = begin + self.keys[begin..].partition_point(|key| *key <= last);
            let (more, of) = self.sums(site, begin..end, radius.recip().min(f64::MAX));
            flow += more;
            volume += of;
        }
        flow.reduce_add() / volume.reduce_add()
    }

    /// Sums over neighbours, four side by side.
    fn sums(&self, site: usize, neighbours: Range<usize>, inverse_radius: f64) -> (Lanes, Lanes) {
        let x = self.sites[site].position;
        let (mut flow, mut volume) = (Lanes::ZERO, Lanes::ZERO);
        let mut add = |positions: [Lanes; D], flows: Lanes, volumes: Lanes| {
            let mut square = Lanes::ZERO;
            for a in 0..D {
                let r = (positions[a] - Lanes::splat(x[a])) * inverse_radius;
                square = r.mul_add(r, square);
            }
            let share = (Lanes::splat(1.0) - square).fast_max(Lanes::ZERO);
            let weight = share * share;
            flow = weight.mul_add(flows, flow);
            volume = weight.mul_add(volumes, volume);
        };
        let positions = self
            .positions
            .each_ref()
            .map(|values| fours(&values[neighbours.clone()]));
        let (flows, volumes) = (fours(&self.flows[neighbours.clone()]), fours(&self.volumes[neighbours]));
        for k in 0..volumes.0.len() {
            add(
                positions.map(|(whole, _)| Lanes::new(whole[k])),
                Lanes::new(flows.0[k]),
                Lanes::new(volumes.0[k]),
            );
        }
        // Nothing has no volume.
        add(positions.map(|(_, rest)| rest), flows.1, volumes.1);
        (flow, volume)
    }
}

/// Four numbers at a time, and the rest before zeros.
fn fours(values: &[f64]) -> (&[[f64; LANES]], Lanes) {
    let (whole, rest) = values.as_chunks();
    let mut last = [0.0; LANES];
    last[..rest.len()].copy_from_slice(rest);
    (whole, Lanes::new(last))
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    /// One after the other, without boxes.
    fn naive<const D: usize>(sites: &[Site<D>], of: &Site<D>, radius: f64) -> f64 {
        let (mut flow, mut volume) = (0.0, 0.0);
        for site in sites {
            let square: f64 = (0..D).map(|a| (site.position[a] - of.position[a]).powi(2)).sum();
            let weight = (1.0 - square / radius / radius).max(0.0).powi(2) * site.volume;
            (flow, volume) = (flow + weight * site.increment, volume + weight);
        }
        flow / volume
    }

    fn agrees<const D: usize>(numbers: &[(f64, f64, f64, f64, bool)], radius: f64) {
        let site = |(k, &(x, y, z, volume, flows)): (usize, &(f64, f64, f64, f64, bool))| Site {
            position: std::array::from_fn(|a| [x, y, z][a]),
            volume,
            increment: if flows { 0.1 * volume } else { 0.0 },
            particle: (numbers.len() - k) as u32,
            index: k as u32,
        };
        let sites: Vec<Site<D>> = numbers.iter().enumerate().map(site).collect();
        let found = averaged(sites.clone(), radius);
        let mut all = vec![0.0; sites.len()];
        found.iter().for_each(|&(index, average)| all[index] = average);
        for site in &sites {
            let expected = naive(&sites, site, radius);
            // Near R weights are what is left of one.
            assert!((all[site.index as usize] - expected).abs() <= 1e-14, "{site:?}");
        }
        let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build().expect("threads");
        assert_eq!(pool.install(|| averaged(sites.clone(), radius)), found);
    }

    proptest! {
        #[test]
        fn averages_are_those_of_all_pairs(
            numbers in prop::collection::vec((-2.0..2.0f64, -2.0..2.0f64, -2.0..2.0f64, 0.5..2.0f64, prop::bool::weighted(0.1)), 1..200),
            radius in prop_oneof![0.1..3.0f64, Just(1e-300)],
        ) {
            agrees::<1>(&numbers, radius);
            agrees::<2>(&numbers, radius);
            agrees::<3>(&numbers, radius);
        }
    }
}
