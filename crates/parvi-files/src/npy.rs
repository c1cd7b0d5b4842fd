//! NumPy arrays as `.npy` files, f64.

use std::fs::File;
use std::io::{self, BufReader};
use std::path::Path;

use npyz::{NpyFile, Order, WriteOptions, WriterBuilder};

use super::NumberTable;

/// The bytes of a file, row-major.
///
/// # Errors
/// Where there are not as many values as the shape says.
pub fn array(shape: &[u64], values: &[f64]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let options = WriteOptions::new().default_dtype().shape(shape);
    let mut array = options.writer(&mut bytes).begin_nd()?;
    array.extend(values.iter().copied())?;
    array.finish()?;
    Ok(bytes)
}

/// The table in a file.
///
/// # Errors
/// What is wrong with it, in words.
pub fn table(path: &Path) -> Result<NumberTable, String> {
    let in_words = |error: io::Error| match error.kind() {
        io::ErrorKind::UnexpectedEof => "it ends too early: a part of the array is missing".to_owned(),
        _ => error.to_string(),
    };
    let file = File::open(path).map_err(|error| format!("cannot be read: {error}"))?;
    let array = NpyFile::new(BufReader::new(file)).map_err(in_words)?;
    let columns = match *array.shape() {
        [_] => 1,
        [_, columns] => columns as usize,
        ref shape => return Err(format!("an array of the shape {shape:?} is no table")),
    };
    if array.order() != Order::C {
        return Err("the array is stored column by column; save it in C order".to_owned());
    }
    let numbers = array.into_vec::<f64>().map_err(in_words)?;
    if numbers.is_empty() {
        return Err("it holds no numbers".to_owned());
    }
    Ok(NumberTable {
        columns,
        numbers,
        ..NumberTable::default()
    })
}
