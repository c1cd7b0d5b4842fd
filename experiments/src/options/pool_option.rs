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
        let weighs = method.kind().has("pool") && method != MethodName::SteinThinning;
        self.pool.as_ref().filter(|_| weighs)
    }
}
