//! A target of the catalogue for programs in other languages: log densities of batches of points, over pipes.
//!
//! `cargo run --release -p parvi-targets --example log_densities -- NAME [DIM [TARGET_SEED]]` writes a line with log ∫ p (NaN: not
//! known), the centre and the scales of the target's frame, then for every batch on standard input, the number of points n as u64 and n × d
//! coordinates as f64, n log densities as f64, all little-endian.

use std::error::Error;
use std::io::{ErrorKind, Read, Write};

use parvi_targets::{Parameters, build, dimension_of};

fn serve<const D: usize>(name: &str, parameters: &Parameters) -> Result<(), Box<dyn Error>> {
    let target = build::<D>(name, parameters)?;
    let frame = target.frame();
    let scales: [f64; D] = std::array::from_fn(|axis| frame.covariance().0[axis][axis].sqrt());
    let log_evidence = target.log_evidence().unwrap_or(f64::NAN);
    let numbers = [&log_evidence].into_iter().chain(frame.centre()).chain(&scales);
    let numbers: Vec<String> = numbers.map(f64::to_string).collect();
    let (mut input, mut output) = (std::io::stdin().lock(), std::io::stdout().lock());
    writeln!(output, "{}", numbers.join(" "))?;
    output.flush()?;
    loop {
        let mut word = [0; 8];
        match input.read_exact(&mut word) {
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => return Ok(()),
            read => read?,
        }
        let mut points = vec![[0.0; D]; usize::try_from(u64::from_le_bytes(word))?];
        for coordinate in points.as_flattened_mut() {
            input.read_exact(&mut word)?;
            *coordinate = f64::from_le_bytes(word);
        }
        let mut log_densities = vec![0.0; points.len()];
        target.log_densities(&points, &mut log_densities);
        let bytes: Vec<u8> = log_densities.iter().flat_map(|value| value.to_le_bytes()).collect();
        output.write_all(&bytes)?;
        output.flush()?;
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let name = arguments.first().ok_or("NAME is missing")?;
    let dimension = arguments.get(1).map(|text| text.parse()).transpose()?;
    let target_seed = arguments.get(2).map(|text| text.parse()).transpose()?;
    let parameters = Parameters {
        target_seed,
        ..Parameters::default()
    };
    match dimension_of(name, dimension, &parameters)? {
        1 => serve::<1>(name, &parameters),
        2 => serve::<2>(name, &parameters),
        3 => serve::<3>(name, &parameters),
        4 => serve::<4>(name, &parameters),
        5 => serve::<5>(name, &parameters),
        6 => serve::<6>(name, &parameters),
        7 => serve::<7>(name, &parameters),
        _ => serve::<8>(name, &parameters),
    }
}
