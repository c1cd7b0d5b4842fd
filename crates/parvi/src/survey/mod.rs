//! Before the body moves: where the target is, how wide, and of how many separate pieces.

mod ascent;
mod axis_orders;
mod clusters;
mod conditional_fit;
mod density;
mod explore;
mod gaussian_fit;
mod linear_score;
mod map_choice;
mod map_fit;
mod masses;

use mpm_tensor::{SymmetricEigen, vector};
use parvi_targets::{Frame, Target};
use rand::RngExt;

use self::density::Density;
use self::explore::{Found, pieces, scout};
use self::gaussian_fit::GaussianFit;
use self::linear_score::{LinearScore, look, look_count};
use self::map_choice::choose;
use crate::mapped_target::MappedTarget;
use crate::start::Stream;
use crate::triangular_map::TriangularMap;
use crate::{Run, SampleError, Start};

/// Pieces whose masses have a larger standard error are not told apart.
const LARGEST_MASS_ERROR: f64 = 0.05;

/// A body is placed here.
#[derive(Clone, Debug)]
pub(crate) struct Site<const D: usize> {
    /// The coordinates in which it moves.
    pub frame: Frame<D>,
    /// If there is one, it takes the place of the frame.
    pub map: Option<TriangularMap<D>>,
    /// Its share of the total mass.
    pub mass: f64,
    /// The standard error of it.
    pub mass_error: f64,
    /// Inner over outer stiffness, at least 1: what the tails ask the spacing to be wider by.
    pub tails: f64,
}

impl<const D: usize> Site<D> {
    pub fn new(frame: Frame<D>, mass: f64) -> Self {
        Self {
            frame,
            map: None,
            mass,
            mass_error: 0.0,
            tails: 1.0,
        }
    }

    /// `act` on the target and the frame of the body's coordinates: where there is a map, the target is seen through it.
    pub fn within<R>(&self, target: &dyn Target<D>, act: impl FnOnce(&dyn Target<D>, &Frame<D>) -> R) -> R {
        match &self.map {
            Some(map) => act(&MappedTarget { target, map }, &Frame::identity()),
            None => act(target, &self.frame),
        }
    }
}

/// What the survey found.
#[derive(Clone, Debug)]
pub(crate) struct Survey<const D: usize> {
    /// Where bodies are placed; one for a target in one piece.
    pub sites: Vec<Site<D>>,
    /// The one place for a body that takes all pieces.
    pub whole: Site<D>,
    /// Whether the start that was asked for serves; else bodies begin as N(0, I) of their frame.
    pub keeps_start: bool,
    /// Evaluations it took.
    pub evaluations: u64,
}

impl<const D: usize> Survey<D> {
    /// No look at the target: the frame and the start are taken as they are.
    pub fn skipped(frame: &Frame<D>) -> Self {
        Self {
            sites: vec![Site::new(*frame, 1.0)],
            whole: Site::new(*frame, 1.0),
            keeps_start: true,
            evaluations: 0,
        }
    }

    /// Look at the target from `positions`, the start in coordinates of `frame`.
    pub fn new(
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
        positions: &[[f64; D]],
    ) -> Result<Self, SampleError> {
        let mut density = Density::new(target, frame);
        let mut survey = Self::skipped(frame);
        let start = sane(&run.start).then(|| look(&mut density, positions)).flatten();
        if let Some(score) = start.filter(LinearScore::fits) {
            survey.sites[0].tails = score.tails;
        } else {
            let seed = run.generator(Stream::Survey.of_body(0)).random();
            let normal = run.standard_positions::<D>(look_count::<D>().min(positions.len()), 0)?;
            let mut evaluations = 0;
            let mut look_in = |site: &Site<D>| {
                site.within(target, |target, frame| {
                    let mut density = Density::new(target, frame);
                    let score = look(&mut density, &normal);
                    evaluations += density.evaluations;
                    score
                })
            };
            if let Some(scouted) = scout(&mut density, positions, seed)? {
                let (map, spent) = choose(target, frame, &scouted, seed)?;
                survey.evaluations += spent;
                if map.is_some() {
                    survey.whole.map = map;
                    survey.keeps_start = false;
                } else if let Some(found) = pieces(&mut density, scouted, seed)? {
                    let own = frame_of(frame, &found.whole).map(|own| Site::new(own, 1.0));
                    let own_fits = own.as_ref().and_then(&mut look_in).is_some_and(|score| score.fits());
                    let own = own.filter(|_| !serves(&found.whole, own_fits));
                    survey.place(frame, &run.start, &found, own);
                }
            }
            let mut tails = |site: &mut Site<D>| site.tails = look_in(site).map_or(1.0, |score| score.tails);
            tails(&mut survey.whole);
            if let [only] = &mut survey.sites[..] {
                only.clone_from(&survey.whole);
            } else {
                survey.sites.iter_mut().for_each(tails);
            }
            survey.evaluations += evaluations;
        }
        survey.evaluations += density.evaluations;
        Ok(survey)
    }

    /// Bodies for the pieces found. `own` is the site of the fit to all of them, where the given one does not serve.
    fn place(&mut self, frame: &Frame<D>, start: &Start, found: &Found<D>, own: Option<Site<D>>) {
        let serves = own.is_none();
        if let Some(own) = own {
            self.whole = own;
        }
        let sites: Vec<Site<D>> = found
            .pieces
            .iter()
            .filter_map(|piece| {
                let site = Site::new(frame_of(frame, &piece.fit)?, piece.mass);
                Some(Site {
                    mass_error: piece.mass_error,
                    ..site
                })
            })
            .collect();
        let apart = sites.len() > 1 && sites.iter().all(|site| site.mass_error <= LARGEST_MASS_ERROR);
        self.keeps_start = serves && !apart && sane(start);
        self.sites = if apart { sites } else { vec![self.whole.clone()] };
    }
}

/// Whether the start law is within a few standard deviations of the frame's.
fn sane(start: &Start) -> bool {
    start.mean.abs() <= 2.0 && (1.0 / 3.0..=3.0).contains(&start.standard_deviation)
}

/// Whether the given frame serves a target with this fit in its coordinates: it lies within the frame, and is not much narrower unless
/// the target is bent there. The nearest Gaussian to a bent target is narrow (KL(N ‖ p) keeps it inside of p) and says
/// nothing against a wider frame; `gaussian`: the scores around the fit are those of a Gaussian.
fn serves<const D: usize>(fit: &GaussianFit<D>, gaussian: bool) -> bool {
    let Some(eigen) = SymmetricEigen::new(&(fit.root * fit.root.transpose())) else {
        return false;
    };
    let inside = vector::maximum_norm(&fit.mean) <= 3.0 && eigen.values.iter().all(|&v| v <= 9.0);
    inside && (!gaussian || eigen.values.iter().all(|&v| v >= 0.01))
}

/// The frame of a fit, in the target's coordinates; `None` if its covariance is singular to rounding.
fn frame_of<const D: usize>(frame: &Frame<D>, fit: &GaussianFit<D>) -> Option<Frame<D>> {
    let root = *frame.factor() * fit.root;
    Frame::new(frame.to_target(&fit.mean), (root * root.transpose()).symmetric_part()).ok()
}
