//! Particles as a NumPy array: f64, M × D, with further columns for the weights where they differ and for log p where it is noted.

use std::io::{self, Write};

use super::Particles;
use super::npy::array;

/// Writes the array in row-major order.
pub fn write(particles: &Particles, writer: &mut dyn Write) -> io::Result<()> {
    let further = particles.further_columns();
    let columns = particles.dimension() + further.len();
    let mut values = Vec::with_capacity(particles.len() * columns);
    for (index, row) in particles.rows().enumerate() {
        values.extend(row);
        let further = further.iter().map(|(_, values)| values.get(index).copied());
        values.extend(further.map(Option::unwrap_or_default));
    }
    writer.write_all(&array(&[particles.len() as u64, columns as u64], &values)?)
}

#[cfg(all(test, feature = "npy"))]
mod tests {
    use super::*;

    fn read(particles: &Particles) -> (Vec<u64>, Vec<f64>) {
        let mut bytes = Vec::new();
        write(particles, &mut bytes).unwrap();
        let array = npyz::NpyFile::new(bytes.as_slice()).unwrap();
        (array.shape().to_vec(), array.into_vec().unwrap())
    }

    #[test]
    fn shape_and_order_are_those_of_the_rows() {
        let particles = Particles::new(&[[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]], None);
        assert_eq!(read(&particles), (vec![3, 2], vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0]));
    }

    #[test]
    fn weights_are_the_last_column() {
        let particles = Particles::new(&[[1.0], [2.0]], Some(&[0.25, 0.75]));
        assert_eq!(read(&particles), (vec![2, 2], vec![1.0, 0.25, 2.0, 0.75]));
    }

    #[test]
    fn a_pool_has_two_columns_more() {
        let pool = Particles::new(&[[1.0], [2.0]], Some(&[1.0, 0.0])).with_log_densities(vec![-0.5, -1.5]);
        assert_eq!(read(&pool), (vec![2, 3], vec![1.0, 1.0, -0.5, 2.0, 0.0, -1.5]));
    }
}
