//! Before the body moves: where the target is, how wide, and of how many separate pieces.

mod ascent;
mod clusters;
mod density;
mod gaussian_fit;
mod linear_score;
mod masses;

use mpm_tensor::{Matrix, SymmetricEigen, vector};
use parvi_targets::{Frame, Target};
use rand::RngExt;

use self::ascent::ascend;
use self::clusters::clusters;
use self::density::{Density, Valued};
use self::gaussian_fit::{GaussianFit, fit};
use self::linear_score::{LinearScore, look, look_count};
use self::masses::masses;
use crate::start::{Stream, quasi_random_normal};
use crate::{Run, SampleError, Start};

/// Scouts of the first round, which begin where the run begins and around the frame.
const FIRST_SCOUTS: usize = 16;

/// Distances of the second round from the best summit, in standard deviations of its fit.
const RINGS: [f64; 3] = [5.0, 12.0, 30.0];

/// Scouts at each of these.
const SCOUTS_PER_RING: usize = 8;

/// Evaluations of one scout.
const ASCENT: usize = 40;

/// Points from which the masses of several modes are estimated, per mode.
const MASS_POINTS: usize = 512;

/// Separate pieces lighter than this are left out.
const SMALLEST_MASS: f64 = 1e-3;

/// Pieces whose bodies exchange a larger share of their particles are one.
const LARGEST_EXCHANGE: f64 = 0.02;

/// A body is placed here.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site<const D: usize> {
    /// The coordinates in which it moves.
    pub frame: Frame<D>,
    /// Its share of the total mass.
    pub mass: f64,
    /// Inner over outer stiffness, at least 1: what the tails ask the spacing to be wider by.
    pub tails: f64,
}

impl<const D: usize> Site<D> {
    pub fn new(frame: Frame<D>, mass: f64) -> Self {
        Self {
            frame,
            mass,
            tails: 1.0,
        }
    }

    /// log N(x; the frame's centre and covariance), up to a constant.
    pub fn log_density(&self, x: &[f64; D]) -> f64 {
        -0.5 * vector::norm_squared(&self.frame.to_reference(x)) - self.frame.log_determinant()
    }
}

/// What the survey found.
#[derive(Clone, Debug)]
pub(crate) struct Survey<const D: usize> {
    /// Where bodies are placed; one for a target in one piece.
    pub sites: Vec<Site<D>>,
    /// The one place for a body if the pieces turn out to be connected.
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
            if let Some(found) = explore(&mut density, positions, seed)? {
                survey.place(frame, &run.start, &found);
            }
            let normal = run.standard_positions::<D>(look_count::<D>().min(positions.len()), 0)?;
            for site in survey.sites.iter_mut().chain([&mut survey.whole]) {
                let mut density = Density::new(target, &site.frame);
                site.tails = look(&mut density, &normal).map_or(1.0, |score| score.tails);
                survey.evaluations += density.evaluations;
            }
        }
        survey.evaluations += density.evaluations;
        Ok(survey)
    }

    /// Keep the given frame where the fit to all pieces bears it out; a frame for each piece where there are several.
    fn place(&mut self, frame: &Frame<D>, start: &Start, found: &Found<D>) {
        let serves = plausible(&found.whole);
        if !serves && let Some(frame) = frame_of(frame, &found.whole) {
            self.whole.frame = frame;
        }
        let sites: Vec<Site<D>> = found
            .pieces
            .iter()
            .filter_map(|(fit, mass)| Some(Site::new(frame_of(frame, fit)?, *mass)))
            .collect();
        self.keeps_start = serves && sites.len() < 2 && sane(start);
        self.sites = if sites.len() < 2 { vec![self.whole] } else { sites };
    }

    /// Whether bodies that were placed on separate pieces have flowed into each other, so that there is one piece: `clouds` has the
    /// particles of each site's body.
    pub fn pieces_are_connected(sites: &[Site<D>], clouds: &[&[[f64; D]]]) -> bool {
        let strangers = |(own, cloud): (usize, &&[[f64; D]])| {
            let nearest = |x: &[f64; D]| {
                (0..sites.len()).max_by(|&a, &b| sites[a].log_density(x).total_cmp(&sites[b].log_density(x)))
            };
            cloud.iter().filter(|x| nearest(x) != Some(own)).count()
        };
        let abroad: usize = clouds.iter().enumerate().map(strangers).sum();
        let all: usize = clouds.iter().map(|cloud| cloud.len()).sum();
        abroad as f64 > LARGEST_EXCHANGE * all as f64
    }
}

/// Whether the start law is within a few standard deviations of the frame's.
fn sane(start: &Start) -> bool {
    start.mean.abs() <= 2.0 && (1.0 / 3.0..=3.0).contains(&start.standard_deviation)
}

/// Whether a fit lies within a frame and is not much narrower or wider.
fn plausible<const D: usize>(fit: &GaussianFit<D>) -> bool {
    let Some(eigen) = SymmetricEigen::new(&(fit.root * fit.root.transpose())) else {
        return false;
    };
    vector::maximum_norm(&fit.mean) <= 3.0 && eigen.values.iter().all(|v| (0.01..=9.0).contains(v))
}

/// Gaussians for the pieces of a target, with their masses, and one for the whole.
struct Found<const D: usize> {
    pieces: Vec<(GaussianFit<D>, f64)>,
    whole: GaussianFit<D>,
}

