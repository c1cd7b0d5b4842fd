//! Runs one case: the method itself, or the search of a rival.

use super::row::Row;
use super::runs::{Goal, OWN, Runs};
use super::search::{Ending, Medians, Trial};
use super::{Case, TimeToEqualError};
use crate::CommandError;
use crate::options::MethodName;
use crate::output::table_file;
use crate::progress::CaseObserver;
use crate::study::attempt::{Attempt, Status};
use crate::study::directory::StudyDirectory;
use crate::study::yardstick::Yardstick;

/// Runs a case and writes its runs beside the results.
pub fn run(
    study: &TimeToEqualError,
    case: &Case,
    yardstick: &dyn Yardstick,
    directory: &StudyDirectory,
    observer: &mut CaseObserver,
) -> Result<Row, CommandError> {
    let mut row = Row::new(case, yardstick.mean_distance())?;
    let mut runs = Runs {
        study,
        case,
        yardstick,
        observer,
        trials: Vec::new(),
    };
    let found = if case.index == 0 {
        runs.own()?
    } else {
        match goal(study, case, directory)? {
            None => unsupported("the method that sets the error has none above 0"),
            Some(goal) => {
                row.goal = Some(goal.energy_distance_squared);
                runs.trials = earlier_trials(study, case, directory)?;
                match case.method.name {
                    MethodName::Iid => runs.independent(goal)?,
                    _ => runs.search(goal)?,
                }
            }
        }
    };
    table_file::write(&runs.trials, &case.trials_file(directory))?;
    match found {
        Attempt::Finished(found) => {
            row.ending = found.ending;
            row.take(&found.last);
            if let Some(missed) = &found.missed {
                row.missed(missed);
            }
        }
        Attempt::Failed(_, reason) => (row.ending, row.reason) = (Ending::Unsupported, reason),
    }
    Ok(row)
}

fn unsupported<T>(reason: &str) -> Attempt<T> {
    Attempt::Failed(Status::Unsupported, reason.to_owned())
}

/// What the method reached on the target of a rival's case; `None` unless it is a positive number.
fn goal(study: &TimeToEqualError, case: &Case, directory: &StudyDirectory) -> Result<Option<Goal>, CommandError> {
    let own = Case {
        index: 0,
        method: study.method.clone(),
        ..case.clone()
    };
    let trials: Vec<Trial> = table_file::read(&own.trials_file(directory))?;
    if trials.is_empty() {
        return Ok(None);
    }
    let medians = Medians::of(&trials, OWN)?;
    let energy_distance_squared = medians.energy_distance_squared;
    Ok(
        (energy_distance_squared.is_finite() && energy_distance_squared > 0.0).then_some(Goal {
            energy_distance_squared,
            seconds: medians.seconds(),
        }),
    )
}

/// The runs of the same rival for smaller M: draws do not depend on it, so they are not made twice.
fn earlier_trials(
    study: &TimeToEqualError,
    case: &Case,
    directory: &StudyDirectory,
) -> Result<Vec<Trial>, CommandError> {
    let mut trials: Vec<Trial> = Vec::new();
    if case.method.name.iterates() {
        return Ok(trials);
    }
    for particles in study.particles.iter().map(|particles| particles.get()) {
        if particles == case.particles {
            break;
        }
        let earlier = Case {
            particles,
            ..case.clone()
        };
        let known: Vec<Trial> = table_file::read(&earlier.trials_file(directory))?;
        if known.len() > trials.len() {
            trials = known;
        }
    }
    Ok(trials)
}
