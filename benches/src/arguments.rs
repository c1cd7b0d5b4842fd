//! Arguments of the plain benchmarks, by place.

#![allow(clippy::print_stderr)]

use std::process::exit;
use std::str::FromStr;

/// The words behind the program's name.
pub struct Arguments {
    usage: &'static str,
    words: Vec<String>,
}

impl Arguments {
    /// Those of this process; with `--help` or `-h` among them, `usage` is printed and the process ends.
    pub fn of_process(usage: &'static str) -> Self {
        let words: Vec<String> = std::env::args().skip(1).collect();
        if words.iter().any(|word| word == "--help" || word == "-h") {
            crate::say(usage);
            exit(0);
        }
        Self { usage, words }
    }

    /// The word at a place.
    pub fn word<'a>(&'a self, place: usize, default: &'a str) -> &'a str {
        self.words.get(place).map_or(default, String::as_str)
    }

    /// The number at a place.
    pub fn number<T: FromStr>(&self, place: usize, default: T) -> T {
        let Some(word) = self.words.get(place) else {
            return default;
        };
        match word.parse() {
            Ok(number) => number,
            Err(_) => self.refuse(word),
        }
    }

    /// Say that a word has no meaning here and end the process.
    pub fn refuse(&self, word: &str) -> ! {
        eprintln!("'{word}' has no meaning here\n{}", self.usage);
        exit(2);
    }
}
