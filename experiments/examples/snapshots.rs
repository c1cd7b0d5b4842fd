//! A figure of frames of `parvi simulate` or of reduced runs, bodies in space seen along z: `snapshots OUT.svg TITLE FIELD BOUNDS EXTENT COLUMNS FRAME.vtu…`.
//!
//! FIELD is a scalar of the particles, as in `plastic_strain`; BOUNDS, up to four numbers with commas, divide it into classes; EXTENT is
//! `x_lower,y_lower,x_upper,y_upper`; COLUMNS is how many frames stand in a row.

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
    let extent: [f64; 4] = numbers(extent)?.try_into().map_err(|_| "EXTENT has four numbers")?;
    let (mut panels, mut spacing) = (Vec::new(), 1.0);
    for path in frames {
        let frame = Frame::read(path.as_ref())?;
        let volumes = frame.field("volume")?;
        let in_space = frame.field("position")?.chunks_exact(3).any(|x| x[2] != 0.0);
        let dimension = if in_space { 3.0 } else { 2.0 };
        spacing = (volumes.iter().sum::<f64>() / volumes.len() as f64).powf(1.0 / dimension);
        panels.push(SnapshotPanel {
            title: format!("t = {} s", (frame.time()? * 1e4).round() / 1e4),
            positions: plane(&frame)?,
            values: frame.field(field)?,
        });
    }
    let count = panels.first().map_or(0, |panel| panel.positions.len());
    let plot = SnapshotsPlot {
        title: format!("{title}, {count} particles"),
        value_label: field.replace('_', " "),
        x_label: "x (m)".to_owned(),
        y_label: "y (m)".to_owned(),
        extent: [[extent[0], extent[1]], [extent[2], extent[3]]],
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

/// x and y of the particles.
fn plane(frame: &Frame) -> Result<Vec<[f64; 2]>> {
    let positions = frame.field("position")?;
    Ok(positions.chunks_exact(3).map(|x| [x[0], x[1]]).collect())
}
