//! Which command a file is for.

use std::path::Path;

use toml::Table;

use crate::CommandError;

/// The files that the command reads.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FileKind {
    /// Of `parvi run`.
    Study,
    /// Of `parvi simulate`.
    Scene,
    /// Of `parvi rom`.
    Experiment,
}

impl FileKind {
    /// Refuses a file that is clearly one of another command. What cannot be read or told is left to the reader that asks.
    ///
    /// # Errors
    /// [`CommandError::OtherKind`].
    pub fn check(self, file: &Path) -> Result<(), CommandError> {
        match Self::of_file(file) {
            Some(found) if found != self => {
                let ((found, command), (expected, _)) = (found.told(), self.told());
                let file = file.display();
                Err(CommandError::OtherKind(format!(
                    "{file} seems to be {found}, which `{command}` takes; this command takes {expected}"
                )))
            }
            _ => Ok(()),
        }
    }

    /// The kind of a file, where it can be read and told.
    pub fn of_file(file: &Path) -> Option<Self> {
        std::fs::read_to_string(file).ok().and_then(|text| Self::of(&text))
    }

    /// By the keys that one kind has to have and the others do not know.
    fn of(text: &str) -> Option<Self> {
        let table = text.parse::<Table>().ok()?;
        let has = |key| table.contains_key(key);
        match () {
            () if has("kind") => Some(Self::Study),
            () if has("trained_as") => Some(Self::Experiment),
            () if has("scene") && (has("cases") || has("parameters")) => Some(Self::Experiment),
            () if has("bodies") && !has("families") => Some(Self::Scene),
            () => None,
        }
    }

    /// In words, and the command that takes it.
    fn told(self) -> (&'static str, &'static str) {
        match self {
            Self::Study => ("the configuration of a study", "parvi run"),
            Self::Scene => ("a scene", "parvi simulate"),
            Self::Experiment => ("the configuration of a reduced-order model", "parvi rom train|run"),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_committed_file_is_known() {
        let root = Path::new(env!("CARGO_MANIFEST_DIR"));
        for (directory, kind) in [
            ("configs", FileKind::Study),
            ("scenes", FileKind::Scene),
            ("rom", FileKind::Experiment),
        ] {
            for entry in std::fs::read_dir(root.join(directory)).unwrap() {
                let path = entry.unwrap().path();
                if path.extension().is_some_and(|extension| extension == "toml") {
                    let text = std::fs::read_to_string(&path).unwrap();
                    assert_eq!(FileKind::of(&text), Some(kind), "{}", path.display());
                }
            }
        }
        assert_eq!(FileKind::of("title = 3"), None);
        assert_eq!(FileKind::of("kind = "), None);
    }
}
