//! Output, probes and validation.

use crate::scene::Scene;
use crate::values::{positive, vector};
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
            if self.time.end / interval > MOST_OUTPUTS {
                let expected = format!("at least time.end / {MOST_OUTPUTS}");
                return Err(SceneFault::value(field, interval, expected));
            }
        }
        for (index, probe) in self.probes.iter().enumerate() {
            let field = |key: &str| format!("probes[{index}].{key}");
            let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
            let twice = self.probes[..index].iter().any(|other| other.name == probe.name);
            if probe.name.is_empty() || !probe.name.chars().all(plain) || twice {
                let expected = "a name of its own of letters, digits, - and _";
                return Err(SceneFault::value(field("name"), &probe.name, expected));
            }
            match (&probe.at, &probe.region) {
                (Some(at), None) => drop(vector::<D>(&field("at"), at)?),
                (None, Some(region)) => drop(shape::build::<D>(&field("region"), region)?),
                _ => {
                    return Err(SceneFault::value(
                        field("at"),
                        &probe.at,
                        "given unless region is, not beside it",
                    ));
                }
            }
            self.check_body_name(field("body"), probe.body.as_ref())?;
            if let Some(share) = probe.share
                && !(share > 0.0 && share <= 1.0)
            {
                return Err(SceneFault::value(field("share"), share, "in (0, 1]"));
            }
        }
        match &self.validation {
            Some(validation) => reference::check(&validation.reference, self),
            None => Ok(()),
        }
    }
}
