/// What is wrong with snapshots; runs, frames and points are counted from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum SnapshotsError {
    /// There is nothing to learn from.
    #[error("snapshots without {what}")]
    Empty {
        /// What is missing: points, runs or frames.
        what: &'static str,
    },
    /// Δt or ρ₀ is not positive.
    #[error("{field} = {value}: must be positive and finite")]
    NotPositive {
        /// `interval` or `density`.
        field: &'static str,
        /// Its value.
        value: f64,
    },
    /// A reference position is NaN or infinite; the point behind the last one is the centroid.
    #[error("reference position of point {point} holds {value}")]
    Reference {
        /// The point.
        point: usize,
        /// The entry.
        value: f64,
    },
    /// A run has more or fewer parameters than names.
    #[error("run {run} has {found} parameters, not {expected}")]
    Parameters {
        /// The run.
        run: usize,
        /// Its number of parameters.
        found: usize,
        /// The number of names.
        expected: usize,
    },
    /// A parameter is NaN or infinite.
    #[error("run {run}: parameter {name} = {value}")]
    Parameter {
        /// The run.
        run: usize,
        /// The parameter.
        name: String,
        /// Its value.
        value: f64,
    },
    /// A frame is not later than the one before it, or its time is NaN or infinite.
    #[error("run {run}, frame {frame}: time {time}, must be finite and later than that of the frame before")]
    Time {
        /// The run.
        run: usize,
        /// The frame.
        frame: usize,
        /// Its time.
        time: f64,
    },
    /// A list has another number of points than the body.
    #[error("run {run}, frame {frame}: {field} of {found} points, not {expected}")]
    Length {
        /// The run.
        run: usize,
        /// The frame.
        frame: usize,
        /// The list.
        field: &'static str,
        /// Its length.
        found: usize,
        /// The body's number of points.
        expected: usize,
    },
    /// A value is NaN or infinite.
    #[error("run {run}, frame {frame}, point {point}: {field} is NaN or infinite")]
    NotFinite {
        /// The run.
        run: usize,
        /// The frame.
        frame: usize,
        /// The point.
        point: usize,
        /// The list.
        field: &'static str,
    },
    /// A deformation gradient turns space inside out.
    #[error("run {run}, frame {frame}, point {point}: det F = {determinant}, must be positive")]
    Inverted {
        /// The run.
        run: usize,
        /// The frame.
        frame: usize,
        /// The point.
        point: usize,
        /// det F.
        determinant: f64,
    },
    /// There is no run of that number.
    #[error("run {number} of {runs}")]
    NoSuchRun {
        /// The number.
        number: usize,
        /// How many runs there are.
        runs: usize,
    },
}
