//! Study `evidence`: how far log Z is from its known value, and whether its standard error says so.

mod report;

use serde::Deserialize;

use super::attempt::attempt;
use super::checks::{all_given, distinct, refusal};
use super::definition::{self, Report, Study, Work};
use super::directory::StudyDirectory;
use super::run_row::RunRow;
use super::seed_range::SeedRange;
use crate::options::{MethodSpecification, ParticleCount, TargetSpecification};
use crate::{CommandError, sampling};

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

/// One run.
#[derive(Clone, Debug, PartialEq)]
pub struct Case {
    target: TargetSpecification,
    method: MethodSpecification,
    seed: u64,
}

impl definition::Case for Case {
    fn id(&self) -> String {
        format!("{}-{}-s{}", self.target.label(), self.method.label(), self.seed)
    }

    fn method(&self) -> Option<&MethodSpecification> {
        Some(&self.method)
    }
}

impl Study for Evidence {
    type Case = Case;
    type Row = RunRow;
    type Shared = ();

    const KIND: &'static str = "evidence";
    const COLUMNS: &'static str = "case status reason target dim method seed outcome log_evidence_deviation log_evidence_error \
         score_evaluations density_evaluations wall_seconds";

    fn seeds(&self) -> Vec<u64> {
        self.run_seeds.all().collect()
    }

    fn cases(&self) -> Result<Vec<Case>, CommandError> {
        all_given!(self: targets, methods);
        let mut cases = Vec::new();
        for target in &self.targets {
            if !parvi_targets::target_info(&target.name)?.log_evidence {
                return Err(refusal("targets", format!("log Z of `{}` is not known", target.name)));
            }
            for method in &self.methods {
                cases.extend(self.run_seeds.all().map(|seed| Case {
                    target: target.clone(),
                    method: method.clone(),
                    seed,
                }));
            }
        }
        distinct("targets or methods", &cases)?;
        Ok(cases)
    }

    fn run(&self, case: &Case, work: Work<'_, ()>) -> Result<RunRow, CommandError> {
        let run = case.method.run(self.particles.get(), case.seed);
        let mut row = RunRow {
            seed: Some(case.seed),
            ..RunRow::on(case, &case.target, &case.method)?
        };
        let method = case.method.method(None)?;
        row.note(attempt(sampling::sample(&case.target, &method, &run, work.observer))?);
        Ok(row)
    }

    fn report(&self, rows: &[RunRow], _: &StudyDirectory) -> Result<Report, CommandError> {
        Ok(report::report(self, rows))
    }
}
