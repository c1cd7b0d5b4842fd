//! NumPy arrays of any shape.

use std::io;

use npyz::WriterBuilder;

/// The bytes of a `.npy` file: f64, row-major.
///
/// # Errors
/// Where there are not as many values as the shape says.
pub fn array(shape: &[u64], values: &[f64]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut array = npyz::WriteOptions::new()
        .default_dtype()
        .shape(shape)
        .writer(&mut bytes)
        .begin_nd()?;
    array.extend(values.iter().copied())?;
    array.finish()?;
    Ok(bytes)
}
