//! The best configuration of a body on its way.

use mpm_core::MpmError;
use parvi_body::Moving;
use parvi_targets::Frame;

use crate::start::check;
use crate::stein_discrepancy::squared_discrepancy;
use crate::{Monitor, SampleError, Watch, Watched};

/// A look is better if its number is less than the best one by this share of its size.
const BETTER: f64 = 0.01;

/// A watch on a run.
pub(crate) struct Watching<const D: usize> {
    watch: Watch,
    seen: Watched<D>,
    /// The number that the next one has to be better than, and the looks since.
    mark: f64,
    since: usize,
    /// Evaluations of the log density.
    pub density_evaluations: u64,
}

impl<const D: usize> Watching<D> {
    /// Before the first look.
    pub fn new(watch: Watch) -> Result<Self, SampleError> {
        let looks = [("steps between looks", Some(watch.every)), ("patience", watch.patience)];
        for (field, count) in looks {
            check(field, count.unwrap_or(1) as f64, count != Some(0), "at least 1")?;
        }
        Ok(Self {
            watch,
            seen: Watched::default(),
            mark: f64::INFINITY,
            since: 0,
            density_evaluations: 0,
        })
    }

    /// Whether a step is one to look at.
    pub fn is_due(&self, step: usize, steps: usize) -> bool {
        step.is_multiple_of(self.watch.every) || step == steps
    }

    /// Looks at the body after a step; whether the run is to end.
    pub fn look(
        &mut self,
        step: usize,
        body: &mut dyn Moving<'_, D>,
        frame: &Frame<D>,
        spacing: f64,
    ) -> Result<bool, MpmError> {
        let value = self.value(body, spacing)?;
        self.seen.history.push((step, value));
        if value < self.seen.value || self.seen.positions.is_empty() {
            let particles = body.particles();
            let in_order = particles.in_creation_order(&particles.positions);
            self.seen.positions = in_order.iter().map(|z| frame.to_target(z)).collect();
            (self.seen.step, self.seen.value) = (step, value);
        }
        if value < self.mark - BETTER * self.mark.abs() || self.mark == f64::INFINITY {
            (self.mark, self.since) = (value, 0);
        } else {
            self.since += 1;
        }
        Ok(self.watch.patience.is_some_and(|patience| self.since >= patience))
    }

    /// All that was seen.
    pub fn into_seen(self) -> Watched<D> {
        self.seen
    }

    fn value(&mut self, body: &mut dyn Moving<'_, D>, spacing: f64) -> Result<f64, MpmError> {
        let positions = body.particles().positions.clone();
        Ok(match self.watch.monitor {
            Monitor::SteinDiscrepancy => {
                let mut scores = vec![[0.0; D]; positions.len()];
                body.force().score.evaluate(&positions, &mut scores)?;
                squared_discrepancy(&positions, &scores).max(0.0).sqrt()
            }
            Monitor::LogDensity => {
                self.density_evaluations += positions.len() as u64;
                body.force().score.potential_energy(&positions).unwrap_or(f64::INFINITY)
            }
            Monitor::ParticleDensity => {
                let densities = body.grid_densities(spacing)?;
                -densities.iter().map(|density| density.ln()).sum::<f64>() / densities.len() as f64
            }
        })
    }
}
