//! A figure of frames of `parvi simulate` or of reduced runs, bodies in space seen along z: `snapshots OUT.svg TITLE FIELD BOUNDS EXTENT COLUMNS FRAME.vtu…`.
//!
//! FIELD is a scalar of the particles, as in `plastic_strain`; BOUNDS, up to four numbers with commas, divide it into classes; EXTENT is
//! `x_lower,y_lower,x_upper,y_upper`, or `x,y` to either side of the centre of mass; COLUMNS is how many frames stand in a row.

use mpm_scenes::output::Frame;
use parvi_experiments::plots::{SnapshotPanel, SnapshotsPlot, snapshots};
use parvi_files::AtomicFile;

/// Anything may go wrong in an example.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [out, title, field, bounds, extent, columns, frames @ ..] = &arguments[..] else {
        return Err("usage: snapshots OUT.svg TITLE FIELD BOUNDS EXTENT COLUMNS FRAME.vtu…".into());
    };
    let (extent, follows) = match numbers(extent)?[..] {
        [x, y] => ([[-x, -y], [x, y]], true),
        [x_lower, y_lower, x_upper, y_upper] => ([[x_lower, y_lower], [x_upper, y_upper]], false),
        _ => return Err("EXTENT has two or four numbers".into()),
    };
    let (mut panels, mut spacing) = (Vec::new(), 1.0);
    for path in frames {
        let frame = Frame::read(path.as_ref())?;
        let volumes = frame.field("volume")?;
        let in_space = frame.field("position")?.chunks_exact(3).any(|x| x[2] != 0.0);
        let dimension = if in_space { 3.0 } else { 2.0 };
        spacing = (volumes.iter().sum::<f64>() / volumes.len() as f64).powf(1.0 / dimension);
        panels.push(SnapshotPanel {
            title: format!("t = {} s", (frame.time()? * 1e4).round() / 1e4),
            positions: plane(&frame, follows)?,
            values: frame.field(field)?,
        });
    }
    let count = panels.first().map_or(0, |panel| panel.positions.len());
    let plot = SnapshotsPlot {
        title: format!("{title}, {count} particles"),
        value_label: field.replace('_', " "),
        x_label: if follows {
            "x from the centre of mass (m)"
        } else {
            "x (m)"
        }
        .to_owned(),
        y_label: if follows {
            "y from the centre of mass (m)"
        } else {
            "y (m)"
        }
        .to_owned(),
        extent,
        spacing,
        bounds: numbers(bounds)?,
        columns: columns.parse()?,
        panels,
        notes: Vec::new(),
    };
    AtomicFile::write(out, snapshots(&plot)?)?;
    Ok(())
}

fn numbers(list: &str) -> Result<Vec<f64>> {
    list.split(',').map(|number| Ok(number.trim().parse()?)).collect()
}

/// x and y of the particles, or what they are beyond those of the centre of mass.
fn plane(frame: &Frame, follows: bool) -> Result<Vec<[f64; 2]>> {
    let positions = frame.field("position")?;
    let positions = positions.chunks_exact(3).map(|x| [x[0], x[1]]);
    let mut centre = [0.0; 2];
    if follows {
        let masses = frame.field("mass")?;
        let total: f64 = masses.iter().sum();
        for (x, mass) in positions.clone().zip(&masses) {
            centre = [centre[0] + x[0] * mass / total, centre[1] + x[1] * mass / total];
        }
    }
    Ok(positions.map(|x| [x[0] - centre[0], x[1] - centre[1]]).collect())
}
