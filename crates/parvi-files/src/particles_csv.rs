//! Particles as comma-separated values.

use std::io::{self, Write};
use std::path::Path;

use super::particles::{LOG_DENSITY, WEIGHT};
use super::{FileError, NumberTable, Particles, distinct_names};

/// What the columns of coordinates are called.
pub fn column_names(names: &[String], dimension: usize) -> Vec<String> {
    distinct_names(names, dimension, &[WEIGHT, LOG_DENSITY])
}

/// Writes a header and one particle per row: its coordinates, its weight where weights differ, log p where it is noted.
///
/// Columns are called as [`distinct_names`] says, and quoted where they have to be. Numbers are the shortest that read back to the same bits.
///
/// # Errors
/// Those of the writer.
pub fn write(particles: &Particles, names: &[String], writer: &mut dyn Write) -> io::Result<()> {
    let mut header = column_names(names, particles.dimension());
    let further = particles.further_columns();
    header.extend(further.iter().map(|(name, _)| (*name).to_owned()));
    csv::Writer::from_writer(&mut *writer).write_record(header)?;
    for (index, row) in particles.rows().enumerate() {
        for (axis, value) in row.iter().enumerate() {
            if axis > 0 {
                write!(writer, ",")?;
            }
            write!(writer, "{value:?}")?;
        }
        for (_, values) in &further {
            write!(writer, ",{:?}", values.get(index).copied().unwrap_or(0.0))?;
        }
        writeln!(writer)?;
    }
    Ok(())
}

/// Reads what [`write`](fn@write) writes of particles without log p.
///
/// # Errors
/// [`FileError::Unreadable`] with the line of a row that does not fit.
pub fn read(path: &Path) -> Result<Particles, FileError> {
    let unreadable = |message: String| FileError::unreadable(path, message);
    let table = NumberTable::of_csv(path).map_err(unreadable)?;
    let weighted = table.header.last().is_some_and(|name| name == WEIGHT);
    let dimension = table.columns - usize::from(weighted);
    if dimension == 0 {
        return Err(unreadable("no coordinate in the header".to_owned()));
    }
    let rows = || table.numbers.chunks_exact(table.columns);
    let coordinates = rows().flat_map(|row| &row[..dimension]).copied().collect();
    let weights = weighted.then(|| rows().map(|row| row[dimension]).collect());
    Ok(Particles::from_coordinates(dimension, coordinates, weights))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text(particles: &Particles) -> String {
        let mut bytes = Vec::new();
        write(particles, &[], &mut bytes).unwrap();
        String::from_utf8(bytes).unwrap()
    }

    #[test]
    fn numbers_are_the_shortest_that_read_back() {
        let particles = Particles::new(&[[0.1, -2.0], [1e-300, 1.0 / 3.0]], None);
        assert_eq!(text(&particles), "x1,x2\n0.1,-2.0\n1e-300,0.3333333333333333\n");
    }

    #[test]
    fn weights_are_the_last_column() {
        let particles = Particles::new(&[[1.5], [2.5]], Some(&[0.25, 0.75]));
        assert_eq!(text(&particles), "x1,weight\n1.5,0.25\n2.5,0.75\n");
    }

    #[test]
    fn a_pool_has_weights_and_log_densities() {
        let pool = Particles::new(&[[1.5], [2.5]], Some(&[1.0, 0.0])).with_log_densities(vec![-0.5, f64::NEG_INFINITY]);
        assert_eq!(text(&pool), "x1,weight,log_density\n1.5,1.0,-0.5\n2.5,0.0,-inf\n");
    }

    #[test]
    fn columns_have_the_names_of_their_coordinates() {
        let names = ["intercept", "age, in years", "weight"].map(str::to_owned);
        let mut bytes = Vec::new();
        write(&Particles::new(&[[1.0, 2.0, 3.0]], None), &names, &mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        assert_eq!(text, "intercept,\"age, in years\",x3\n1.0,2.0,3.0\n");
    }

    #[test]
    fn reading_gives_the_same_bits() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("x.csv");
        let particles = Particles::new(&[[0.1 + 0.2, -1e300], [f64::MIN_POSITIVE, 7.0]], Some(&[0.5, 0.5]));
        std::fs::write(&path, text(&particles)).unwrap();
        assert_eq!(read(&path).unwrap(), particles);
    }

    #[test]
    fn a_bad_cell_is_reported_with_its_line() {
        let directory = tempfile::tempdir().unwrap();
        let path = directory.path().join("x.csv");
        std::fs::write(&path, "x1,x2\n1,2\n3,four\n").unwrap();
        let message = read(&path).unwrap_err().to_string();
        assert!(message.contains("line 3: 'four' is not a number"), "{message}");
    }
}
