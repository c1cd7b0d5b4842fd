//! The one error type of the crate.

use thiserror::Error;

/// Everything that can be wrong with a target, its parameters, its data or a request for it.
///
/// Each variant carries the field, file, line or value that a message needs; the library itself prints nothing.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TargetError {
    /// A number that has to be finite is NaN or infinite.
    #[error("{field} is {value}: it must be a finite number")]
    NotFinite {
        /// The field.
        field: String,
        /// The offending value.
        value: f64,
    },
    /// A number lies outside of the range it may have.
    #[error("{field} is {value}: allowed is {allowed}")]
    OutOfRange {
        /// The field.
        field: String,
        /// The offending value.
        value: f64,
        /// The range in words.
        allowed: &'static str,
    },
    /// A list that needs an entry has none.
    #[error("{field} is empty")]
    Empty {
        /// The field.
        field: String,
    },
    /// A list has the wrong length.
    #[error("{field} has length {found}, expected {expected}")]
    Length {
        /// The field.
        field: String,
        /// The length that fits.
        expected: usize,
        /// The length that was given.
        found: usize,
    },
    /// A covariance is not symmetric.
    #[error("{field} is not symmetric: its entries of x{r} and x{c} and of x{c} and x{r} differ by {difference:e}", r = .row + 1, c = .column + 1)]
    NotSymmetric {
        /// The field.
        field: String,
        /// Row of the worst entry, counted from 0; in messages from 1.
        row: usize,
        /// Column of the worst entry, counted from 0; in messages from 1.
        column: usize,
        /// Their difference.
        difference: f64,
    },
    /// A covariance or a Hessian is not positive definite.
    #[error("{field} is not positive definite (pivot {value:e} of x{})", .axis + 1)]
    NotPositiveDefinite {
        /// The field.
        field: String,
        /// The axis, counted from 0 (in messages from 1, as in files), on which the factorisation stopped.
        axis: usize,
        /// The pivot met there.
        value: f64,
    },
    /// The curvature of a model's posterior is zero in the direction of a column of its data, to rounding.
    #[error("{field} is not positive definite (pivot {value:e} of column '{column}' of {file})")]
    Undetermined {
        /// The Hessian.
        field: String,
        /// The column's name.
        column: String,
        /// Where the data come from.
        file: String,
        /// The pivot met there.
        value: f64,
    },

    /// No target has this name.
    #[error("unknown target '{name}': known are {known}")]
    UnknownTarget {
        /// The name asked for.
        name: String,
        /// The names that exist, separated by commas.
        known: String,
    },
    /// A parameter was given that the target does not have.
    #[error("target '{target}' has no parameter '{parameter}' (given as {value}): {allowed}")]
    ParameterNotAllowed {
        /// The target.
        target: String,
        /// The parameter.
        parameter: &'static str,
        /// Its value, as text.
        value: String,
        /// The parameters it has, in words.
        allowed: String,
    },
    /// A parameter that the target cannot do without is missing.
    #[error("target '{target}' needs the parameter '{parameter}'")]
    ParameterMissing {
        /// The target.
        target: String,
        /// The parameter.
        parameter: &'static str,
    },
    /// The target leaves the dimension free and none was given.
    #[error("target '{target}' needs a dimension: {allowed}")]
    DimensionMissing {
        /// The target.
        target: String,
        /// The dimensions it has, in words.
        allowed: String,
    },
    /// The target does not exist in this dimension.
    #[error("dimension {dimension} does not fit target '{target}': {allowed}")]
    DimensionNotAllowed {
        /// The target.
        target: String,
        /// The dimension asked for.
        dimension: usize,
        /// The dimensions it has, in words.
        allowed: String,
    },

    /// The data file could not be opened or read.
    #[error("cannot read {file}: {reason}")]
    DataUnreadable {
        /// The file.
        file: String,
        /// What the system said.
        reason: String,
    },
    /// The file holds nothing, or nothing but blank lines.
    #[error("{file} is empty: a header and rows of data are expected")]
    DataEmpty {
        /// The file.
        file: String,
    },
    /// The first line holds nothing but numbers: data, not names.
    #[error(
        "{file}, line {line}: only numbers, where a header is expected: the names of the columns, that of the response first"
    )]
    DataHeaderMissing {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
    },
    /// A column of the header has no name.
    #[error("{file}, line {line}: column {column} of the header is empty")]
    DataHeaderEmpty {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The column, counted from 1.
        column: usize,
    },
    /// Two columns share a name.
    #[error("{file}, line {line}: the column name '{column}' appears twice")]
    DataHeaderDuplicate {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The repeated name.
        column: String,
    },
    /// A row has more or fewer cells than the header.
    #[error("{file}, line {line}: the number of cells is {found}, that of columns in the header {expected}")]
    DataRaggedRow {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The number of columns of the header.
        expected: usize,
        /// The number of cells of the row.
        found: usize,
    },
    /// A cell is empty.
    #[error("{file}, line {line}: column '{column}' is empty")]
    DataMissingCell {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The column's name.
        column: String,
    },
    /// A cell is not a number.
    #[error("{file}, line {line}: column '{column}' holds '{value}', which is not a number")]
    DataNotNumeric {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// The cell's text.
        value: String,
    },
    /// A cell is NaN, infinite or too large for a 64-bit number.
    #[error("{file}, line {line}: column '{column}' holds '{value}', which is not finite")]
    DataNotFinite {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// The cell's text.
        value: String,
    },
    /// A cell is so large that sums of squares are infinite.
    #[error(
        "{file}, line {line}: column '{column}' holds '{value}', beyond ±{largest:e}, where sums of squares are not finite"
    )]
    DataTooLarge {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// The cell's text.
        value: String,
        /// The largest size that a cell may have.
        largest: f64,
    },
    /// The response of a regression is not one that its model can have: 0 or 1, or a count.
    #[error("{file}, line {line}: the response '{column}' is '{value}', it must be {allowed}")]
    DataResponse {
        /// The file.
        file: String,
        /// The line, counted from 1.
        line: u64,
        /// The column's name.
        column: String,
        /// The cell's text.
        value: String,
        /// What it may be, in words.
        allowed: &'static str,
    },
    /// The file has a header and nothing else.
    #[error("{file} has no rows of data")]
    DataNoRows {
        /// The file.
        file: String,
    },
    /// The file has more covariates than the crate has dimensions.
    #[error("{file} has {found} covariates; with the intercept at most {maximum} are possible")]
    DataTooManyCovariates {
        /// The file.
        file: String,
        /// The number of covariates found.
        found: usize,
        /// The largest number possible.
        maximum: usize,
    },
    /// The columns are linearly dependent and the prior does not make up for it.
    #[error(
        "{file}: linear dependence of {}, without a proper prior there, makes the posterior improper",
        named(.columns)
    )]
    DataCollinear {
        /// The file.
        file: String,
        /// The names of the columns involved, separated by commas.
        columns: String,
    },
    /// A hyperplane separates the responses and the prior does not bound the coefficients.
    #[error(
        "{file}: perfect separation of the responses by {}, without a proper prior there, makes the posterior improper",
        named(.columns)
    )]
    DataSeparated {
        /// The file.
        file: String,
        /// The names of the columns whose coefficients diverge, separated by commas.
        columns: String,
    },

    /// A program that evaluates a density does not start, has ended or answers something else than numbers.
    #[error("program `{command}` {reason}")]
    ProgramFailed {
        /// The command line.
        command: String,
        /// What went wrong, with the question.
        reason: String,
    },

    /// Newton's method did not find the mode.
    #[error(
        "no mode found for '{target}' after {iterations} Newton steps (last step {step:e} posterior standard deviations)"
    )]
    ModeNotFound {
        /// The target.
        target: String,
        /// The number of steps taken.
        iterations: usize,
        /// Length of the last step in posterior standard deviations.
        step: f64,
    },
    /// Importance sampling met a density or weight it cannot use.
    #[error("importance sampling of '{target}' failed: {reason}")]
    ReferenceFailed {
        /// The target.
        target: String,
        /// What went wrong, with the value.
        reason: String,
    },
}

