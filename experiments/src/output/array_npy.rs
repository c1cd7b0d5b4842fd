//! NumPy arrays of any shape, format version 1.0 (numpy.lib.format of the NumPy reference): f64, little-endian, row-major.
//!
//! Written here, since a crate that also reads such files brings a parser of Python literals along.

use std::io;

/// Header and data together begin at a multiple of so many bytes.
const ALIGNMENT: usize = 64;

/// What stands before the header's text: the magic string, the version, the length of the text.
const BEFORE_TEXT: usize = 10;

/// All that stands before the values.
pub(super) fn header(shape: &[u64]) -> Vec<u8> {
    let mut text = String::from("{'descr': '<f8', 'fortran_order': False, 'shape': (");
    for length in shape {
        text += &format!("{length}, ");
    }
    text += "), }";
    let end = (BEFORE_TEXT + text.len() + 1).next_multiple_of(ALIGNMENT); // with the newline
    let padded = end - BEFORE_TEXT - 1;
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend(((padded + 1) as u16).to_le_bytes());
    bytes.extend(format!("{text:padded$}\n").into_bytes());
    bytes
}

/// The bytes of a `.npy` file.
///
/// # Errors
/// Unless there are as many values as the shape says.
pub fn array(shape: &[u64], values: &[f64]) -> io::Result<Vec<u8>> {
    let expected: u64 = shape.iter().product();
    if values.len() as u64 != expected {
        let message = format!("{} values for an array of {expected}", values.len());
        return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
    }
    let mut bytes = header(shape);
    bytes.extend(values.iter().flat_map(|value| value.to_le_bytes()));
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;
    use npyz::WriterBuilder;

    /// As the crate npyz writes it.
    fn oracle(shape: &[u64], values: &[f64]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let options = npyz::WriteOptions::new().default_dtype().shape(shape);
        let mut array = options.writer(&mut bytes).begin_nd().unwrap();
        array.extend(values.iter().copied()).unwrap();
        array.finish().unwrap();
        bytes
    }

    #[test]
    fn files_are_those_of_npyz() {
        let values = [0.5, -1.0, f64::NAN, f64::INFINITY, 1e-310, -0.0];
        for shape in [&[6][..], &[2, 3], &[3, 2, 1], &[1, 1, 1, 1, 1, 1, 1, 1, 6]] {
            assert_eq!(array(shape, &values).unwrap(), oracle(shape, &values), "{shape:?}");
        }
        assert_eq!(array(&[0, 4], &[]).unwrap(), oracle(&[0, 4], &[]));
        // Every length of the text modulo the alignment.
        for length in 0..18 {
            let shape = [10u64.pow(length), 0, 10u64.pow(length / 2)];
            assert_eq!(header(&shape), oracle(&shape, &[]), "{shape:?}");
        }
    }

    #[test]
    fn values_too_few_or_too_many_are_refused() {
        assert!(array(&[2, 2], &[1.0; 3]).is_err());
        assert!(array(&[2], &[1.0; 3]).is_err());
    }
}
