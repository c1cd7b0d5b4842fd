//! Examples that print a line for each of several seeds.

/// What prints the line of a seed with so many particles, or another size.
pub type Line = fn(u64, usize) -> Result<(), Box<dyn std::error::Error>>;

/// Prints the lines of all seeds: the first seed, how many and a size are the arguments, as far as they are given.
///
/// # Errors
/// An argument that is no number, and what `lines` say.
pub fn print(defaults: [u64; 3], header: &str, lines: &[Line]) -> Result<(), Box<dyn std::error::Error>> {
    let mut arguments = std::env::args().skip(1);
    let mut number = |default: u64| arguments.next().map_or(Ok(default), |text| text.parse());
    let [first, count, size] = [number(defaults[0])?, number(defaults[1])?, number(defaults[2])?];
    println!("{header}");
    for seed in first..first + count {
        for line in lines {
            line(seed, usize::try_from(size)?)?;
        }
    }
    Ok(())
}
