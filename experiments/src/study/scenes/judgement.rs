//! Judgements as the configuration states them.

use serde::{Deserialize, Deserializer};

use crate::plots::judgement::Judgement;

/// The judgements with the names of their parts.
#[derive(Deserialize)]
#[serde(
    remote = "Judgement",
    tag = "kind",
    deny_unknown_fields,
    rename_all = "kebab-case",
    rename_all_fields = "kebab-case"
)]
enum Stated {
    Order {
        at_least: f64,
    },
    PowerLaw {
        exponent: f64,
        tolerance: f64,
        from: Option<f64>,
        to: Option<f64>,
    },
    Spread {
        at_most: f64,
    },
    Bound {
        reference: Option<f64>,
        tolerance: Option<f64>,
        #[serde(default)]
        at: Vec<f64>,
    },
}

/// A list of them.
///
/// # Errors
/// One that there is not, or with other parts.
pub fn list<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<Judgement>, D::Error> {
    #[derive(Deserialize)]
    struct One(#[serde(with = "Stated")] Judgement);

    let list = Vec::<One>::deserialize(deserializer)?;
    Ok(list.into_iter().map(|One(judgement)| judgement).collect())
}
