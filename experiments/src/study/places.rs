//! Targets in all the dimensions that they have.

use parvi_options::{Dimension, TargetParameters, TargetSpecification};
use parvi_targets::{Dimensions, TargetError, TargetInfo, target_info};
use serde::Deserialize;

use super::checks::{holds, not_empty, refusal};
use crate::CommandError;

/// A target in all its dimensions: `{ name = "gaussian", parameters = { correlation = 0.9 } }`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Place {
    /// The name in the catalogue.
    name: String,
    /// The parameters.
    #[serde(default)]
    parameters: TargetParameters,
}

impl Place {
    /// A target with its default parameters.
    pub fn plain(name: &str) -> Self {
        Self {
            name: name.to_owned(),
            parameters: TargetParameters::default(),
        }
    }

    /// The target in each of its dimensions that is among `dims`.
    fn among(&self, dims: &[Dimension]) -> Result<Vec<TargetSpecification>, CommandError> {
        let refused = |error: TargetError| refusal("targets", error.to_string());
        let dimensions = target_info(&self.name).map_err(refused)?.dimensions;
        let mut found = Vec::new();
        for &dim in dims {
            let mut here = TargetSpecification {
                name: self.name.clone(),
                dim: None,
                parameters: self.parameters.clone(),
            };
            if let Dimensions::Range { minimum, maximum, .. } = dimensions {
                if !(minimum..=maximum).contains(&dim.get()) {
                    continue;
                }
                here.dim = Some(dim);
            }
            if here.dimension().map_err(refused)? == dim.get() {
                found.push(here);
            }
        }
        Ok(found)
    }
}

/// Targets, each in those of its dimensions that are among `dims`; without a list all of the catalogue that have one and need nothing that a user brings.
///
/// # Errors
/// A target that there is not, that has none of the dimensions, or parameters that it does not have.
pub fn places(listed: Option<&[Place]>, dims: &[Dimension]) -> Result<Vec<Vec<TargetSpecification>>, CommandError> {
    not_empty("dims", dims)?;
    let Some(listed) = listed else {
        let own = |info: &&TargetInfo| info.parameters.iter().all(|parameter| parameter.default.is_some());
        let all = parvi_targets::catalogue().iter().filter(own);
        let all = all.map(|info| Place::plain(info.name).among(dims));
        let mut places = all.collect::<Result<Vec<_>, _>>()?;
        places.retain(|place| !place.is_empty());
        return Ok(places);
    };
    not_empty("targets", listed)?;
    let place = |target: &Place| {
        let place = target.among(dims)?;
        let missed = || format!("`{}` has none of the dimensions in `dims`", target.name);
        holds(!place.is_empty(), "targets", missed).map(|()| place)
    };
    listed.iter().map(place).collect()
}
