//! Where the particles begin, and what a run may ask for.

use parvi_body::TransferChoice;
use parvi_targets::{CatalogueTarget, Frame, Gaussian, SobolSequence};
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};
use rand_distr::{Distribution, StandardNormal};

use crate::{Run, SampleError, Start, StartDraws};

/// The independent random choices of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Stream {
    /// Where particles begin.
    Start = 0,
    /// Origins and spacings of the basis.
    Places = 1,
    /// Orientations of the basis.
    Rotations = 2,
    /// Where scouts begin.
    Survey = 3,
}

impl Stream {
    /// The stream of the body with this number.
    pub fn of_body(self, body: usize) -> u64 {
        self as u64 + 4 * body as u64
    }
}

impl Run {
    /// The generator of a run's random choices; `stream` keeps independent choices apart.
    pub(crate) fn generator(&self, stream: u64) -> ChaCha8Rng {
        let mut generator = ChaCha8Rng::seed_from_u64(self.seed);
        generator.set_stream(stream);
        generator
    }

    /// M, checked to be a number that particles can be counted with.
    pub(crate) fn checked_particles(&self) -> Result<usize, SampleError> {
        let count = self.particles;
        let allowed = count >= 2 && u32::try_from(count).is_ok();
        check("particles", count as f64, allowed, "from 2 to 2^32 - 1")?;
        Ok(count)
    }

    /// The same for a method that takes nothing that is given of the particles.
    pub(crate) fn particles_of(&self, method: &'static str) -> Result<usize, SampleError> {
        self.given.check_taken(method, false)?;
        self.checked_particles()
    }

    /// The start law, checked to be one.
    pub(crate) fn checked_start(&self) -> Result<Start, SampleError> {
        positive("start standard deviation", Some(self.start.standard_deviation), 0.0)?;
        check("start mean", self.start.mean, self.start.mean.is_finite(), "finite")?;
        Ok(self.start)
    }

    /// Where the particles begin, in coordinates of a frame: as given, or drawn from the start law.
    pub(crate) fn begin<const D: usize>(&self, frame: &Frame<D>) -> Result<Vec<[f64; D]>, SampleError> {
        let count = self.checked_particles()?;
        self.given.check::<D>(count)?;
        match self.given.positions_in(frame) {
            Some(positions) => Ok(positions),
            None => self.start_positions(),
        }
    }

    /// Draws from the start law, in frame coordinates.
    pub(crate) fn start_positions<const D: usize>(&self) -> Result<Vec<[f64; D]>, SampleError> {
        let count = self.checked_particles()?;
        let Start {
            mean,
            standard_deviation,
            ..
        } = self.checked_start()?;
        let mut positions = self.standard_positions::<D>(count, 0)?;
        for c in positions.as_flattened_mut() {
            *c = mean + standard_deviation * *c;
        }
        Ok(positions)
    }

    /// `count` draws from N(0, I), the start of a body with this number.
    pub(crate) fn standard_positions<const D: usize>(
        &self,
        count: usize,
        body: usize,
    ) -> Result<Vec<[f64; D]>, SampleError> {
        let mut generator = self.generator(Stream::Start.of_body(body));
        match self.start.draws {
            // Of the seed's own stream, so that the yardstick of the same seed has other points.
            StartDraws::QuasiRandom => quasi_random_normal(count, generator.random()),
            StartDraws::Independent => Ok((0..count)
                .map(|_| std::array::from_fn(|_| StandardNormal.sample(&mut generator)))
                .collect()),
        }
    }
}

/// Scrambled Sobol points through the quantile function of N(0, I).
pub(crate) fn quasi_random_normal<const D: usize>(count: usize, seed: u64) -> Result<Vec<[f64; D]>, SampleError> {
    let law = Gaussian::<D>::standard();
    let (Ok(sequence), Some(transport)) = (SobolSequence::scrambled(D, seed), law.unit_cube_transport()) else {
        return Err(SampleError::InvalidOption {
            field: "dimensions of a quasi-random start",
            value: D as f64,
            expected: "at most 21",
        });
    };
    let point = |index| {
        let mut u = [0.0; D];
        sequence.write(index, &mut u);
        transport.transport(&u)
    };
    Ok((0..count as u32).map(point).collect())
}

/// An error that names the option, unless `allowed`.
pub(crate) fn check(field: &'static str, value: f64, allowed: bool, expected: &'static str) -> Result<(), SampleError> {
    if allowed {
        Ok(())
    } else {
        Err(SampleError::InvalidOption { field, value, expected })
    }
}

/// `value` (or the default), checked to be positive and finite.
pub(crate) fn positive(field: &'static str, value: Option<f64>, default: f64) -> Result<f64, SampleError> {
    let value = value.unwrap_or(default);
    check(field, value, value > 0.0 && value.is_finite(), "positive and finite")?;
    Ok(value)
}

/// `value`, checked to be finite and not negative.
pub(crate) fn not_negative(field: &'static str, value: f64) -> Result<f64, SampleError> {
    check(field, value, value >= 0.0 && value.is_finite(), "at least 0 and finite")?;
    Ok(value)
}

/// The number of steps (or the default), checked to be at least one.
pub(crate) fn steps(value: Option<usize>, default: usize) -> Result<usize, SampleError> {
    let value = value.unwrap_or(default);
    check("steps", value as f64, value >= 1, "at least 1")?;
    Ok(value)
}

/// The transfer, if its share of FLIP is one.
pub(crate) fn checked_transfer(choice: TransferChoice) -> Result<TransferChoice, SampleError> {
    match choice {
        TransferChoice::Pic | TransferChoice::Apic => {}
        TransferChoice::Flip(share) | TransferChoice::AffineFlip(share) => {
            check("FLIP share", share, (0.0..=1.0).contains(&share), "in [0, 1]")?;
        }
    }
    Ok(choice)
}
