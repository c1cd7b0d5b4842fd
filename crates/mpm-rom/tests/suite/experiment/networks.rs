//! Several networks of one experiment, and one network of several.

use super::*;

#[test]
fn variants_are_other_networks_for_the_same_data() {
    let (directory, file) = files();
    let text = EXPERIMENT
        .replace(
            "cases = {",
            "variants = [{ name = \"three\", coordinates = 3, gradient_weight = 0.0 }]\ncases = {",
        )
        .replace("samples = [20, \"all\"]", "samples = [20]");
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let out = directory.path().join("out");
    let trained = train::<2>(&experiment, &out, &mut ()).expect("trained");
    assert_eq!(
        trained.iter().map(|network| network.name.as_str()).collect::<Vec<_>>(),
        ["", "three"]
    );
    assert!(trained[1].history.iter().all(|epoch| epoch.terms.gradient == 0.0));
    assert!(out.join("three").join(names::MODEL).exists() && !out.join("three").join(names::TRAINING_DATA).exists());
    let rows = run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
    let kinds: Vec<_> = rows
        .iter()
        .map(|row| {
            (
                row.choice.manifold.name(),
                row.variant.as_str(),
                row.frames[0].latent.len(),
            )
        })
        .collect();
    let expected = [("network", "", 2), ("network", "three", 3), ("linear", "", 2)];
    assert_eq!(kinds, expected.iter().flat_map(|&kind| [kind; 2]).collect::<Vec<_>>());
    // A model must not be run under the name of a variant that it was not trained as.
    let mut other = experiment.clone();
    other.variants[0]
        .changes
        .insert("coordinates".to_owned(), toml::Value::Integer(1));
    assert!(matches!(
        run::<2>(&other, &out, &mut |_, _| true),
        Err(ExperimentError::Occupied { .. })
    ));
    // The main network is that of an experiment without variants.
    let alone = Experiment::parse(EXPERIMENT, &file).expect("sound");
    let other = directory.path().join("other");
    let first = train_one(&alone, &other);
    assert_eq!(first.history, trained[0].history);
    let table = std::fs::read_to_string(out.join(names::FRAMES)).expect("frames");
    let columns = |line: &str| line.split(',').count();
    let head = table.lines().next().expect("a head");
    assert!(table.lines().all(|line| columns(line) == columns(head)), "{table}");
}

#[test]
fn a_network_that_makes_no_run_is_a_row_with_its_reason_and_the_others_go_on() {
    let (directory, file) = files();
    let flat = EXPERIMENT.replace("cases = {", "variants = [{ name = \"flat\", seed = 3 }]\ncases = {");
    let (experiment, out) = (
        Experiment::parse(&flat, &file).expect("sound"),
        directory.path().join("out"),
    );
    train::<2>(&experiment, &out, &mut ()).expect("trained");
    // Weights and biases of zero: nothing tells the coordinates apart.
    let model = out.join("flat").join(names::MODEL);
    let mut bytes = std::fs::read(&model).expect("a model");
    let (header, _) = bytes.split_first_chunk().expect("a length");
    let start = 8 + u64::from_le_bytes(*header) as usize;
    bytes[start..].fill(0);
    std::fs::write(&model, bytes).expect("written");
    let rows = run::<2>(&experiment, &out, &mut |_, _| true).expect("run");
    assert_eq!(rows.len(), 12, "20 points and all, two updates, three maps");
    for row in &rows {
        let (begun, reason) = (
            row.variant != "flat",
            "coordinates at rest: coordinate 1 cannot be told",
        );
        assert_eq!((row.outcome == "finished", row.steps == 40), (begun, begun), "{row:?}");
        assert!(begun || row.outcome.starts_with(reason), "{row:?}");
    }
    let table = std::fs::read_to_string(out.join(names::RESULTS)).expect("results");
    assert!(table.lines().count() == 13 && !table.contains("NaN"), "{table}");
}

#[test]
fn of_several_starts_the_one_with_the_best_training_runs_is_kept() {
    let (directory, file) = files();
    let text = EXPERIMENT.replace("cases = {", "starts = 3\ncases = {");
    let experiment = Experiment::parse(&text, &file).expect("sound");
    let out = directory.path().join("out");
    let trained = train_one(&experiment, &out);
    assert_eq!(
        trained.starts.iter().map(|start| start.seed).collect::<Vec<_>>(),
        [0, 1, 2]
    );
    let errors: Vec<f64> = trained.starts.iter().map(|start| start.position_error).collect();
    let best = (0..3).min_by(|&a, &b| errors[a].total_cmp(&errors[b])).expect("three");
    assert_eq!(trained.gradient_error, trained.starts[best].gradient_error);
    let bytes = |path: PathBuf| std::fs::read(path).expect("a file");
    let model = |number: usize| bytes(out.join(format!("start_{number}")).join(names::MODEL));
    assert_eq!(bytes(out.join(names::MODEL)), model(best));
    assert_ne!(model(0), model(1));
    let table = std::fs::read_to_string(out.join(names::STARTS)).expect("a table");
    assert_eq!(table.lines().count(), 4, "{table}");
    // Stopped between trials, the same line goes on.
    struct StopTrial(u64);
    impl Watch for StopTrial {
        fn after_trial(&mut self) -> ControlFlow<()> {
            self.0 -= 1;
            break_if(self.0 == 0)
        }
    }
    let stopped = directory.path().join("stopped");
    assert!(matches!(
        train::<2>(&experiment, &stopped, &mut StopTrial(3)),
        Err(ExperimentError::Stopped)
    ));
    assert!(!stopped.join(names::MODEL).exists());
    assert_eq!(train_one(&experiment, &stopped).starts, trained.starts);
    // The first start is the network of an experiment without others, and the error that of its runs of the training cases, with the first of everything in [run].
    let alone = text
        .replace("starts = 3", "")
        .replace("test = [[2.0, 0.1]]", "test = [[1.0, 0.0], [3.0, 0.2]]");
    let alone = Experiment::parse(&alone, &file).expect("sound");
    let other = directory.path().join("other");
    train_one(&alone, &other);
    assert_eq!(bytes(other.join(names::MODEL)), model(0));
    let rows = run::<2>(&alone, &other, &mut |_, _| true).expect("run");
    let of_first = |row: &&ReducedRow| {
        let made = &row.choice;
        (made.manifold.name(), made.way(), made.update.name()) == ("network", "greedy", "position-velocity")
    };
    let squares = rows
        .iter()
        .filter(of_first)
        .map(|row| row.error.expect("frames").powi(2));
    let together = (squares.sum::<f64>() / 2.0).sqrt();
    assert!((errors[0] / together - 1.0).abs() < 1e-9, "{errors:?} {together}");
    assert_eq!(
        message(("cases = {", "starts = 0\ncases = {")),
        "rom.toml, starts: 0: at least 1"
    );
}
