//! Study `evidence`: how far log Z is from its known value, and whether its standard error says so.

mod report;

use super::prelude::*;
use super::seed_range::SeedRange;

/// Every method on every target, with every seed.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Evidence {
    /// Seeds of the runs.
    run_seeds: SeedRange,
    /// M.
    particles: ParticleCount,
    /// Targets whose log Z is known.
    targets: Vec<TargetSpecification>,
    /// Methods that state log Z.
    methods: Vec<MethodSpecification>,
}

impl Study for Evidence {
    type Work = Sampled;

    const KIND: &'static str = "evidence";
    const COLUMNS: &'static str = "case status reason target dim method seed outcome log_evidence_deviation log_evidence_error \
         score_evaluations density_evaluations wall_seconds";
    const REPORT: Report<Self> = report::report;

    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        all_given!(self: targets, methods);
        let seeds: Vec<u64> = self.run_seeds.all().collect();
        let mut cases = Vec::new();
        for target in &self.targets {
            let is_known = parvi_targets::target_info(&target.name)?.log_evidence;
            holds(is_known, "targets", || {
                format!("log Z of `{}` is not known", target.name)
            })?;
            for method in &self.methods {
                let size = (self.particles.get(), None);
                let name = format!("{}-{}", target.label(), method.label());
                cases.extend(Sampled::of_seeds((target, method), size, (&name, &seeds))?);
            }
        }
        distinct("targets or methods", cases)
    }

    fn run(&self, case: &Case<Sampled>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        row.note(case.work.sample(tools.observer))?;
        Ok(())
    }
}
