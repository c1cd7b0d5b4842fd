//! Runs the cases of a study that are missing and writes its report.

use std::collections::HashSet;
use std::path::Path;

use parvi::SampleError;
use parvi_files::AtomicFile;
use rayon::{ThreadPoolBuildError, ThreadPoolBuilder};

use super::attempt::of_reference;
use super::checks::holds;
use super::configuration::Configuration;
use super::definition::{Case, Study, Tools};
use super::derived;
use super::directory::StudyDirectory;
use super::manifest::{self, Manifest};
use super::results::{self, ResultsFile};
use super::row::RunRow;
use super::yardstick::CurrentYardstick;
use crate::plots::page::counted;
use crate::plots::results::Row;
use crate::progress::Bar;
use crate::provenance::Provenance;
use crate::{CommandError, console, interrupt};

/// The page that a study ends with.
const REPORT: &str = "report.md";

/// Runs a study into a directory, or the rest of it.
pub fn run<S: Study>(configuration: &Configuration, out: &Path) -> Result<(), CommandError> {
    let mut study: S = configuration.parse()?;
    let located = |error| in_file(error, configuration);
    study.open(Path::new(&configuration.file)).map_err(located)?;
    let cases = due(&study).map_err(located)?;
    let none = || "leaves no case: it is below the `particles` of every one".to_owned();
    holds(!cases.is_empty(), "largest-particles", none).map_err(located)?;
    if let Some(feature) = cases.iter().find_map(|case| case.lacks) {
        return Err(SampleError::NotBuilt {
            method: feature,
            feature,
        }
        .into());
    }
    let directory = StudyDirectory::claim(out, configuration)?;
    in_threads(configuration.threads(), || {
        let (results, rows) = ResultsFile::open(&directory.file(results::FILE_NAME), S::COLUMNS)?;
        study.check_earlier(&rows).map_err(located)?;
        let kept: HashSet<&str> = rows.iter().map(Row::case).collect();
        if cases.iter().any(|case| !kept.contains(case.id())) {
            results.takes_rows()?;
        }
        note_start::<S>(&cases, configuration, &directory).map_err(located)?;
        run_missing(&study, &cases, &directory, results, &rows).map_err(located)?;
        write_report(&study, &directory).map_err(located)
    })
}

/// Writes the report of what a directory holds.
pub fn report<S: Study>(configuration: &Configuration, directory: &StudyDirectory) -> Result<(), CommandError> {
    let study: S = configuration.parse()?;
    let report = || write_report(&study, directory).map_err(|error| in_file(error, configuration));
    in_threads(configuration.threads(), report)
}

/// The cases that run.
fn due<S: Study>(study: &S) -> Result<Vec<Case<S::Work>>, CommandError> {
    Ok(study.cases()?.into_iter().filter(Case::is_due).collect())
}

/// Names the file in errors about fields.
fn in_file(mut error: CommandError, configuration: &Configuration) -> CommandError {
    if let CommandError::ConfigField { file, .. } = &mut error {
        file.clone_from(&configuration.file);
    }
    error
}

fn in_threads<T: Send>(
    threads: Option<usize>,
    work: impl FnOnce() -> Result<T, CommandError> + Send,
) -> Result<T, CommandError> {
    let Some(threads) = threads else { return work() };
    let refused = |error: ThreadPoolBuildError| {
        CommandError::Refused(format!("cannot start {}: {error}", counted(threads, "threads")))
    };
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(refused)?.install(work)
}

/// Writes the manifest, or adds this start to it. Seeds that the configuration does not say are those of the cases. A study is refused if data files of its targets, or files that the commands of their programs name, have changed since it began.
fn note_start<S: Study>(
    cases: &[Case<S::Work>],
    configuration: &Configuration,
    directory: &StudyDirectory,
) -> Result<(), CommandError> {
    let threads = rayon::current_num_threads();
    let path = directory.file(manifest::FILE_NAME);
    let data = configuration.target_fingerprints()?;
    let manifest = if path.exists() {
        let mut manifest = Manifest::read(&path)?;
        for (file, now) in data {
            let before = manifest.data.entry(file.clone()).or_insert_with(|| now.clone());
            let changed = || format!("{file} has changed since this study began; choose another --out");
            holds(*before == now, "targets.parameters", changed)?;
        }
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
        Manifest {
            data,
            ..Manifest::new(S::KIND, &configuration.hash, seeds, threads)
        }
    };
    manifest.write(&path)
}

