//! Frames of `parvi simulate`: `.vtu` files with raw appended data.

use std::error::Error;

/// Anything that goes wrong in an example.
pub type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// A frame.
pub struct Frame {
    bytes: Vec<u8>,
    /// The length of the part that is text.
    header: usize,
    /// Where the appended data begin.
    data: usize,
}

impl Frame {
    /// Reads a file.
    pub fn read(path: &str) -> Result<Self> {
        let bytes = std::fs::read(path)?;
        let header = find(&bytes, b"<AppendedData").ok_or("no appended data")?;
        let data = header + find(&bytes[header..], b"_").ok_or("no appended data")? + 1;
        Ok(Self { bytes, header, data })
    }

    /// The instant.
    pub fn time(&self) -> Result<f64> {
        let rest = self.after("Name=\"TimeValue\"")?;
        let (_, rest) = rest.split_once('>').ok_or("a header without end")?;
        let (time, _) = rest.split_once('<').ok_or("a header without end")?;
        Ok(time.trim().parse()?)
    }

    /// x and y of the particles.
    pub fn plane(&self) -> Result<Vec<[f64; 2]>> {
        let positions = self.field("position")?;
        Ok(positions.chunks_exact(3).map(|x| [x[0], x[1]]).collect())
    }

    /// A field of real numbers.
    pub fn field(&self, name: &str) -> Result<Vec<f64>> {
        let rest = self.after(&format!("Name=\"{name}\""))?;
        let (_, rest) = rest.split_once("offset=\"").ok_or("a field without data")?;
        let (offset, _) = rest.split_once('"').ok_or("a header without end")?;
        let block = self.bytes.get(self.data + offset.parse::<usize>()?..);
        let (length, values) = block
            .and_then(|block| block.split_at_checked(8))
            .ok_or("a truncated frame")?;
        let length = u64::from_le_bytes(length.try_into()?) as usize;
        let values = values.get(..length).ok_or("a truncated frame")?;
        let number = |entry: &[u8]| Ok(f64::from_le_bytes(entry.try_into()?));
        values.chunks_exact(8).map(number).collect()
    }

    /// The header behind a mark.
    fn after(&self, mark: &str) -> Result<&str> {
        let header = std::str::from_utf8(&self.bytes[..self.header])?;
        let (_, rest) = header
            .split_once(mark)
            .ok_or_else(|| format!("no {mark} in the frame"))?;
        Ok(rest)
    }
}

fn find(bytes: &[u8], mark: &[u8]) -> Option<usize> {
    bytes.windows(mark.len()).position(|window| window == mark)
}
