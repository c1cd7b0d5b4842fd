//! Noise of the pressure in frames of `parvi simulate`, D = 2: `stress_noise RADIUS FRAME.vtu…`.
//!
//! Around every particle a linear function is fitted to the pressures of the particles within RADIUS, with their volumes as weights. Printed per frame:
//! the instant, the root mean square difference of the particles' own pressures to their fits, and that of the pressure itself.

use std::collections::HashMap;
use std::io::Write;

use mpm_scenes::output::Frame;
use mpm_tensor::Matrix;

/// Anything may go wrong in an example.
type Result<T> = std::result::Result<T, Box<dyn std::error::Error>>;

fn main() -> Result<()> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [radius, frames @ ..] = &arguments[..] else {
        return Err("usage: stress_noise RADIUS FRAME.vtu…".into());
    };
    let radius: f64 = radius.parse()?;
    let mut output = std::io::stdout().lock();
    writeln!(output, "time,noise,pressure")?;
    for path in frames {
        let frame = Frame::read(path.as_ref())?;
        let (noise, pressure) = noise(&frame, radius)?;
        writeln!(output, "{},{noise},{pressure}", frame.time()?)?;
    }
    Ok(())
}

/// Root mean squares of p_k − fit and of p_k over the volume.
fn noise(frame: &Frame, radius: f64) -> Result<(f64, f64)> {
    let (positions, pressures, volumes) = (plane(frame)?, frame.field("pressure")?, frame.field("volume")?);
    let bin = |x: &[f64; 2]| x.map(|c| (c / radius).floor() as i64);
    let mut bins: HashMap<[i64; 2], Vec<usize>> = HashMap::new();
    for (k, x) in positions.iter().enumerate() {
        bins.entry(bin(x)).or_default().push(k);
    }
    let (mut noise, mut square, mut volume) = (0.0, 0.0, 0.0);
    for (k, x) in positions.iter().enumerate() {
        let [column, row] = bin(x);
        // Σ V b bᵀ and Σ V b p of the basis b = (1, x_q − x_k) / (1, radius).
        let (mut matrix, mut right) = (Matrix::<3>::ZERO, [0.0; 3]);
        for near in (-1..=1).flat_map(|i| (-1..=1).map(move |j| [column + i, row + j])) {
            for &q in bins.get(&near).map_or(&[][..], |members| members) {
                let offset = [0, 1].map(|a| (positions[q][a] - x[a]) / radius);
                if offset[0].hypot(offset[1]) <= 1.0 {
                    let basis = [1.0, offset[0], offset[1]];
                    matrix += Matrix::outer(&basis, &basis) * volumes[q];
                    for a in 0..3 {
                        right[a] += basis[a] * volumes[q] * pressures[q];
                    }
                }
            }
        }
        // Too few neighbours, or all in a line: nothing to compare with.
        let Some(inverse) = matrix.inverse() else { continue };
        let fit = inverse.apply(&right)[0];
        noise += volumes[k] * (pressures[k] - fit).powi(2);
        square += volumes[k] * pressures[k].powi(2);
        volume += volumes[k];
    }
    Ok(((noise / volume).sqrt(), (square / volume).sqrt()))
}

/// x and y of the particles.
fn plane(frame: &Frame) -> Result<Vec<[f64; 2]>> {
    let positions = frame.field("position")?;
    Ok(positions.chunks_exact(3).map(|x| [x[0], x[1]]).collect())
}
