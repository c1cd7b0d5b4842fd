//! A method and its rivals, each with the same task: what studies share that hold the one against the others.

use std::path::PathBuf;

use super::prelude::*;
use super::start_law::StartLaw;

/// The method that sets the task, or a rival.
#[derive(Clone, Debug)]
pub struct Contestant {
    /// What its file begins with, the same for all of one task.
    pub task: String,
    /// The target.
    pub target: TargetSpecification,
    /// M.
    pub particles: usize,
    /// 0 for the method that sets the task, then its rivals.
    pub index: usize,
    /// The method.
    pub method: MethodSpecification,
    /// Where its particles begin; `None`: where its own options say.
    pub start: Option<StartLaw>,
}

impl Contestant {
    /// The cases of one task, whose names begin with a word: the method first, then its rivals.
    ///
    /// # Errors
    /// A target that there is not.
    pub fn all(
        (name, task): (&str, &str),
        (target, particles): (&TargetSpecification, usize),
        methods: (&MethodSpecification, &[MethodSpecification]),
    ) -> Result<Vec<Case<Self>>, CommandError> {
        let dim = target.dimension()?;
        let case = |(index, method): (usize, &MethodSpecification)| {
            let contestant = Self {
                task: task.to_owned(),
                target: target.clone(),
                particles,
                index,
                method: method.clone(),
                start: None,
            };
            // A rival gets many runs, the method those that set the task.
            let cost = if index == 0 { 1.0 } else { 10.0 };
            let case = Case::new(format!("{name}-m{particles}-{}", method.label()), contestant).by(method);
            let case = case.with("target", target.label()).with("dim", dim);
            case.with("particles", particles).costing(cost)
        };
        let methods = std::iter::once(methods.0).chain(methods.1);
        Ok(methods.enumerate().map(case).collect())
    }

    /// Its runs, as far as they have been made: none of one that has nothing to be held against.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn trials(&self, directory: &StudyDirectory, columns: &str) -> Result<Vec<Row>, CommandError> {
        let file = self.file(directory);
        if !file.exists() {
            return Ok(Vec::new());
        }
        row_file::read(&file, columns)
    }

    /// The method that sets its task.
    pub fn first(&self, method: &MethodSpecification) -> Self {
        Self {
            index: 0,
            method: method.clone(),
            ..self.clone()
        }
    }

    /// The file of its runs.
    pub fn file(&self, directory: &StudyDirectory) -> PathBuf {
        let Self {
            task, index, method, ..
        } = self;
        directory.raw(&format!("{task}-{index}-{}.csv", method.name))
    }
}

/// What the row of a case says of its task.
const TASK: [&str; 5] = ["target", "dim", "particles", "method", "energy_level"];

/// The contestants of a study that have rows, each with its runs, which say what their case is of.
///
/// # Errors
/// A file that cannot be read.
pub fn runs_of<S: Study<Work = Contestant>>(
    study: &S,
    rows: &Rows<'_>,
    directory: &StudyDirectory,
    columns: &str,
) -> Result<Vec<(Contestant, Vec<Row>)>, CommandError> {
    let mut known = Vec::new();
    for case in study.cases()? {
        if let Some(row) = rows.with("case", case.id()).first() {
            let told = |trial, column| Row::with(trial, column, row.value(column).clone());
            let of_case = |trial: Row| completed(&TASK.into_iter().fold(trial, told));
            let trials = case.work.trials(directory, columns)?.into_iter().map(of_case);
            known.push((case.work, trials.collect()));
        }
    }
    Ok(known)
}

/// The rows of searches with what tables say of them: what they `took`, in a column of this name, their `time`, its `ratio` to that of the method that set the
/// task – from the last that missed to the first that reached, where both are known, and as a bound where none did – and how they `ended`.
pub fn told(rows: &Rows<'_>, own: &str, column: &str) -> Vec<Row> {
    let told = |row: &Row| {
        let is_reached = row.status() == Status::Reached;
        let of_task = |other: &Row| TASK[..3].iter().all(|column| other.value(column) == row.value(column));
        let first = rows.with("method", own).having(of_task).first();
        let clock = first.filter(|first| first.status() == Status::Reached);
        let clock = clock.and_then(|first| first.number(SECONDS));
        let times = |column: &str| row.number(column).zip(clock).map(|(seconds, clock)| seconds / clock);
        let between = |missed: Option<String>, last: Option<String>| {
            let bound = |last: String| match missed.filter(|_| is_reached) {
                Some(missed) => format!("{missed} to {last}"),
                None if is_reached => last,
                None => format!("> {last}"),
            };
            last.map(bound)
        };
        let cell = |column: &str| row.number(column).map(|_| row.value(column).cell());
        let ratio = |column: &str| times(column).map(number);
        let ended = match row.status() {
            Status::OutOfSizes => "largest number missed".to_owned(),
            ending => ending.to_string().replace('-', " "),
        };
        row.clone()
            .with("took", between(cell("missed_size"), cell(column)))
            .with("time", between(None, cell(SECONDS)))
            .with("times", times(SECONDS))
            .with("ratio", between(ratio("wall_seconds_missed"), ratio(SECONDS)))
            .with("ended", ended)
    };
    rows.iter().map(told).collect()
}
