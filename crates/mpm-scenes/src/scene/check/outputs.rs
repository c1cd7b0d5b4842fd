//! Output, probes and validation.

use crate::scene::Scene;
use crate::values::{positive, vector, within};
use crate::{SceneFault, reference, shape};

/// Files or rows of one kind that a run may write, at most: six digits number the frames.
const MOST_OUTPUTS: f64 = 1e6;

impl Scene {
    pub(super) fn check_outputs<const D: usize>(&self) -> Result<(), SceneFault> {
        let output = &self.output;
        let intervals = [
            ("output.interval", Some(output.interval)),
            ("output.series_interval", output.series_interval),
            ("output.checkpoint_interval", output.checkpoint_interval),
        ];
        for (field, interval) in intervals {
            let Some(interval) = interval else { continue };
            positive(field, interval)?;
            let few = self.time.end / interval <= MOST_OUTPUTS;
            within(field, interval, few, &format!("at least time.end / {MOST_OUTPUTS}"))?;
        }
        for (index, probe) in self.probes.iter().enumerate() {
            let field = |key: &str| format!("probes[{index}].{key}");
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            let twice = self.probes[..index].iter().any(|other| other.name == probe.name);
            let (name, expected) = (&probe.name, "a name of its own of letters, digits, - and _");
            let own = !name.is_empty() && name.chars().all(plain) && !twice;
            within(&field("name"), name, own, expected)?;
            match (&probe.at, &probe.region) {
                (Some(at), None) => drop(vector::<D>(&field("at"), at)?),
                (None, Some(region)) => drop(shape::build::<D>(&field("region"), region)?),
                (at, _) => {
                    let table = format!("probes[{index}]");
                    return Err(SceneFault::one_of(table, ["at", "region"], at.is_some()));
                }
            }
            self.check_body_name(field("body"), probe.body.as_ref())?;
            let part = probe.share.is_none_or(|share| share > 0.0 && share <= 1.0);
            within(&field("share"), probe.share, part, "in (0, 1]")?;
            let of_many = probe.share.is_none() || probe.region.is_some();
            within(
                &field("share"),
                probe.share,
                of_many,
                "left out unless region is given: `at` is one particle",
            )?;
        }
        match &self.validation {
            Some(validation) => reference::check(&validation.reference, self),
            None => Ok(()),
        }
    }
}
