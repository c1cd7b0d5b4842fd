//! Choices by their words in files, and counts in words.

/// An enum without data whose variants have these words, wherever it is read or written.
macro_rules! words {
    ($(#[$meta:meta])* $name:ident { $($(#[$of:meta])* $variant:ident = $word:literal,)* }) => {
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
        pub enum $name {
            $($(#[$of])* #[serde(rename = $word)] $variant,)*
        }

        impl $name {
            /// As in files.
            pub fn name(self) -> &'static str {
                match self {
                    $(Self::$variant => $word,)*
                }
            }
        }
    };
}

pub(crate) use words;

/// So many of what a word says: `1 run`, `2 runs`.
pub(crate) fn in_number(count: usize, one: &str) -> String {
    format!("{count} {one}{}", if count == 1 { "" } else { "s" })
}

#[cfg(test)]
mod tests {
    use crate::online::OnlineError;

    #[test]
    fn one_is_counted_as_one() {
        let told = |found, points| OnlineError::TooManySamples { found, points }.to_string();
        assert_eq!(told(2, 1), "2 sample points of 1 material point");
    }
}
