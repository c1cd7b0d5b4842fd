//! The configuration of the study `stability`.

use parvi_targets::{Dimensions, catalogue, target_info};
use serde::Deserialize;

use super::draw::{Case, Place, draw};
use crate::CommandError;
use crate::options::{Bounded, Dimension};
use crate::study::checks::{not_empty, refusal};

/// Random configurations.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Stability {
    #[serde(rename = "kind")]
    _kind: String,
    /// Seed of all draws; case i depends on it and on i only.
    pub seed: u64,
    /// Threads; absent: as many as the environment gives.
    pub threads: Option<Bounded<1, 1024>>,
    /// The number of configurations.
    pub cases: Bounded<1, 10_000_000>,
    /// Dimensions; of each target those that it has.
    pub dims: Vec<Dimension>,
    /// Names of targets; absent: every target of the catalogue that needs no data file.
    pub targets: Option<Vec<String>>,
}

impl Stability {
    /// The cases, in the order of their numbers.
    pub fn all_cases(&self) -> Result<Vec<Case>, CommandError> {
        let places = self.places()?;
        Ok((0..self.cases.get())
            .map(|index| draw(self.seed, index, &places))
            .collect())
    }

    /// The targets with the dimensions that they have among `dims`.
    fn places(&self) -> Result<Vec<Place>, CommandError> {
        not_empty("dims", &self.dims)?;
        let names: Vec<&str> = match &self.targets {
            Some(names) => names.iter().map(String::as_str).collect(),
            None => {
                let without_data = catalogue()
                    .iter()
                    .filter(|info| info.dimensions != Dimensions::FromData);
                without_data.map(|info| info.name).collect()
            }
        };
        let mut places = Vec::new();
        for name in names {
            let info = target_info(name).map_err(|error| refusal("targets", error.to_string()))?;
            let allowed = match info.dimensions {
                Dimensions::Fixed(only) => only..=only,
                Dimensions::Range { minimum, maximum, .. } => minimum..=maximum,
                Dimensions::FromData => {
                    return Err(refusal("targets", format!("`{name}` needs a data file")));
                }
            };
            let inside = |dim: &&Dimension| allowed.contains(&dim.get());
            let dims: Vec<Dimension> = self.dims.iter().filter(inside).copied().collect();
            if !dims.is_empty() {
                let fixed = matches!(info.dimensions, Dimensions::Fixed(_));
                let name = name.to_owned();
                places.push(Place { name, dims, fixed });
            }
        }
        not_empty("targets", &places)?;
        Ok(places)
    }
}
