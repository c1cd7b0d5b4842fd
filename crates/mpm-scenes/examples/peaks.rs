//! Times of the peaks of a column of series: `cargo run --release -p mpm-scenes --example peaks -- COLUMN LEAST DIRECTORY…`, each a run's.
//!
//! A peak is the largest value within 0.05 s, at least LEAST, and 1.3 times the least value of the 0.15 s before it and of those after it. Printed per run: its directory, and time and value of each.

#![allow(clippy::print_stdout)]

use mpm_scenes::output::read_series;

/// Half of the time within which a peak is the largest value, and the times before and after it that it rises from.
const WITHIN: f64 = 0.05;
const BESIDE: f64 = 0.15;

/// How many times as high it is as the least value there.
const RISE: f64 = 1.3;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [column, least, directories @ ..] = arguments.as_slice() else {
        return Err("usage: peaks COLUMN LEAST DIRECTORY…".into());
    };
    let least: f64 = least.parse()?;
    for directory in directories {
        let series = read_series(directory.as_ref())?;
        let (times, values) = series
            .column("time")
            .zip(series.column(column))
            .ok_or("no such column")?;
        let points: Vec<(f64, f64)> = times.into_iter().zip(values).collect();
        let beside = |from: f64, to: f64| {
            let points = points.iter().filter(move |(time, _)| (from..=to).contains(time));
            points.map(|(_, value)| *value)
        };
        print!("{directory}:");
        for &(time, value) in &points {
            let is_largest = beside(time - WITHIN, time + WITHIN).all(|other| other <= value);
            let mut flanks = [beside(time - BESIDE, time), beside(time, time + BESIDE)].into_iter();
            let rises = flanks.all(|mut flank| flank.any(|other| RISE * other <= value));
            if value >= least && is_largest && rises {
                print!(" {time:.2} ({value:.0})");
            }
        }
        println!();
    }
    Ok(())
}