/// Scouts, their clusters, and a Gaussian with a mass for each; `None` where the target cannot be evaluated.
fn explore<const D: usize>(
    density: &mut Density<'_, D>,
    positions: &[[f64; D]],
    seed: u64,
) -> Result<Option<Found<D>>, SampleError> {
    let directions: Vec<[f64; D]> = quasi_random_normal(FIRST_SCOUTS + RINGS.len() * SCOUTS_PER_RING, seed)?;
    let nodes = quadrature_nodes::<D>(seed)?;
    let half = FIRST_SCOUTS / 2;
    let from_start = positions.iter().take(half).copied();
    let around_frame = directions[half..FIRST_SCOUTS].iter().map(|u| vector::scale(u, 2.0));
    let mut summits: Vec<Valued<D>> = from_start
        .chain(around_frame)
        .filter_map(|start| ascend(density, &start, None, ASCENT))
        .collect();
    let Some(best) = summits
        .iter()
        .max_by(|a, b| a.log_density.total_cmp(&b.log_density))
        .copied()
    else {
        return Ok(None);
    };
    let curvature = local_root(density, &best);
    let Some(widest) = fit(density, best.point, curvature, &nodes) else {
        return Ok(None);
    };
    let metric = widest.root * widest.root.transpose();
    for (ring, scouts) in RINGS.iter().zip(directions[FIRST_SCOUTS..].chunks(SCOUTS_PER_RING)) {
        for u in scouts {
            let reach = ring / vector::norm(u).max(1e-9);
            let start = vector::add_scaled(&widest.mean, reach, &widest.root.apply(u));
            summits.extend(ascend(density, &start, Some(&metric), ASCENT));
        }
    }
    let mut fits = Vec::new();
    for cluster in clusters(density, summits) {
        let summit = &cluster[0];
        let start = local_root(density, summit);
        fits.extend(fit(density, summit.point, start, &nodes));
    }
    if fits.len() < 2 {
        return Ok(fits.pop().map(|only| Found {
            pieces: vec![(only, 1.0)],
            whole: only,
        }));
    }
    let points = quasi_random_normal(MASS_POINTS, seed.wrapping_add(1))?;
    let Some(found) = masses(density, &fits, &points) else {
        return Ok(None);
    };
    let heavy: f64 = found.values.iter().filter(|&&mass| mass >= SMALLEST_MASS).sum();
    let pieces = fits
        .into_iter()
        .zip(found.values)
        .filter(|&(_, mass)| mass >= SMALLEST_MASS)
        .map(|(fit, mass)| (fit, mass / heavy))
        .collect();
    Ok(Some(Found {
        pieces,
        whole: found.whole,
    }))
}

/// A root of the inverse curvature at a summit, from differences of scores; directions that are not concave get the widest scale
/// that the others have, or 1.
fn local_root<const D: usize>(density: &mut Density<'_, D>, summit: &Valued<D>) -> Matrix<D> {
    const STEP: f64 = 1e-4;
    let mut hessian = Matrix::<D>::ZERO;
    for axis in 0..D {
        let mut ahead = summit.point;
        let step = STEP * ahead[axis].abs().max(1.0);
        ahead[axis] += step;
        if let Some(value) = density.value(&ahead) {
            let column = vector::scale(&vector::subtract(&summit.score, &value.score), 1.0 / step);
            for (row, entry) in hessian.0.iter_mut().zip(column) {
                row[axis] = entry;
            }
        }
    }
    match SymmetricEigen::new(&hessian.symmetric_part()) {
        Some(eigen) => {
            let least = eigen
                .values
                .iter()
                .copied()
                .filter(|&q| q > 0.0)
                .fold(f64::INFINITY, f64::min);
            let floor = if least.is_finite() { least } else { 1.0 };
            eigen.map(|q| q.max(floor).sqrt().recip())
        }
        None => Matrix::IDENTITY,
    }
}

/// Points ±u with mean zero and covariance I.
fn quadrature_nodes<const D: usize>(seed: u64) -> Result<Vec<[f64; D]>, SampleError> {
    let count = (2 * D).max(8);
    let mut nodes: Vec<[f64; D]> = quasi_random_normal(count, seed.wrapping_add(2))?;
    nodes.extend_from_within(..);
    for u in &mut nodes[count..] {
        *u = u.map(|c| -c);
    }
    let share = 1.0 / nodes.len() as f64;
    let covariance = nodes
        .iter()
        .fold(Matrix::<D>::ZERO, |sum, u| sum + Matrix::outer(u, u) * share);
    if let Some(eigen) = SymmetricEigen::new(&covariance) {
        let whiten = eigen.map(|value| value.max(1e-9).sqrt().recip());
        for u in &mut nodes {
            *u = whiten.apply(u);
        }
    }
    Ok(nodes)
}

/// The frame of a fit, in the target's coordinates; `None` if its covariance is singular to rounding.
fn frame_of<const D: usize>(frame: &Frame<D>, fit: &GaussianFit<D>) -> Option<Frame<D>> {
    let root = *frame.factor() * fit.root;
    Frame::new(frame.to_target(&fit.mean), (root * root.transpose()).symmetric_part()).ok()
}