fn run_missing<S: Study>(
    study: &S,
    cases: &[Case<S::Work>],
    directory: &StudyDirectory,
    mut results: ResultsFile,
    earlier: &[Row],
) -> Result<(), CommandError> {
    let finished: HashSet<&str> = earlier.iter().map(Row::case).collect();
    let (done, missing): (Vec<_>, Vec<_>) = cases.iter().partition(|case| finished.contains(case.id()));
    let cost = |cases: &[&Case<S::Work>]| cases.iter().map(|case| case.cost).sum::<f64>();
    let mut progress = Bar::of_study(cost(&done) + cost(&missing), cost(&done));
    let mut yardstick = CurrentYardstick::default();
    let mut kept = earlier.len();
    let mut run = |case: &Case<S::Work>| {
        let mut row = case.row.clone();
        progress.begin(case.id(), case.cost);
        if interrupt::requested() {
            return Err(CommandError::Interrupted(String::new()));
        }
        let tools = Tools {
            yardstick: &mut yardstick,
            directory,
            observer: &mut progress,
        };
        if let Err(failure) = of_reference(study.run(case, &mut row, tools))? {
            row.set("ending", failure.status);
            row.fail(failure);
        }
        kept += 1;
        results.append(&row)
    };
    let result = missing.into_iter().try_for_each(&mut run);
    progress.clear();
    let all = counted(cases.len(), "cases");
    let hint = format!(": {kept} of {all} kept; the same command resumes with the next one");
    result.map_err(|error| match error.is_interruption() {
        true => CommandError::Interrupted(hint),
        false => error,
    })
}

fn write_report<S: Study>(study: &S, directory: &StudyDirectory) -> Result<(), CommandError> {
    let rows = results::read(&directory.file(results::FILE_NAME), S::COLUMNS)?;
    let completed: Vec<Row> = rows.iter().map(derived::completed).collect();
    let mut page = (S::REPORT)(study, &completed.iter().collect(), directory)?;
    let manifest = Manifest::read(&directory.file(manifest::FILE_NAME))?;
    page.heading("Provenance");
    page.paragraph(provenance(&manifest, rows.len(), due(study)?.len()));
    for (name, svg) in &page.figures {
        AtomicFile::write(directory.figure(name), svg)?;
    }
    AtomicFile::write(directory.file(REPORT), &page.text)?;
    let mut pairs = vec![("study", S::KIND.into())];
    let summary = page.summary.iter();
    pairs.extend(summary.map(|(key, value)| (key.as_str(), value.as_str().into())));
    pairs.push(("report", directory.file(REPORT).display().to_string().into()));
    console::print_pairs(&pairs)
}

/// How the figures came about, in words.
fn provenance(manifest: &Manifest, rows: usize, cases: usize) -> String {
    let first = &manifest.first;
    let [commit, cpu] = [&first.commit, &first.cpu].map(|known| known.as_deref().unwrap_or("unknown"));
    let dirty = first.dirty.filter(|dirty| *dirty);
    let dirty = dirty.map_or("", |_| " with uncommitted changes");
    let (rustc, started, hash) = (&first.rustc, &first.started, &manifest.config_hash);
    let [cases, threads] = [(cases, "cases"), (first.threads, "threads")].map(|(count, many)| counted(count, many));
    let mut text = format!(
        "{rows} of {cases}. Commit {commit}{dirty}, {rustc}, {threads} on {cpu}, started {started}, configuration {hash}."
    );
    if !manifest.is_uniform() {
        text.push_str(
            " **Parts of these results were computed by another commit, compiler, processor or number of threads; \
             manifest.json lists them all.**",
        );
    }
    text
}
