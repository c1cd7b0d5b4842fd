//! Options, and whatever else files and tables hold, whose values are words.

/// Choices by the words that are typed, in flags, files and tables; what `--help` says of a word is its documentation.
///
/// Where it is called, `clap` (with `derive`) and `serde` have to be known.
///
/// ```
/// parvi_options::words! {
///     /// Which way is up.
///     Way {
///         /// Up the hill
///         UpHill,
///         /// Down to the sea
///         DownHill,
///     }
/// }
/// assert_eq!(Way::UpHill.to_string(), "up-hill");
/// ```
#[macro_export]
macro_rules! words {
    ($($(#[$meta:meta])* $words:ident { $($(#[$about:meta])* $word:ident,)* })*) => {$(
        $(#[$meta])*
        #[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum, serde::Serialize, serde::Deserialize)]
        #[serde(rename_all = "kebab-case")]
        pub enum $words {
            $($(#[$about])* $word,)*
        }

        impl From<$words> for $crate::Value {
            fn from(word: $words) -> Self {
                word.to_string().into()
            }
        }

        impl std::fmt::Display for $words {
            fn fmt(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
                let word = clap::ValueEnum::to_possible_value(self);
                word.map_or(Ok(()), |word| formatter.write_str(word.get_name()))
            }
        }
    )*};
}
