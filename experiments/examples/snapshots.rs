//! A figure of frames of `parvi simulate` or of reduced runs, bodies in space seen along z: `snapshots [--nearest] OUT.svg TITLE FIELD BOUNDS EXTENT COLUMNS FRAME.vtu…`.
//!
//! FIELD is a scalar of the particles, as in `plastic_strain`; BOUNDS, up to four numbers with commas, divide it into classes; EXTENT is
//! `x_lower,y_lower,x_upper,y_upper`, or `x,y` to either side of the centre of mass; COLUMNS is how many frames stand in a row. Of particles behind each other the highest class is seen, with
//! `--nearest` the one with the largest z alone.

use std::collections::HashMap;

use mpm_scenes::output::Frame;
use parvi_experiments::plots::{SnapshotPanel, SnapshotsPlot, snapshots};
use parvi_files::AtomicFile;

/// Anything may go wrong in an example.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    let mut arguments: Vec<String> = std::env::args().skip(1).collect();
    let nearest = arguments.first().is_some_and(|first| first == "--nearest");
    arguments.drain(..usize::from(nearest));
    let [out, title, field, bounds, extent, columns, frames @ ..] = &arguments[..] else {
        return Err("usage: snapshots [--nearest] OUT.svg TITLE FIELD BOUNDS EXTENT COLUMNS FRAME.vtu…".into());
    };
    let (extent, follows) = match numbers(extent)?[..] {
        [x, y] => ([[-x, -y], [x, y]], true),
        [x_lower, y_lower, x_upper, y_upper] => ([[x_lower, y_lower], [x_upper, y_upper]], false),
        _ => return Err("EXTENT has two or four numbers".into()),
    };
    let (mut panels, mut spacing, mut count) = (Vec::new(), 1.0, 0);
    for path in frames {
        let frame = Frame::read(path.as_ref())?;
        let (volumes, positions) = (frame.field("volume")?, frame.field("position")?);
        count = volumes.len();
        let in_space = positions.chunks_exact(3).any(|x| x[2] != 0.0);
        let dimension = if in_space { 3.0 } else { 2.0 };
        spacing = (volumes.iter().sum::<f64>() / count as f64).powf(1.0 / dimension);
        let centre = if follows { centre_of_mass(&frame)? } else { [0.0; 2] };
        let seen = if nearest {
            nearest_of(&positions, spacing)
        } else {
            (0..count).collect()
        };
        let values = frame.field(field)?;
        panels.push(SnapshotPanel {
            title: format!("t = {} s", (frame.time()? * 1e4).round() / 1e4),
            positions: seen
                .iter()
                .map(|p| [positions[3 * p] - centre[0], positions[3 * p + 1] - centre[1]])
                .collect(),
            values: seen.iter().map(|&p| values[p]).collect(),
        });
    }
    let plot = SnapshotsPlot {
        title: format!("{title}, {count} particles"),
        value_label: field.replace('_', " "),
        x_label: "x (m)".to_owned(),
        y_label: "y (m)".to_owned(),
        extent,
        spacing,
        bounds: numbers(bounds)?,
        columns: columns.parse()?,
        panels,
        notes: follows
            .then(|| "From the centre of mass.".to_owned())
            .into_iter()
            .collect(),
    };
    AtomicFile::write(out, snapshots(&plot)?)?;
    Ok(())
}

fn numbers(list: &str) -> Result<Vec<f64>> {
    list.split(',').map(|number| Ok(number.trim().parse()?)).collect()
}

/// x and y of the centre of mass.
fn centre_of_mass(frame: &Frame) -> Result<[f64; 2]> {
    let (positions, masses) = (frame.field("position")?, frame.field("mass")?);
    let total: f64 = masses.iter().sum();
    let each = positions.chunks_exact(3).zip(&masses);
    Ok(each.fold([0.0; 2], |sum, (x, mass)| {
        [sum[0] + x[0] * mass / total, sum[1] + x[1] * mass / total]
    }))
}

/// The particle with the largest z of those in each square of this size, in the order of the particles.
fn nearest_of(positions: &[f64], size: f64) -> Vec<usize> {
    let mut squares: HashMap<[i64; 2], usize> = HashMap::new();
    for (p, x) in positions.chunks_exact(3).enumerate() {
        let square = [x[0], x[1]].map(|c| (c / size).floor() as i64);
        let known = squares.entry(square).or_insert(p);
        if x[2] > positions[3 * *known + 2] {
            *known = p;
        }
    }
    let mut seen: Vec<usize> = squares.into_values().collect();
    seen.sort_unstable();
    seen
}
