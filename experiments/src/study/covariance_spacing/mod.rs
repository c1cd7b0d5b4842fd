//! Study `covariance-spacing`: how far the covariance of resting particles is from the target's, against the spacing.
//!
//! For a Gaussian target, resting nodes have exact moments at any spacing; resting particles only approximately,
//! because forces in the null space of the transfer can remain. The study measures what is left: max_ij |Ĉ − I|_ij of
//! M particles that were driven to rest without shifts of the grid and without a moment correction.

mod report;

use serde::Deserialize;

use super::attempt::attempt;
use super::checks::{not_empty, positive, refusal, unset};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::moments::SampleMoments;
use super::run_row::RunRow;
use crate::options::{Dimension, MethodSpecification, ParticleCount, TargetSpecification};
use crate::{CommandError, sampling};

/// Resting particles at several spacings, one series per dimension.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct CovarianceSpacing {
    /// Seeds of the start, one case each.
    seeds: Vec<u64>,
    /// M.
    particles: ParticleCount,
    /// The sampler; its spacing comes from the series.
    method: MethodSpecification,
    /// One per dimension.
    series: Vec<Series>,
}

/// The spacings of one dimension.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Series {
    /// d.
    dim: Dimension,
    /// Spacings h in standard deviations.
    spacings: Vec<f64>,
    /// A spacing at which the error is judged.
    judged_spacing: Option<f64>,
    /// The largest covariance error allowed there.
    bound: Option<f64>,
}

impl CovarianceSpacing {
    /// Checks what belongs together.
    fn check(&self) -> Result<(), CommandError> {
        not_empty("seeds", &self.seeds)?;
        let spacing = &self.method.options.spacing;
        unset("method.options.spacing", spacing, "series.spacings")?;
        for series in &self.series {
            positive("spacings", &series.spacings)?;
            if let Some(judged) = series.judged_spacing
                && !series.spacings.contains(&judged)
            {
                let message = format!("{judged} is not among the spacings of d = {}", series.dim);
                return Err(refusal("judged-spacing", message));
            }
        }
        Ok(())
    }
}

/// One dimension, spacing and seed.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    dim: Dimension,
    spacing: f64,
    seed: u64,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("d{}-h{}-s{}", self.dim, self.spacing, self.seed)
    }

    fn cost(&self) -> f64 {
        3f64.powi(self.dim.get() as i32)
    }
}

impl Study for CovarianceSpacing {
    type Case = Case;
    type Row = RunRow;
    type Shared = ();

    const KIND: &'static str = "covariance-spacing";
    const COLUMNS: &'static str = "case status reason dim particles spacing seed steps covariance_error mean_error residual active_nodes \
         score_evaluations density_evaluations wall_seconds";

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        self.check()?;
        let mut cases = Vec::new();
        for series in &self.series {
            for &spacing in &series.spacings {
                cases.extend(self.seeds.iter().map(|&seed| Case {
                    dim: series.dim,
                    spacing,
                    seed,
                }));
            }
        }
        Ok(cases)
    }

    fn run(&self, case: &Case, work: Work<'_, ()>) -> Result<RunRow, CommandError> {
        let mut specification = self.method.clone();
        specification.options.spacing = Some(case.spacing);
        let method = specification.method(None)?;
        let run = specification.run(self.particles.get(), case.seed);
        let target = TargetSpecification::plain("gaussian", Some(case.dim));
        let mut row = RunRow {
            dim: case.dim.get(),
            particles: run.particles,
            seed: Some(case.seed),
            ..RunRow::new(case)
        };
        if let Some(outcome) = row.note(attempt(sampling::sample(&target, &method, &run, work.observer))?) {
            let moments = SampleMoments::of(&outcome.particles);
            row.covariance_error = Some(moments.distance_from_identity());
            row.mean_error = Some(moments.largest_mean());
        }
        row.spacing = Some(case.spacing);
        Ok(row)
    }

    fn report(&self, rows: &[RunRow], _: &StudyDirectory) -> Result<Report, CommandError> {
        Ok(report::report(self, rows))
    }
}
