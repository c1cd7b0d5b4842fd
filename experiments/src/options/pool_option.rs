//! The flag `--pool`: what draws are chosen from, or the file for a weighted pool.

use std::path::PathBuf;

use clap::ValueEnum;

use super::{MethodName, MethodOptions, OptionError, PoolChoice};

impl MethodOptions {
    /// What Stein thinning chooses from, where it is said.
    ///
    /// # Errors
    /// A word that is none of the choices.
    pub(super) fn pool_choice(&self) -> Result<Option<PoolChoice>, OptionError> {
        let Some(path) = &self.pool else { return Ok(None) };
        let word = path.display().to_string();
        match PoolChoice::from_str(&word, false) {
            Ok(choice) => Ok(Some(choice)),
            Err(_) => Err(OptionError::out_of_range("pool", word, "`exact` or `nuts`")),
        }
    }

    /// Whether a method with these options draws by the No-U-Turn sampler.
    pub(super) fn uses_chains(&self, method: MethodName) -> bool {
        match method {
            MethodName::Nuts => true,
            MethodName::SteinThinning => matches!(self.pool_choice(), Ok(Some(PoolChoice::Nuts))),
            _ => false,
        }
    }

    /// The file that a method writes its weighted pool into.
    pub fn pool_file(&self, method: MethodName) -> Option<&PathBuf> {
        self.pool.as_ref().filter(|_| weighs(method))
    }

    /// Refuses a file for a pool, which belongs to a single run.
    pub(super) fn check_study(&self, method: MethodName) -> Result<(), OptionError> {
        match self.pool_file(method) {
            Some(file) => Err(OptionError::new(
                "pool",
                format!("{}: a study writes no pools, `parvi sample` does", file.display()),
            )),
            None => Ok(()),
        }
    }

    /// Refuses options of the No-U-Turn sampler where Stein thinning does not use it.
    pub(super) fn check_pool(&self, method: MethodName) -> Result<(), OptionError> {
        if method != MethodName::SteinThinning || self.pool_choice()? == Some(PoolChoice::Nuts) {
            return Ok(());
        }
        match self.given().find(|(name, _)| MethodName::Nuts.kind().has(name)) {
            None => Ok(()),
            Some((name, value)) => Err(OptionError::new(&name, format!("{value} needs the pool `nuts`"))),
        }
    }
}

/// Whether a method weighs a pool.
fn weighs(method: MethodName) -> bool {
    method.kind().has("pool") && method != MethodName::SteinThinning
}
