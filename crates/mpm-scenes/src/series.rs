//! The time series of a run.

/// Columns of numbers over time, one row per instant.
///
/// Columns (D = 2; x, y, z as many as there are axes): `time`, `centre_x`, `centre_y`, `kinetic_energy`, `affine_energy` (with affine particles only), `strain_energy`,
/// `potential_energy`, `barrier_energy` (with a barrier only), those of the energy budget (where a scene asks for it: `transfer_dissipation`, `friction_dissipation`, `contact_dissipation`, `damping_dissipation`,
/// `viscous_dissipation`, `time_integration_dissipation`, `boundary_work`, `load_work`, `energy_balance`), `momentum_x`, `momentum_y`, `angular_momentum` (D = 3: `angular_momentum_x` …; D = 1: none),
/// `lower_x`, `upper_x`, … (the particles' bounding box) the columns of the probes, as in `tip_displacement_x`, and with an energy budget `traction_work`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    columns: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Series {
    /// A series without rows.
    pub fn new(columns: Vec<String>) -> Self {
        Self {
            columns,
            rows: Vec::new(),
        }
    }

    /// The names of the columns; the first is `time`.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The rows, in the order of time.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// A column by its name, if there is such a one.
    pub fn column(&self, name: &str) -> Option<Vec<f64>> {
        let index = self.columns.iter().position(|column| column == name)?;
        self.rows.iter().map(|row| row.get(index).copied()).collect()
    }

    /// Adds a row; false, and nothing is added, unless it has one value per column.
    pub fn push(&mut self, row: Vec<f64>) -> bool {
        let fits = row.len() == self.columns.len();
        if fits {
            self.rows.push(row);
        }
        fits
    }

    /// Forgets all rows but the first `count`.
    pub fn truncate(&mut self, count: usize) {
        self.rows.truncate(count);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_found_by_name_and_rows_fit() {
        let mut series = Series::new(vec!["time".into(), "a".into()]);
        assert!(series.push(vec![0.0, 1.0]) && series.push(vec![0.5, 2.0]));
        assert!(!series.push(vec![0.0]));
        assert_eq!(series.column("a"), Some(vec![1.0, 2.0]));
        assert_eq!(series.column("b"), None);
    }
}
