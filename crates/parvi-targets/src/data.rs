//! Data of a regression: a response and a design matrix whose first column is the intercept.

use crate::error::{finite, within};
use crate::{Response, TargetError};

/// The name of the intercept's column.
const INTERCEPT: &str = "intercept";

/// The largest covariate: sums of squares of as many as there may be are finite.
pub(crate) const LARGEST_VALUE: f64 = 1e150;

/// n rows of a response y_i and d covariates x_i, the first of them the constant 1 of the intercept.
#[derive(Clone, Debug, PartialEq)]
pub struct RegressionTable<Y> {
    source: String,
    names: Vec<String>,
    /// n × d, row by row.
    covariates: Vec<f64>,
    responses: Vec<Y>,
}

/// Responses 0 or 1, for a logistic or probit regression.
pub type RegressionData = RegressionTable<bool>;

/// Counts, for a Poisson regression.
pub type CountData = RegressionTable<u32>;

impl<Y: Response> RegressionTable<Y> {
    /// Data from memory; the intercept is put in front of the covariates of every row.
    ///
    /// `source` names the data in error messages, `names` the covariates (without the intercept); `rows` holds a response
    /// and as many covariates as there are names per row.
    ///
    /// # Errors
    /// [`TargetError::DataNoRows`]; [`TargetError::Length`] for a row of another length; [`TargetError::NotFinite`], and [`TargetError::OutOfRange`] beyond 1e150,
    /// where sums of squares are not finite.
    pub fn new(source: &str, names: &[&str], rows: &[(Y, Vec<f64>)]) -> Result<Self, TargetError> {
        let mut data = Self::empty(source, names.iter().map(|&name| name.to_owned()));
        for (index, (response, covariates)) in rows.iter().enumerate() {
            if covariates.len() != names.len() {
                return Err(TargetError::Length {
                    field: format!("row {index} of {source}"),
                    expected: names.len(),
                    found: covariates.len(),
                });
            }
            for (name, &value) in names.iter().zip(covariates) {
                let field = format!("'{name}' in row {index} of {source}");
                finite(&field, value)?;
                within(&field, value, value.abs() <= LARGEST_VALUE, "-1e150 to 1e150")?;
            }
            data.push(*response, covariates);
        }
        data.non_empty()
    }

    /// No rows yet; `names` without the intercept.
    pub(crate) fn empty(source: &str, names: impl Iterator<Item = String>) -> Self {
        let names = std::iter::once(INTERCEPT.to_owned()).chain(names).collect();
        Self {
            source: source.to_owned(),
            names,
            covariates: Vec::new(),
            responses: Vec::new(),
        }
    }

    /// Appends a row; `covariates` without the intercept, as many as there are names.
    pub(crate) fn push(&mut self, response: Y, covariates: &[f64]) {
        debug_assert_eq!(covariates.len() + 1, self.names.len());
        self.responses.push(response);
        self.covariates.push(1.0);
        self.covariates.extend_from_slice(covariates);
    }

    /// Itself, or the error that there are no rows.
    pub(crate) fn non_empty(self) -> Result<Self, TargetError> {
        if self.responses.is_empty() {
            Err(TargetError::DataNoRows { file: self.source })
        } else {
            Ok(self)
        }
    }

    /// The file or name that error messages show.
    pub fn source(&self) -> &str {
        &self.source
    }

    /// The d column names, `intercept` first.
    pub fn names(&self) -> &[String] {
        &self.names
    }

    /// The dimension d of the regression: the number of covariates, plus one for the intercept.
    pub fn dimension(&self) -> usize {
        self.names.len()
    }

    /// The number of rows n, at least one.
    pub fn rows(&self) -> usize {
        self.responses.len()
    }

    /// The responses y_i.
    pub fn responses(&self) -> &[Y] {
        &self.responses
    }

    /// The d covariates of row `row`, the intercept's 1 first; `None` beyond the last row.
    pub fn covariates(&self, row: usize) -> Option<&[f64]> {
        let d = self.dimension();
        self.covariates.get(row.checked_mul(d)?..)?.get(..d)
    }

    /// The rows as arrays of length D, or the error that D is not the data's dimension.
    pub(crate) fn rows_of<const D: usize>(&self) -> Result<Vec<[f64; D]>, TargetError> {
        let (rows, rest) = self.covariates.as_chunks::<D>();
        if D != self.dimension() || !rest.is_empty() {
            return Err(TargetError::Length {
                field: format!("the coefficient vector of {}", self.source),
                expected: self.dimension(),
                found: D,
            });
        }
        Ok(rows.to_vec())
    }
}