/// `Ok(value)` for a finite number, else [`TargetError::NotFinite`].
pub(crate) fn finite(field: &str, value: f64) -> Result<f64, TargetError> {
    if value.is_finite() {
        Ok(value)
    } else {
        Err(TargetError::NotFinite {
            field: field.to_owned(),
            value,
        })
    }
}

/// What columns are called, by their names.
fn named(columns: &str) -> String {
    let several = columns.contains(", ");
    format!("the column{} {columns}", if several { "s" } else { "" })
}

/// `Ok(value)` for a finite number above zero.
pub(crate) fn positive(field: &str, value: f64) -> Result<f64, TargetError> {
    finite(field, value)?;
    within(field, value, value > 0.0, "a number above 0")
}

/// `Ok(value)` for a value that is allowed, else [`TargetError::OutOfRange`].
pub(crate) fn within(field: &str, value: f64, is_allowed: bool, allowed: &'static str) -> Result<f64, TargetError> {
    if is_allowed {
        return Ok(value);
    }
    Err(TargetError::OutOfRange {
        field: field.to_owned(),
        value,
        allowed,
    })
}

/// The error that a target which needs two coordinates was asked for in fewer.
pub(crate) fn at_least_two(target: &str, dimension: usize) -> Result<(), TargetError> {
    if dimension >= 2 {
        Ok(())
    } else {
        Err(TargetError::DimensionNotAllowed {
            target: target.to_owned(),
            dimension,
            allowed: "2 or more".to_owned(),
        })
    }
}
