//! A figure of frames of `parvi simulate`: `snapshots OUT.svg TITLE FIELD BOUNDS EXTENT COLUMNS FRAME.vtu…`.
//!
//! FIELD is a scalar of the particles, as in `plastic_strain`; BOUNDS, up to four numbers with commas, divide it into classes; EXTENT is
//! `x_lower,y_lower,x_upper,y_upper`; COLUMNS is how many frames stand in a row.

use std::error::Error;

use parvi_experiments::output::AtomicFile;
use parvi_experiments::plots::{SnapshotPanel, SnapshotsPlot, snapshots};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [out, title, field, bounds, extent, columns, frames @ ..] = &arguments[..] else {
        return Err("usage: snapshots OUT.svg TITLE FIELD BOUNDS EXTENT COLUMNS FRAME.vtu…".into());
    };
    let extent: [f64; 4] = numbers(extent)?.try_into().map_err(|_| "EXTENT has four numbers")?;
    let mut panels = Vec::new();
    for frame in frames {
        panels.push(panel(&std::fs::read(frame)?, field)?);
    }
    let count = panels.first().map_or(0, |panel| panel.positions.len());
    let plot = SnapshotsPlot {
        title: format!("{title}, {count} particles"),
        value_label: field.replace('_', " "),
        x_label: "x (m)".to_owned(),
        y_label: "y (m)".to_owned(),
        extent: [[extent[0], extent[1]], [extent[2], extent[3]]],
        spacing: nearest(&panels),
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

/// Distance between the first two particles, which a filling makes neighbours.
fn nearest(panels: &[SnapshotPanel]) -> f64 {
    let Some([first, second, ..]) = panels.first().map(|panel| &panel.positions[..]) else {
        return 1.0;
    };
    (second[0] - first[0]).hypot(second[1] - first[1])
}

/// Positions and a field of the raw appended data that `parvi simulate` writes.
fn panel(bytes: &[u8], field: &str) -> Result<SnapshotPanel> {
    let start = find(bytes, b"<AppendedData").ok_or("no appended data")?;
    let data = start + find(&bytes[start..], b"_").ok_or("no appended data")? + 1;
    let header = std::str::from_utf8(&bytes[..start])?;
    let after = |text: &str, mark: &str| -> Result<usize> {
        let place = text.find(mark).ok_or_else(|| format!("no {mark} in the frame"))?;
        Ok(place + mark.len())
    };
    let array = |name: &str| -> Result<Vec<f64>> {
        let rest = &header[after(header, &format!("Name=\"{name}\""))?..];
        let rest = &rest[after(rest, "offset=\"")?..];
        let offset: usize = rest[..rest.find('"').ok_or("a header without end")?].parse()?;
        let block = bytes.get(data + offset..).ok_or("a truncated frame")?;
        let (length, values) = block.split_at_checked(8).ok_or("a truncated frame")?;
        let length = u64::from_le_bytes(length.try_into()?) as usize;
        let values = values.get(..length).ok_or("a truncated frame")?;
        let number = |entry: &[u8]| Ok(f64::from_le_bytes(entry.try_into()?));
        values.chunks_exact(8).map(number).collect()
    };
    let rest = &header[after(header, "Name=\"TimeValue\"")?..];
    let rest = &rest[after(rest, ">")?..];
    let time: f64 = rest[..rest.find('<').ok_or("a header without end")?].trim().parse()?;
    let positions = array("position")?;
    Ok(SnapshotPanel {
        title: format!("t = {time} s"),
        positions: positions.chunks_exact(3).map(|x| [x[0], x[1]]).collect(),
        values: array(field)?,
    })
}

fn find(bytes: &[u8], mark: &[u8]) -> Option<usize> {
    bytes.windows(mark.len()).position(|window| window == mark)
}
