//! Numbers one after the other, from text or bytes.

use super::{MshError, Place};

/// How numbers are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// U+FEFF in UTF-8.
const BYTE_ORDER_MARK: &[u8] = "\u{feff}".as_bytes();

/// A place in a file, from where it is read on.
pub struct Cursor<'a> {
    bytes: &'a [u8],
    at: usize,
    pub encoding: Encoding,
}

impl<'a> Cursor<'a> {
    /// At the first byte, or behind the byte order mark that some editors put there.
    pub fn new(bytes: &'a [u8]) -> Self {
        Self {
            bytes,
            at: if bytes.starts_with(BYTE_ORDER_MARK) {
                BYTE_ORDER_MARK.len()
            } else {
                0
            },
            encoding: Encoding::Text,
        }
    }

    /// Whether nothing but white space is left.
    pub fn at_end(&self) -> bool {
        self.at + self.white_space() == self.bytes.len()
    }

    /// Bytes before what comes next.
    pub fn mark(&self) -> usize {
        let text = self.encoding == Encoding::Text;
        self.at + if text { self.white_space() } else { 0 }
    }

    /// What to say of a mark in an error; counts lines.
    pub fn place(&self, mark: usize) -> Place {
        let lines = || 1 + self.bytes[..mark].iter().filter(|&&byte| byte == b'\n').count();
        Place {
            byte: mark,
            line: (self.encoding == Encoding::Text).then(lines),
        }
    }

    fn white_space(&self) -> usize {
        let rest = &self.bytes[self.at..];
        rest.iter().take_while(|byte| byte.is_ascii_whitespace()).count()
    }

    /// The next word of text, in binary files too: names of sections, and numbers that are always text.
    pub fn word(&mut self, expected: &'static str) -> Result<&'a str, MshError> {
        let start = self.at + self.white_space();
        let length = self.bytes[start..]
            .iter()
            .take_while(|byte| !byte.is_ascii_whitespace())
            .count();
        if length == 0 {
            return Err(self.truncated(expected));
        }
        let word = std::str::from_utf8(&self.bytes[start..start + length]);
        let word = word.map_err(|_| self.malformed(start, expected, "bytes that are no text"))?;
        self.at = start + length;
        Ok(word)
    }

    /// The next word as a number.
    pub fn parse<T: std::str::FromStr>(&mut self, expected: &'static str) -> Result<T, MshError> {
        let mark = self.mark();
        let found = self.word(expected)?;
        found.parse().map_err(|_| self.malformed(mark, expected, found))
    }

    /// The next text between quotes, without them.
    pub fn quoted(&mut self, expected: &'static str) -> Result<&'a str, MshError> {
        let mark = self.at + self.white_space();
        let rest = &self.bytes[mark..];
        let Some(inner) = rest.strip_prefix(b"\"") else {
            return Err(match self.word(expected) {
                Ok(found) => self.malformed(mark, expected, found),
                Err(error) => error,
            });
        };
        let length = inner.iter().position(|&byte| byte == b'"');
        let length = length.ok_or_else(|| self.truncated(expected))?;
        let text = std::str::from_utf8(&inner[..length]);
        self.at = mark + length + 2;
        text.map_err(|_| self.malformed(mark, expected, "bytes that are no text"))
    }

    /// The given word is next.
    pub fn expect(&mut self, word: &'static str) -> Result<(), MshError> {
        let mark = self.mark();
        let found = self.word(word)?;
        if found == word {
            return Ok(());
        }
        Err(self.malformed(mark, word, found))
    }

    /// An error about what was read at a mark.
    pub fn malformed(&self, mark: usize, expected: &'static str, found: &str) -> MshError {
        MshError::Malformed {
            place: self.place(mark),
            expected,
            found: found.to_owned(),
        }
    }

    /// An error about the end of the file.
    fn truncated(&self, expected: &'static str) -> MshError {
        let place = self.place(self.bytes.len());
        MshError::Truncated { place, expected }
    }

    /// Moves past the end of the line.
    pub fn skip_line(&mut self) {
        let rest = &self.bytes[self.at..];
        let length = rest
            .iter()
            .position(|&byte| byte == b'\n')
            .map_or(rest.len(), |length| length + 1);
        self.at += length;
    }

    /// Moves behind the next occurrence of a text.
    pub fn skip_past(&mut self, text: &str, expected: &'static str) -> Result<(), MshError> {
        let rest = &self.bytes[self.at..];
        let found = rest.windows(text.len()).position(|window| window == text.as_bytes());
        self.at += found.ok_or_else(|| self.truncated(expected))? + text.len();
        Ok(())
    }

    fn array<const N: usize>(&mut self, expected: &'static str) -> Result<[u8; N], MshError> {
        let found = self.bytes[self.at..].first_chunk::<N>().copied();
        let mut array = found.ok_or_else(|| self.truncated(expected))?;
        self.at += N;
        if self.encoding == Encoding::BigEndian {
            array.reverse();
        }
        Ok(array)
    }

    /// A 32-bit integer that is not negative.
    pub fn integer(&mut self, expected: &'static str) -> Result<u64, MshError> {
        if self.encoding == Encoding::Text {
            return self.parse(expected);
        }
        let mark = self.mark();
        let value = i32::from_le_bytes(self.array(expected)?);
        u64::try_from(value).map_err(|_| self.malformed(mark, expected, &value.to_string()))
    }

    /// A 32-bit integer of any sign.
    pub fn signed_integer(&mut self, expected: &'static str) -> Result<i64, MshError> {
        if self.encoding == Encoding::Text {
            return self.parse(expected);
        }
        Ok(i32::from_le_bytes(self.array(expected)?).into())
    }

    /// A 64-bit integer.
    pub fn size(&mut self, expected: &'static str) -> Result<u64, MshError> {
        if self.encoding == Encoding::Text {
            return self.parse(expected);
        }
        Ok(u64::from_le_bytes(self.array(expected)?))
    }

    /// A 64-bit number.
    pub fn real(&mut self, expected: &'static str) -> Result<f64, MshError> {
        if self.encoding == Encoding::Text {
            return self.parse(expected);
        }
        Ok(f64::from_le_bytes(self.array(expected)?))
    }
}
