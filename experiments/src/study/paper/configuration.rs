//! The configuration of the study `paper`.

use std::collections::HashSet;

use parvi::ReferenceVolumes;
use serde::Deserialize;

use super::Case;
use super::body::{Body, Schedule, Variant};
use super::material::MaterialTable;
use crate::CommandError;
use crate::options::{Bounded, MethodSpecification, ParticleCount, Score, StepCount, TargetSpecification};
use crate::study::checks::{distinct, not_empty, positive, refusal};
use crate::study::definition;
use crate::study::each_once::each_once;
use crate::study::yardstick::{Coordinates, YardstickOptions};

/// The paper's algorithms, a base and its changes.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Paper {
    /// Mean of every coordinate at the start, in units of the body's coordinates.
    pub start_mean: f64,
    /// Standard deviation of every coordinate at the start.
    pub start_sd: f64,
    /// The particles are looked at every so many steps.
    pub look_every: Bounded<1, 1_000_000>,
    /// A run ends where its mean, or its spread, is off by so many standard deviations of the target.
    pub reach: f64,
    /// Quasi-random points that stand for a target.
    pub reference_points: Bounded<1000, 1_000_000>,
    /// Their seed.
    pub reference_seed: u64,
    /// Directions of the sliced distance.
    pub directions: Bounded<1, 100_000>,
    /// What the algorithms are compared with, on every target of the base.
    pub rivals: Vec<MethodSpecification>,
    /// What every case has unless it says otherwise.
    pub base: Settings,
    /// The cases.
    #[serde(rename = "case")]
    pub sweeps: Vec<Settings>,
}

/// Lists of values, of which all combinations are run; absent: as in the base.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
pub struct Settings {
    /// The name of a case.
    pub name: Option<String>,
    targets: Option<Vec<TargetSpecification>>,
    algorithms: Option<Vec<Bounded<1, 2>>>,
    variants: Option<Vec<Variant>>,
    materials: Option<Vec<MaterialTable>>,
    schedules: Option<Vec<Schedule>>,
    scores: Option<Vec<Score>>,
    volumes: Option<Vec<ReferenceVolumes>>,
    frictions: Option<Vec<f64>>,
    spacings: Option<Vec<f64>>,
    time_steps: Option<Vec<f64>>,
    steps: Option<Vec<StepCount>>,
    particles: Option<Vec<ParticleCount>>,
    seeds: Option<Vec<u64>>,
}

/// Every case once for each of the values.
fn vary<T>(cases: &mut Vec<Case>, values: &[T], set: impl Fn(&mut Case, &T)) {
    let mut varied = Vec::with_capacity(cases.len() * values.len());
    for case in &*cases {
        for value in values {
            let mut case = case.clone();
            set(&mut case, value);
            varied.push(case);
        }
    }
    *cases = varied;
}

/// Fields of a table in errors, and the values that it or the base has for them.
struct Lists<'a> {
    field: &'a str,
}

impl Lists<'_> {
    fn refusal(&self, key: &str, message: impl Into<String>) -> CommandError {
        refusal(&format!("{}.{key}", self.field), message)
    }

    fn given<'a, T>(
        &self,
        key: &str,
        of_case: &'a Option<Vec<T>>,
        of_base: &'a Option<Vec<T>>,
    ) -> Result<&'a [T], CommandError> {
        let values = of_case.as_ref().or(of_base.as_ref());
        let values = values.ok_or_else(|| self.refusal(key, "is missing, also in the base"))?;
        not_empty(&format!("{}.{key}", self.field), values)?;
        Ok(values)
    }

    fn positive<'a>(
        &self,
        key: &str,
        of_case: &'a Option<Vec<f64>>,
        of_base: &'a Option<Vec<f64>>,
    ) -> Result<Vec<Option<f64>>, CommandError> {
        if of_case.is_none() && of_base.is_none() {
            return Ok(vec![None]);
        }
        let values = self.given(key, of_case, of_base)?;
        positive(&format!("{}.{key}", self.field), values)?;
        Ok(values.iter().copied().map(Some).collect())
    }
}

impl Paper {
    /// All cases, each once, target by target, so that a target's reference is made once.
    pub fn all_cases(&self) -> Result<Vec<Case>, CommandError> {
        self.check()?;
        let mut cases = self.base_cases()?;
        cases.extend(self.rival_cases()?);
        for sweep in &self.sweeps {
            cases.extend(self.cases_of(sweep)?);
        }
        let mut known = HashSet::new();
        cases.retain(|case| known.insert(definition::Case::id(case)));
        let order = each_once(cases.iter().map(|case| case.target.clone()));
        cases.sort_by_key(|case| order.iter().position(|target| *target == case.target));
        Ok(cases)
    }

    /// The cases of the base alone.
    pub fn base_cases(&self) -> Result<Vec<Case>, CommandError> {
        self.cases_of(&Settings::default())
    }

