//! `parvi targets`: the catalogue.

use parvi_targets::{TargetInfo, catalogue};

use crate::{CommandError, console};

/// Lists names, dimensions, parameters with defaults, and what is known.
pub fn execute() -> Result<(), CommandError> {
    let width = catalogue().iter().map(|info| info.name.len()).max().unwrap_or(0);
    let entries: Vec<String> = catalogue().iter().map(|info| entry(info, width)).collect();
    console::print(&entries.join("\n"))
}

fn entry(info: &TargetInfo, width: usize) -> String {
    let indent = " ".repeat(width + 2);
    let mut text = format!("{:width$}  {}\n", info.name, info.summary);
    text.push_str(&format!("{indent}dimension: {}\n", info.dimensions.in_words()));
    for parameter in info.parameters {
        let (name, meaning, default) = (parameter.name, parameter.meaning, parameter.default);
        let default = default.map_or("required".to_owned(), |value| format!("[{value}]"));
        text.push_str(&format!("{indent}--{name} {default}: {meaning}\n"));
    }
    let modes = format!("{} modes with their masses", info.modes);
    let facts = [
        (info.exact_draws, "exact draws"),
        (info.unit_cube_transport, "quasi-random draws"),
        (info.moments, "moments"),
        (!info.moments, "moments by importance sampling"),
        (info.modes > 1, &modes),
        (info.log_evidence, "log evidence"),
    ];
    let known = facts.iter().filter_map(|(known, fact)| known.then_some(*fact));
    let known: Vec<&str> = known.collect();
    text.push_str(&format!("{indent}known: {}\n", known.join(", ")));
    text
}
