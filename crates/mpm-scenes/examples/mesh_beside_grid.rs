//! Processor time per particle and step of a scene up to END on its mesh beside that on a structured grid, in turn: `mesh_beside_grid SCENE.toml END [ROUNDS]`. The grid has the spacing
//! that edges of the mesh should have, over the box around the mesh; barriers are left out of both. One thread: RAYON_NUM_THREADS=1.

use std::error::Error;
use std::io::Write;
use std::path::{Path, PathBuf};

use mpm_scenes::{Scene, simulate};
use toml::{Table, Value};

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, end, rounds @ ..] = &arguments[..] else {
        return Err("usage: mesh_beside_grid SCENE.toml END [ROUNDS]".into());
    };
    let (file, end): (PathBuf, f64) = (file.into(), end.parse()?);
    let rounds: usize = rounds.first().map_or(Ok(3), |text| text.parse())?;
    let whole: Table = std::fs::read_to_string(&file)?.parse()?;
    let mut output = std::io::stdout().lock();
    for _ in 0..rounds {
        let mut times = Vec::new();
        for name in ["mesh", "grid"] {
            // What comes before the first step is the same in both runs.
            let [first, last] = [0.2 * end, end].map(|end| -> Result<_, Box<dyn Error>> {
                let on_mesh = shortened(whole.clone(), end)?;
                let scene = match name {
                    "mesh" => on_mesh,
                    _ => gridded(on_mesh).ok_or("a scene on a mesh of a box or a ball")?,
                };
                run(&scene.to_string(), &file)
            });
            let ((time_before, steps_before), (time, steps)) = (first?, last?);
            let each = (time - time_before) / (steps - steps_before);
            write!(output, "{name}: {each:.0} ns; ")?;
            times.push(each);
        }
        writeln!(output, "ratio {:.2}", times[0] / times[1])?;
    }
    Ok(())
}

/// Processor time in nanoseconds, and steps of all particles.
fn run(text: &str, file: &Path) -> Result<(f64, f64), Box<dyn Error>> {
    let directory = tempfile::tempdir()?;
    let scene = Scene::parse(text, file)?;
    let start = processor_nanoseconds()?;
    let summary = simulate(&scene, &directory.path().join("run"), &mut ())?;
    let time = processor_nanoseconds()? - start;
    Ok((time, summary.steps as f64 * summary.particles as f64))
}

/// The scene up to `end`, without what takes time beside the steps.
fn shortened(mut scene: Table, end: f64) -> Result<Table, Box<dyn Error>> {
    let table = |scene: &mut Table, key: &str| scene.get_mut(key).and_then(Value::as_table_mut).cloned();
    let mut time = table(&mut scene, "time").ok_or("no [time]")?;
    time.insert("end".to_owned(), end.into());
    let mut output = Table::new();
    output.insert("interval".to_owned(), end.into());
    output.insert("series_interval".to_owned(), end.into());
    scene.insert("time".to_owned(), time.into());
    scene.insert("output".to_owned(), output.into());
    for key in ["validation", "barrier", "probes"] {
        scene.remove(key);
    }
    Ok(scene)
}

/// The same on a grid.
fn gridded(mut scene: Table) -> Option<Table> {
    let mesh = scene.remove("mesh")?;
    let shape = mesh.get("generate")?;
    let list = |key: &str| -> Option<Vec<f64>> { shape.get(key)?.as_array()?.iter().map(Value::as_float).collect() };
    let size = shape.get("size")?.as_float()?;
    let (lower, upper) = match (list("lower"), list("upper"), list("centre")) {
        (Some(lower), Some(upper), _) => (lower, upper),
        (_, _, Some(centre)) => {
            let radius = shape.get("radius")?.as_float()?;
            let moved = |by: f64| centre.iter().map(|c| c + by).collect::<Vec<f64>>();
            (moved(-radius), moved(radius))
        }
        _ => return None,
    };
    scene.insert(
        "domain".to_owned(),
        Table::from_iter([("lower", lower), ("upper", upper)].map(|(key, list)| (key.to_owned(), list.into()))).into(),
    );
    scene.insert(
        "grid".to_owned(),
        Table::from_iter([("spacing".to_owned(), size.into())]).into(),
    );
    Some(scene)
}

/// Processor time of this process, which other processes disturb less than that on the wall.
fn processor_nanoseconds() -> Result<f64, Box<dyn Error>> {
    let mut sum = 0.0;
    for task in std::fs::read_dir("/proc/self/task")? {
        let text = std::fs::read_to_string(task?.path().join("schedstat"))?;
        sum += text.split(' ').next().unwrap_or("0").parse::<f64>()?;
    }
    Ok(sum)
}