    /// The rivals on the targets of the base.
    pub fn rival_cases(&self) -> Result<Vec<Case>, CommandError> {
        let mut cases: Vec<Case> = Vec::new();
        for case in self.base_cases()? {
            for rival in &self.rivals {
                let rival = Some(rival.clone());
                let case = Case { rival, ..case.clone() };
                if !cases
                    .iter()
                    .any(|known| definition::Case::id(known) == definition::Case::id(&case))
                {
                    cases.push(case);
                }
            }
        }
        Ok(cases)
    }

    /// The cases of one table.
    pub fn cases_of(&self, sweep: &Settings) -> Result<Vec<Case>, CommandError> {
        let base = &self.base;
        let field = sweep
            .name
            .as_ref()
            .map_or("base".to_owned(), |name| format!("case.{name}"));
        let lists = Lists { field: &field };
        let targets = lists.given("targets", &sweep.targets, &base.targets)?;
        let materials = lists.given("materials", &sweep.materials, &base.materials)?;
        for material in materials {
            material
                .material()
                .map_err(|error| lists.refusal("materials", error.to_string()))?;
        }
        let schedules = lists.given("schedules", &sweep.schedules, &base.schedules)?;
        if let Some(fault) = schedules.iter().find_map(|schedule| schedule.fault()) {
            return Err(lists.refusal("schedules", fault));
        }
        let frictions = lists.given("frictions", &sweep.frictions, &base.frictions)?;
        if let Some(value) = frictions.iter().find(|value| !(**value >= 0.0 && value.is_finite())) {
            return Err(lists.refusal("frictions", format!("{value} must be a number of at least 0")));
        }
        let variants = lists.given("variants", &sweep.variants, &base.variants)?;
        let scores = lists.given("scores", &sweep.scores, &base.scores)?;
        let volumes = lists.given("volumes", &sweep.volumes, &base.volumes)?;
        let first = Case {
            target: targets[0].clone(),
            body: Body {
                algorithm: 1,
                variant: variants[0],
                material: materials[0],
                schedule: schedules[0],
                score: scores[0],
                volumes: volumes[0],
                friction: frictions[0],
                spacing: None,
                time_step: None,
            },
            rival: None,
            steps: 1,
            particles: 2,
            seed: 0,
        };
        let cases = &mut vec![first];
        vary(cases, targets, |case, target| case.target = target.clone());
        vary(cases, materials, |case, material| case.body.material = *material);
        vary(cases, schedules, |case, schedule| case.body.schedule = *schedule);
        vary(cases, frictions, |case, friction| case.body.friction = *friction);
        vary(cases, scores, |case, score| case.body.score = *score);
        vary(cases, volumes, |case, volumes| case.body.volumes = *volumes);
        let spacings = lists.positive("spacings", &sweep.spacings, &base.spacings)?;
        vary(cases, &spacings, |case, spacing| case.body.spacing = *spacing);
        let time_steps = lists.positive("time-steps", &sweep.time_steps, &base.time_steps)?;
        vary(cases, &time_steps, |case, time_step| case.body.time_step = *time_step);
        vary(
            cases,
            lists.given("steps", &sweep.steps, &base.steps)?,
            |case, steps| case.steps = steps.get(),
        );
        vary(
            cases,
            lists.given("particles", &sweep.particles, &base.particles)?,
            |case, count| case.particles = count.get(),
        );
        vary(cases, variants, |case, variant| case.body.variant = *variant);
        let algorithms = lists.given("algorithms", &sweep.algorithms, &base.algorithms)?;
        vary(cases, algorithms, |case, algorithm| {
            case.body.algorithm = algorithm.get()
        });
        vary(cases, lists.given("seeds", &sweep.seeds, &base.seeds)?, |case, seed| {
            case.seed = *seed
        });
        distinct(&field, cases)?;
        Ok(std::mem::take(cases))
    }

    fn check(&self) -> Result<(), CommandError> {
        positive("start-sd", &[self.start_sd])?;
        positive("reach", &[self.reach])?;
        if !self.start_mean.is_finite() {
            return Err(refusal("start-mean", format!("{} must be finite", self.start_mean)));
        }
        if self.base.name.is_some() {
            return Err(refusal("base.name", "belongs into a case"));
        }
        let mut names = HashSet::new();
        for (index, sweep) in self.sweeps.iter().enumerate() {
            match &sweep.name {
                None => return Err(refusal(&format!("case[{index}].name"), "is missing")),
                Some(name) if !names.insert(name) => {
                    return Err(refusal(
                        &format!("case[{index}].name"),
                        format!("two cases are `{name}`"),
                    ));
                }
                Some(_) => {}
            }
        }
        Ok(())
    }

    /// All seeds, for the manifest.
    pub fn all_seeds(&self) -> Vec<u64> {
        let all = self
            .sweeps
            .iter()
            .chain([&self.base])
            .filter_map(|settings| settings.seeds.as_ref());
        let mut seeds: Vec<u64> = all.flatten().copied().collect();
        seeds.sort_unstable();
        seeds.dedup();
        seeds
    }

    /// In the target's own coordinates, where the energy distance to a Gaussian is exact.
    pub fn yardstick(&self) -> YardstickOptions {
        YardstickOptions {
            directions: self.directions.get(),
            ..YardstickOptions::of_energy(self.reference_points.get(), self.reference_seed, Coordinates::Own)
        }
    }
}
