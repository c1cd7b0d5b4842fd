//! The wells data: did households in Bangladesh change to a safer well?

use super::making::dimension_within;
use crate::{RegressionData, TargetError};

/// 3,020 households of Araihazar; see `data/README.md` for the columns and the source.
const WELLS: &str = include_str!("../../data/wells.csv");

/// The largest nested model.
pub const WELLS_MAXIMUM_DIMENSION: usize = 6;

/// The rows of `wells-small`.
pub const WELLS_SMALL_ROWS: usize = 40;

/// The names of the covariates in the order in which the nested models add them.
const NAMES: [&str; WELLS_MAXIMUM_DIMENSION - 1] = [
    "distance/100",
    "arsenic",
    "education/4",
    "association",
    "distance/100 x arsenic",
];

/// The first `rows` rows (all 3,020 for `None`) of the nested model with d = `dimension` coefficients.
///
/// In order: intercept; distance in 100 m; arsenic in 100 µg/l; schooling in units of 4 years; membership of an
/// association; distance × arsenic. The response is 1 for a household that switched. Source of data and models:
/// A. Gelman, J. Hill, *Data Analysis Using Regression and Multilevel/Hierarchical Models*, 2006, ch. 5.
///
/// # Errors
/// [`TargetError::DimensionNotAllowed`] unless 1 ≤ d ≤ 6; [`TargetError::DataNoRows`] for no rows.
pub fn wells(dimension: usize, rows: Option<usize>) -> Result<RegressionData, TargetError> {
    dimension_within("wells", dimension, 1..=WELLS_MAXIMUM_DIMENSION)?;
    let file = RegressionData::from_csv_reader(WELLS.as_bytes(), "wells.csv")?;
    let names = NAMES[..dimension - 1].iter().map(|&name| name.to_owned());
    let mut data = RegressionData::empty("wells.csv", names);
    for row in file
        .rows_of::<5>()?
        .iter()
        .zip(file.responses())
        .take(rows.unwrap_or(usize::MAX))
    {
        let (&[_, arsenic, distance, education, association], &response) = row;
        let distance = distance / 100.0;
        let all = [distance, arsenic, education / 4.0, association, distance * arsenic];
        data.push(response, &all[..dimension - 1]);
    }
    data.non_empty()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_data_are_those_of_the_book() {
        let data = wells(6, None).unwrap();
        assert_eq!((data.rows(), data.dimension()), (3020, 6));
        // 1,737 of 3,020 households switched.
        assert_eq!(data.responses().iter().filter(|&&switched| switched).count(), 1737);
        assert_eq!(
            data.covariates(0).unwrap(),
            [1.0, 0.16826, 2.36, 0.0, 0.0, 0.16826 * 2.36]
        );
        assert_eq!(wells(5, Some(WELLS_SMALL_ROWS)).unwrap().rows(), 40);
        assert!(matches!(
            wells(7, None),
            Err(TargetError::DimensionNotAllowed { dimension: 7, .. })
        ));
        assert!(wells(0, None).is_err());
    }
}
