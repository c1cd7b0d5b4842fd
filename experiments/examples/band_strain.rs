//! How much plastic strain shear bands hold, in frames of `parvi simulate`: `band_strain FRAME.vtu…`.
//!
//! Printed per frame: the instant, the mean of the plastic strain q over the body, and its mean in the bands, Σ q² V / Σ q V. For the same slip the latter
//! goes with the inverse of the bands' width.

use std::io::Write;

use mpm_scenes::output::Frame;

/// Anything may go wrong in an example.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    let frames: Vec<String> = std::env::args().skip(1).collect();
    if frames.is_empty() {
        return Err("usage: band_strain FRAME.vtu…".into());
    }
    let mut output = std::io::stdout().lock();
    writeln!(output, "time,mean,in_bands")?;
    for path in &frames {
        let frame = Frame::read(path.as_ref())?;
        let (strains, volumes) = (frame.field("plastic_strain")?, frame.field("volume")?);
        let (mut volume, mut first, mut second) = (0.0, 0.0, 0.0);
        for (q, v) in strains.iter().zip(&volumes) {
            volume += v;
            first += q * v;
            second += q * q * v;
        }
        let in_bands = if first > 0.0 { second / first } else { 0.0 };
        writeln!(output, "{},{},{in_bands}", frame.time()?, first / volume)?;
    }
    Ok(())
}
