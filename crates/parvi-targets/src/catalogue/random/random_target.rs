//! A target that a seed makes.

use rand::Rng;

use super::dice::Dice;
use super::recipes::{law_of, placed};
use crate::catalogue::making::dimension_within;
use crate::target::its_own_source;
use crate::{
    BoxedLaw, CatalogueTarget, ExactDraws, Frame, MAXIMUM_DIMENSION, RandomFamily, Target, TargetError,
    UnitCubeTransport,
};

/// Draws that place and scale of the frame and the domain are read off.
const DRAWS: usize = 2048;

/// A density of a random family, place, direction and units, with exact draws and exact evidence: whoever tunes a method to named
/// targets finds out here.
///
/// x = c + Q diag(s) y, with y from the law of the [family](RandomFamily), a uniformly distributed orthogonal Q, scales s between
/// 10⁻² and 10² (a common scale between 0.1 and 10, each axis within a factor of 1, 3 or 10 of it) and a centre of standard
/// deviation 3 common scales per axis. Laws are push-forwards of simple ones by invertible maps, mixtures and products of those; the
/// score is analytic. The log density has a constant added, uniform on (−20, 20), which is log ∫ p exactly.
///
/// The [frame](CatalogueTarget::frame) says as much as a user may know: it is diagonal, scales are off by factors between 0.4 and 4,
/// and the centre is 0.3 to 1 of its scales off on every axis. Nothing of the direction, shape or thickness is in it.
///
/// In D = 1, …, 8; the same seed, family and dimension give the same target.
#[derive(Debug)]
pub struct RandomTarget<const D: usize> {
    seed: u64,
    family: RandomFamily,
    law: BoxedLaw<D>,
    log_evidence: f64,
    frame: Frame<D>,
    domain: [[f64; 2]; D],
}

impl<const D: usize> RandomTarget<D> {
    /// The target of a seed, which chooses the family too.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] unless 1 ≤ D ≤ 8.
    pub fn new(seed: u64) -> Result<Self, TargetError> {
        dimension_within("random", D, 1..=MAXIMUM_DIMENSION)?;
        let mut families = RandomFamily::ALL.to_vec();
        families.retain(|family| family.minimum_dimension() <= D);
        Self::of_family(Dice::new(seed, 0).pick(&families), seed)
    }

    /// The target of a family and a seed.
    ///
    /// # Errors
    /// [`TargetError::DimensionNotAllowed`] unless D is at least the [family's](RandomFamily::minimum_dimension) and at most 8.
    pub fn of_family(family: RandomFamily, seed: u64) -> Result<Self, TargetError> {
        dimension_within("random", D, 1..=MAXIMUM_DIMENSION)?;
        let mut dice = Dice::new(seed, 1);
        let shape = law_of::<D>(family, &mut dice)?;
        let unit = dice.scale(0.1, 10.0);
        let spread = dice.pick(&[1.0, 3.0, 10.0]);
        let centre = dice.normal::<D>().map(|z| 3.0 * unit * z);
        let law = placed(shape, &mut dice, centre, unit, spread)?;
        let log_evidence = dice.between(-20.0, 20.0);
        let (frame, domain) = outline(&law, &mut dice)?;
        Ok(Self {
            seed,
            family,
            law,
            log_evidence,
            frame,
            domain,
        })
    }

    /// The seed.
    pub fn seed(&self) -> u64 {
        self.seed
    }

    /// The family.
    pub fn family(&self) -> RandomFamily {
        self.family
    }
}

/// The frame and the domain of a law, from draws: per axis the scale is a third of the range that holds the middle 90 %, which
/// heavy tails have too.
fn outline<const D: usize>(law: &BoxedLaw<D>, dice: &mut Dice) -> Result<(Frame<D>, [[f64; 2]; D]), TargetError> {
    let draws: Vec<[f64; D]> = (0..DRAWS).map(|_| law.drawn(dice.generator())).collect();
    let (mut centre, mut scales, mut domain) = ([0.0; D], [1.0; D], [[0.0; 2]; D]);
    for axis in 0..D {
        let mut values: Vec<f64> = draws.iter().map(|x| x[axis]).collect();
        values.sort_by(f64::total_cmp);
        let at = |share: f64| values[(share * (DRAWS - 1) as f64) as usize];
        scales[axis] = (at(0.95) - at(0.05)) / 3.3 * dice.scale(0.4, 4.0);
        centre[axis] = at(0.5) + scales[axis] * dice.signed(0.3, 1.0);
        let margin = 0.1 * (at(0.99) - at(0.01));
        domain[axis] = [at(0.0) - margin, at(1.0) + margin];
    }
    Ok((Frame::from_scales(centre, scales)?, domain))
}

impl<const D: usize> Target<D> for RandomTarget<D> {
    /// log p; −∞ where squares leave the range of numbers (beyond 10¹⁵⁰ or so).
    fn log_density(&self, x: &[f64; D]) -> f64 {
        let value = self.law.log_density(x) + self.log_evidence;
        if value.is_nan() { f64::NEG_INFINITY } else { value }
    }

    /// ∇ log p; 0 where it leaves the range of numbers.
    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let score = self.law.score(x);
        if score.iter().all(|component| component.is_finite()) {
            score
        } else {
            [0.0; D]
        }
    }
}

impl<const D: usize> ExactDraws<D> for RandomTarget<D> {
    fn draw(&self, rng: &mut dyn Rng) -> [f64; D] {
        self.law.drawn(rng)
    }
}

impl<const D: usize> UnitCubeTransport<D> for RandomTarget<D> {
    fn cube_dimension(&self) -> usize {
        self.law.cube_dimension()
    }

    fn transport(&self, u: &[f64]) -> [f64; D] {
        self.law.transport(u)
    }
}

impl<const D: usize> CatalogueTarget<D> for RandomTarget<D> {
    fn name(&self) -> &str {
        "random"
    }

    /// A rough guess, see the type.
    fn frame(&self) -> Frame<D> {
        self.frame
    }

    fn domain(&self) -> [[f64; 2]; D] {
        self.domain
    }

    its_own_source!(D);

    fn log_evidence(&self) -> Option<f64> {
        Some(self.log_evidence)
    }
}
