//! The configuration of the study `paper`.

use std::collections::HashSet;

use parvi::{Annealing, ReferenceVolumes};
use parvi_options::MaterialTable;

use super::variant::Variant;
use crate::study::prelude::*;

/// The table of what every case has unless it says otherwise.
pub const BASE: &str = "base";
/// What stands beside it.
pub const RIVALS: &str = "rivals";

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

/// What is varied, the last fastest: the key of the list, the field of a setting, what one value is, and the value where neither a case nor the
/// base has a list.
macro_rules! axes {
    ($($(#[$meta:meta])* $key:ident => $field:ident: $type:ty $(= $absent:expr)?,)*) => {
        /// Lists of values, of which all combinations are run; absent: as in the base.
        #[derive(Clone, Debug, Default, Deserialize)]
        #[serde(deny_unknown_fields, rename_all = "kebab-case", default)]
        pub struct Settings {
            /// The name of a case.
            pub name: Option<String>,
            $($key: Option<Vec<$type>>,)*
        }

        /// A run: of a body, or of a rival.
        #[derive(Clone, Debug)]
        pub struct Setting {
            $($(#[$meta])* pub $field: $type,)*
            /// The rival, if it is one.
            pub rival: Option<MethodSpecification>,
        }

        impl Settings {
            /// All combinations; `table` is the place of the lists in errors.
            fn combinations(&self, base: &Self, table: &str) -> Result<Vec<Setting>, CommandError> {
                $(let $key = values(table, stringify!($key), [&self.$key, &base.$key], &[$($absent)?])?;)*
                let first = Setting { $($field: $key[0].clone(),)* rival: None };
                let mut all = vec![first];
                $(let with = |(setting, value): (&Setting, &$type)| Setting { $field: value.clone(), ..setting.clone() };
                all = pairs(&all, $key).map(with).collect();)*
                Ok(all)
            }
        }
    };
}

axes! {
    /// The target.
    targets => target: TargetSpecification,
    /// Ψ.
    materials => material: MaterialTable,
    /// α(t).
    schedules => schedule: Annealing,
    /// γ.
    frictions => friction: f64,
    /// Where the force acts.
    scores => score: Score,
    /// V⁰_p.
    volumes => volume: ReferenceVolumes,
    /// h in units of the coordinates; `None`: the library's default.
    spacings => spacing: Option<f64> = None,
    /// Δt; `None`: the library's default for h.
    time_steps => time_step: Option<f64> = None,
    /// T.
    steps => steps: StepCount,
    /// M.
    particles => particles: ParticleCount,
    /// Guards and coordinates.
    variants => variant: Variant,
    /// 1 (PIC) or 2 (APIC).
    algorithms => algorithm: Bounded<1, 2>,
    /// Seed of the run.
    seeds => seed: u64,
}

/// The values of a list: those of the case, else of the base, else those for an absent one, if there are any.
fn values<'a, T>(
    table: &str,
    key: &str,
    lists: [&'a Option<Vec<T>>; 2],
    absent: &'a [T],
) -> Result<&'a [T], CommandError> {
    let field = format!("{table}.{}", key.replace('_', "-"));
    let given = lists.into_iter().find_map(Option::as_ref);
    let is_known = given.is_some() || !absent.is_empty();
    holds(is_known, &field, || "is missing, also in the base".to_owned())?;
    let values = given.map_or(absent, Vec::as_slice);
    not_empty(&field, values)?;
    Ok(values)
}

/// Every setting with each of the values.
fn pairs<'a, T>(settings: &'a [Setting], values: &'a [T]) -> impl Iterator<Item = (&'a Setting, &'a T)> {
    let of = move |setting| values.iter().map(move |value| (setting, value));
    settings.iter().flat_map(of)
}

impl Paper {
    /// All cases, each once, target by target, so that a target's reference is made once.
    pub fn all_cases(&self) -> Result<Vec<Setting>, CommandError> {
        let tables = self.tables()?.into_iter();
        let mut cases = each_once(tables.flat_map(|(_, cases)| cases).collect());
        let targets: Vec<TargetSpecification> = cases.iter().map(|case| case.target.clone()).collect();
        cases.sort_by_key(|case| targets.iter().position(|target| *target == case.target));
        Ok(cases)
    }

    /// The cases by their tables: the base, the rivals on its targets, and every case of the configuration by its name.
    pub fn tables(&self) -> Result<Vec<(&str, Vec<Setting>)>, CommandError> {
        self.check()?;
        let base = self.cases_of(&Settings::default())?;
        let against = |(case, rival): (&Setting, &MethodSpecification)| Setting {
            rival: Some(rival.clone()),
            ..case.clone()
        };
        let rivals = each_once(pairs(&base, &self.rivals).map(against).collect());
        let mut tables = vec![(BASE, base), (RIVALS, rivals)];
        for sweep in &self.sweeps {
            tables.push((sweep.name.as_deref().unwrap_or_default(), self.cases_of(sweep)?));
        }
        Ok(tables)
    }

    /// The cases of one table.
    fn cases_of(&self, sweep: &Settings) -> Result<Vec<Setting>, CommandError> {
        let name = |name: &String| format!("case.{name}");
        let table = sweep.name.as_ref().map_or("base".to_owned(), name);
        let settings = sweep.combinations(&self.base, &table)?;
        for setting in &settings {
            setting.check(&table)?;
        }
        distinct_names(&table, settings.iter().map(Setting::id))?;
        Ok(settings)
    }

    fn check(&self) -> Result<(), CommandError> {
        positive("start-sd", &[self.start_sd])?;
        positive("reach", &[self.reach])?;
        finite("start-mean", self.start_mean)?;
        holds(self.base.name.is_none(), "base.name", || {
            "belongs into a case".to_owned()
        })?;
        let mut names = HashSet::new();
        for (index, sweep) in self.sweeps.iter().enumerate() {
            let field = format!("case[{index}].name");
            let name = sweep.name.as_ref().ok_or_else(|| refusal(&field, "is missing"))?;
            holds(names.insert(name), &field, || format!("two cases are `{name}`"))?;
        }
        Ok(())
    }

    /// In the target's own coordinates, where the energy distance to a Gaussian is exact.
    pub fn yardstick(&self) -> YardstickOptions {
        let (points, seed) = (self.reference_points.get(), self.reference_seed);
        YardstickOptions::of_energy(points, seed, Coordinates::Own).over(self.directions.get())
    }
}

impl Setting {
    /// Refuses a value out of its range; `table` is the place of its list.
    fn check(&self, table: &str) -> Result<(), CommandError> {
        let field = |key: &str| format!("{table}.{key}");
        let (material, schedule) = (self.material.material(), self.schedule.of_either_sign());
        material.map_err(|error| refusal(&field("materials"), error.to_string()))?;
        schedule.map_err(|error| refusal(&field("schedules"), error.to_string()))?;
        let is_friction = self.friction >= 0.0 && self.friction.is_finite();
        let otherwise = || format!("{} must be a number of at least 0", self.friction);
        holds(is_friction, &field("frictions"), otherwise)?;
        positive(&field("spacings"), self.spacing.as_slice())?;
        positive(&field("time-steps"), self.time_step.as_slice())
    }
}

/// The settings, of those with the same name only the first.
fn each_once(mut settings: Vec<Setting>) -> Vec<Setting> {
    let mut known = HashSet::new();
    settings.retain(|setting| known.insert(setting.id()));
    settings
}
