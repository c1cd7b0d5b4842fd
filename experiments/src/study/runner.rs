//! Runs the cases of a study that are missing and writes its report.

use std::collections::HashSet;
use std::path::Path;

use super::configuration::Configuration;
use super::definition::{Case, Study, Tools};
use super::derived;
use super::directory::StudyDirectory;
use super::manifest::{self, Manifest, Provenance};
use super::results::{self, ResultsFile};
use super::row_file;
use super::yardstick::CurrentYardstick;
use crate::output::AtomicFile;
use crate::plots::results::Row;
use crate::progress::Bar;
use crate::{CommandError, console, interrupt};

/// The page that a study ends with.
const REPORT: &str = "report.md";

/// Runs a study into a directory, or the rest of it.
pub fn run<S: Study>(configuration: &Configuration, out: &Path) -> Result<(), CommandError> {
    let mut study: S = configuration.parse()?;
    let located = |error| in_file(error, configuration);
    study.open(Path::new(&configuration.file)).map_err(located)?;
    let cases = study.cases().map_err(located)?;
    for method in study.methods() {
        method.check_built()?;
    }
    let directory = StudyDirectory::claim(out, configuration)?;
    in_threads(configuration.threads(), || {
        let mut results = ResultsFile::open(&directory.file(results::FILE_NAME), S::COLUMNS)?;
        study.check_earlier(results.rows()).map_err(located)?;
        note_start::<S>(&cases, configuration, &directory)?;
        run_missing(&study, &cases, &directory, &mut results).map_err(located)?;
        write_report(&study, results.rows(), &directory)
    })
}

/// Writes the report of what a directory holds.
pub fn report<S: Study>(configuration: &Configuration, directory: &StudyDirectory) -> Result<(), CommandError> {
    let study: S = configuration.parse()?;
    let rows = row_file::read(&directory.file(results::FILE_NAME), S::COLUMNS)?;
    in_threads(configuration.threads(), || write_report(&study, &rows, directory))
}

/// Names the file in errors about fields.
fn in_file(error: CommandError, configuration: &Configuration) -> CommandError {
    match error {
        CommandError::ConfigField { field, message, .. } => CommandError::ConfigField {
            file: configuration.file.clone(),
            field,
            message,
        },
        error => error,
    }
}

fn in_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, CommandError> + Send,
) -> Result<T, CommandError> {
    let Some(threads) = threads else { return work() };
    rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(|error| CommandError::Threads {
            threads,
            reason: error.to_string(),
        })?
        .install(work)
}

/// Writes the manifest, or adds this start to it. Seeds that the configuration does not say are those of the cases.
fn note_start<S: Study>(
    cases: &[Case<S::Work>],
    configuration: &Configuration,
    directory: &StudyDirectory,
) -> Result<(), CommandError> {
    let threads = rayon::current_num_threads();
    let path = directory.file(manifest::FILE_NAME);
    let manifest = if path.exists() {
        let mut manifest = Manifest::read(&path)?;
        manifest.resumed.push(Provenance::now(threads));
        manifest
    } else {
        let mut seeds = configuration.seeds.clone();
        if seeds.is_empty() {
            let of_cases = cases.iter().filter_map(|case| case.row.count("seed"));
            seeds.extend(of_cases.map(|seed| seed as u64));
            seeds.sort_unstable();
            seeds.dedup();
        }
        Manifest::new(S::KIND, &configuration.hash, seeds, threads)
    };
    manifest.write(&path)
}

fn run_missing<S: Study>(
    study: &S,
    cases: &[Case<S::Work>],
    directory: &StudyDirectory,
    results: &mut ResultsFile,
) -> Result<(), CommandError> {
    let finished: HashSet<String> = results.rows().iter().map(|row| row.case().to_owned()).collect();
    let (done, missing): (Vec<_>, Vec<_>) = cases.iter().partition(|case| finished.contains(case.id()));
    let cost = |cases: &[&Case<S::Work>]| cases.iter().map(|case| case.cost).sum::<f64>();
    let mut progress = Bar::of_study(cost(&done) + cost(&missing), cost(&done));
    let mut yardstick = CurrentYardstick::default();
    for case in missing {
        let mut row = case.row.clone();
        progress.begin(case.id(), case.cost);
        let tools = Tools {
            yardstick: &mut yardstick,
            directory,
            observer: &mut progress,
        };
        let stopped = interrupt::requested();
        let result = if stopped {
            Ok(())
        } else {
            study.run(case, &mut row, tools)
        };
        let interrupted = stopped || result.as_ref().is_err_and(CommandError::is_interruption);
        if interrupted || result.is_err() {
            progress.clear();
        }
        if interrupted {
            let (done, all) = (results.rows().len(), cases.len());
            let hint = format!(": {done} of {all} cases are kept; the same command resumes with the next one");
            return Err(CommandError::Interrupted { hint });
        }
        result?;
        results.append(&row)?;
    }
    progress.clear();
    Ok(())
}

fn write_report<S: Study>(study: &S, rows: &[Row], directory: &StudyDirectory) -> Result<(), CommandError> {
    let completed: Vec<Row> = rows.iter().map(derived::completed).collect();
    let mut page = (S::REPORT)(study, &completed.iter().collect(), directory)?;
    let manifest = Manifest::read(&directory.file(manifest::FILE_NAME))?;
    page.heading("Provenance");
    page.paragraph(provenance(&manifest, rows.len(), study.cases()?.len()));
    for (name, svg) in &page.figures {
        AtomicFile::write(directory.figure(name), svg)?;
    }
    AtomicFile::write(directory.file(REPORT), &page.text)?;
    let mut pairs = vec![("study", S::KIND.to_owned())];
    pairs.extend(page.summary);
    pairs.push(("report", directory.file(REPORT).display().to_string()));
    console::print_pairs(&pairs)
}

/// How the figures came about, in words.
fn provenance(manifest: &Manifest, rows: usize, cases: usize) -> String {
    let first = &manifest.first;
    let unknown = "unknown".to_owned();
    let dirty = match first.dirty {
        Some(true) => " with uncommitted changes",
        _ => "",
    };
    let mut text = format!(
        "{rows} of {cases} cases. Commit {}{dirty}, {}, {} threads on {}, started {}, configuration {}.",
        first.commit.as_ref().unwrap_or(&unknown),
        first.rustc,
        first.threads,
        first.cpu.as_ref().unwrap_or(&unknown),
        first.started,
        manifest.config_hash,
    );
    if !manifest.is_uniform() {
        text.push_str(
            " **Parts of these results were computed by another commit, compiler, processor or number of threads; \
             manifest.json lists them all.**",
        );
    }
    text
}
