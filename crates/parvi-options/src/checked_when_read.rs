//! Types of configurations that are checked while they are read.

/// A type that is refused while reading where its `check` refuses it.
macro_rules! checked_when_read {
    ($type:ident) => {
        impl<'de> serde::Deserialize<'de> for $type {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                let stated = Self::deserialize(deserializer)?;
                stated.check().map_err(serde::de::Error::custom)?;
                Ok(stated)
            }
        }
    };
}
pub(crate) use checked_when_read;
