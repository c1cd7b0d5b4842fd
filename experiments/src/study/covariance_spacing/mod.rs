//! Study `covariance-spacing`: how far the covariance of resting particles is from the target's, against the spacing.
//!
//! For a Gaussian target, resting nodes have exact moments at any spacing; resting particles only approximately,
//! because forces in the null space of the transfer can remain. The study measures what is left: max_ij |Ĉ − I|_ij of
//! M particles that were driven to rest without shifts of the grid and without a moment correction.

mod report;

use super::prelude::*;
use crate::statistics::SampleMoments;

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

impl Study for CovarianceSpacing {
    type Work = Sampled;

    const KIND: &'static str = "covariance-spacing";
    const COLUMNS: &'static str = "case status reason dim particles spacing seed steps covariance_error mean_error residual active_nodes \
         score_evaluations density_evaluations wall_seconds";
    const REPORT: Report<Self> = report::report;

    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        not_empty("seeds", &self.seeds)?;
        let spacing = &self.method.options.spacing;
        unset("method.options.spacing", spacing, "series.spacings")?;
        let mut cases = Vec::new();
        for series in &self.series {
            let (dim, spacings) = (&series.dim, &series.spacings);
            positive("spacings", spacings)?;
            if let Some(judged) = series.judged_spacing {
                let otherwise = || format!("{judged} is not among the spacings of d = {dim}");
                holds(spacings.contains(&judged), "judged-spacing", otherwise)?;
            }
            let target = TargetSpecification::plain("gaussian", Some(*dim));
            for &spacing in spacings {
                let mut method = self.method.clone();
                method.options.spacing = Some(spacing);
                let (size, name) = ((self.particles.get(), None), format!("d{dim}-h{spacing}"));
                let here = Sampled::of_seeds((&target, &method), size, (&name, &self.seeds))?.into_iter();
                cases.extend(here.map(|case| case.costing(stencil(dim.get())).with("spacing", spacing)));
            }
        }
        distinct("seeds, spacings or series", cases)
    }

    fn run(&self, case: &Case<Sampled>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        if let Some(outcome) = row.note(case.work.sample(tools.observer))? {
            let points = outcome.particles.to_rows();
            let moments = SampleMoments::of(&points, outcome.particles.weights())?;
            row.set("covariance_error", moments.distance_from_identity());
            row.set("mean_error", moments.largest_mean());
        }
        row.set("spacing", case.row.number("spacing"));
        Ok(())
    }
}
