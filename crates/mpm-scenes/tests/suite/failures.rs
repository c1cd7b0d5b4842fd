//! A run that fails keeps what it wrote and says where it failed.

use mpm_scenes::{SimulationError, simulate};

use super::scenes::{BAR, BLOCK, scene};

#[test]
fn a_particle_turned_inside_out_is_named_with_its_step() {
    // A blow that the Courant condition knows nothing of.
    let blow = "[[loads]]\nkind = \"point-force\"\nregion = { kind = \"box\", lower = [9.0], upper = [10.0] }\nforce = [-1e6]\n";
    // Also where its step ends at a row of the series, in which its energy is no number.
    for interval in ["series_interval = 0.1", "series_interval = 0.01"] {
        let text = BAR.replace("linear-elastic", "neo-hookean") + blow;
        let text = text.replace("series_interval = 0.1", interval);
        let directory = tempfile::tempdir().expect("a directory");
        let error = simulate(&scene(&text), directory.path(), &mut ()).expect_err("inverted");
        let SimulationError::Step { step, particle, .. } = &error else {
            panic!("{error}")
        };
        assert!(*step > 1 && particle.is_some(), "{error}");
        let message = error.to_string();
        assert!(message.contains("volume ratio"), "{message}");
        assert!(directory.path().join("particles_000000.vtu").exists());
        let series = std::fs::read_to_string(directory.path().join("series.csv")).expect("written");
        assert!(series.lines().count() >= 2);
    }
}

#[test]
fn a_particle_that_leaves_the_domain_is_named_and_frames_stay() {
    let text = BLOCK.replace("velocity = [1.0, 0.0]", "velocity = [-6.0, 0.0]");
    let directory = tempfile::tempdir().expect("a directory");
    let error = simulate(&scene(&text), directory.path(), &mut ()).expect_err("outside");
    let SimulationError::Step {
        step, time, particle, ..
    } = &error
    else {
        panic!("{error}")
    };
    assert!(*step > 1 && *time > 0.05 && particle.is_some(), "{error}");
    assert!(error.to_string().contains("outside the domain"), "{error}");
    assert!(directory.path().join("particles_000001.vtu").exists());
}

#[test]
fn numbers_that_are_none_end_a_run() {
    let heavy = BLOCK.replace("density = 1000.0", "density = 1e308");
    let directory = tempfile::tempdir().expect("a directory");
    let error = simulate(&scene(&heavy), directory.path(), &mut ()).expect_err("too large to be added");
    let message = error.to_string();
    assert!(
        message.starts_with("step 0 at t = 0: ") && message.ends_with(" is inf: the run has diverged"),
        "{message}"
    );
    let SimulationError::Diverged { column, value, .. } = error else {
        panic!("{message}")
    };
    assert!(column == "kinetic_energy" || column == "potential_energy", "{column}");
    assert!(value.is_infinite());
}

#[test]
fn a_file_in_the_place_of_the_directory_is_said_to_be_one() {
    let directory = tempfile::tempdir().expect("a directory");
    let file = directory.path().join("out");
    std::fs::write(&file, "mine").expect("written");
    let error = simulate(&scene(BLOCK), &file, &mut ()).expect_err("a file");
    let message = error.to_string();
    assert!(
        message.starts_with("cannot write into ") && message.ends_with("out: is a file, and a directory is needed"),
        "{message}"
    );
    let error = simulate(&scene(BLOCK), &file.join("within"), &mut ()).expect_err("no directory");
    let message = error.to_string();
    assert!(
        message.starts_with(&format!("cannot create {}", file.join("within").display())),
        "{message}"
    );
}
