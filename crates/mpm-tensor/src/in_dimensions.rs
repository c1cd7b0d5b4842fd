/// Calls a function of a constant dimension in each of several ones, with the same arguments; with `?` behind them it hands failures on. For tests.
///
/// ```
/// use mpm_tensor::{Matrix, in_dimensions};
///
/// fn has_determinant<const D: usize>(determinant: f64) {
///     assert_eq!(Matrix::<D>::IDENTITY.determinant(), determinant);
/// }
///
/// in_dimensions!(has_determinant(1.0), 1, 2, 3);
/// ```
#[macro_export]
macro_rules! in_dimensions {
    ($check:ident $arguments:tt, $($dimension:literal),+) => {
        $($check::<$dimension> $arguments;)+
    };
    ($check:ident $arguments:tt?, $($dimension:literal),+) => {
        $($check::<$dimension> $arguments?;)+
    };
}
