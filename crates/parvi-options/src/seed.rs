//! Seeds of random choices.

/// The seed of a text.
///
/// # Errors
/// What seeds there are, for any other text.
pub fn seed(text: &str) -> Result<u64, String> {
    let number = text.parse();
    number.map_err(|_| format!("seeds are whole numbers from 0 to {}", u64::MAX))
}
