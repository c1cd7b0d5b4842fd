//! One-dimensional B-spline kernels (MPM-ParVI paper, Eqs. 33–35; Steffen, Kirby & Berzins 2008).

/// A cardinal B-spline N(r), r = x/h, that touches `W` grid nodes per axis from any position.
///
/// Σ_i N(u − i) = 1 for every u (partition of unity) and Σ_i i N(u − i) = u (linear reproduction).
pub trait Spline<const W: usize>: Copy + Default + Send + Sync + 'static {
    /// Name on the command line.
    const NAME: &'static str;

    /// N(r), r in units of the spacing.
    fn value(r: f64) -> f64;

    /// dN/dr.
    fn derivative(r: f64) -> f64;

    /// D_p = `moment` · h² · I is Σ_i w_ip (x_i − x_p)(x_i − x_p)ᵀ, where that is the same for every position.
    ///
    /// `None` for hat functions, whose second moment vanishes at the nodes (Jiang et al. 2015, §5.3).
    const SECOND_MOMENT: Option<f64>;

    /// All nodes touched from the grid coordinate `u` = x/h, |u| < 2⁵¹, with values and derivatives. Beyond, and for NaN, the
    /// row is without meaning.
    fn row(u: f64) -> Row<W>;
}

/// The `W` nodes base, base + 1, … touched from one coordinate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<const W: usize> {
    /// Index of the first node.
    pub base: i64,
    /// N(u − base − j); not negative but for the rounding of u.
    pub weights: [f64; W],
    /// dN/du (u − base − j), per unit of the grid coordinate.
    pub derivatives: [f64; W],
}

/// The integer nearest to u, ties to even; exact for |u| < 2⁵¹.
///
/// Adding 1.5 · 2⁵² leaves no bits for a fraction. Two additions: `f64::floor` is a function call on baseline x86-64, and a
/// conversion to an integer and back has three times the latency, on which every weight waits.
#[inline(always)]
fn round(u: f64) -> f64 {
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (u + SHIFT) - SHIFT
}

/// Hat function: 1 − |r| on |r| < 1 (Eq. 33).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Linear;

impl Spline<2> for Linear {
    const NAME: &'static str = "linear";
    const SECOND_MOMENT: Option<f64> = None;

    fn value(r: f64) -> f64 {
        (1.0 - r.abs()).max(0.0)
    }

    fn derivative(r: f64) -> f64 {
        if r.abs() < 1.0 { -r.signum() } else { 0.0 }
    }

    #[inline(always)]
    fn row(u: f64) -> Row<2> {
        let base = round(u - 0.5);
        let f = u - base;
        Row {
            base: base as i64,
            weights: [1.0 - f, f],
            derivatives: [-1.0, 1.0],
        }
    }
}

/// Quadratic B-spline: ¾ − r² on |r| < ½, ½(3/2 − |r|)² on |r| < 3/2 (Eq. 34).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quadratic;

impl Spline<3> for Quadratic {
    const NAME: &'static str = "quadratic";
    const SECOND_MOMENT: Option<f64> = Some(0.25);

    fn value(r: f64) -> f64 {
        let r = r.abs();
        if r < 0.5 {
            0.75 - r * r
        } else if r < 1.5 {
            0.5 * (1.5 - r) * (1.5 - r)
        } else {
            0.0
        }
    }

    fn derivative(r: f64) -> f64 {
        let s = r.abs();
        if s < 0.5 {
            -2.0 * r
        } else if s < 1.5 {
            (s - 1.5) * r.signum()
        } else {
            0.0
        }
    }

    #[inline(always)]
    fn row(u: f64) -> Row<3> {
        let base = round(u) - 1.0;
        let f = u - base; // in [½, 3/2]: distance to the first node
        let (left, right) = (1.5 - f, f - 0.5);
        let centre = f - 1.0;
        Row {
            base: base as i64,
            weights: [0.5 * left * left, 0.75 - centre * centre, 0.5 * right * right],
            derivatives: [-left, -2.0 * centre, right],
        }
    }
}

/// Cubic B-spline: ½|r|³ − r² + ⅔ on |r| < 1, (2 − |r|)³/6 on |r| < 2 (Eq. 35).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Cubic;

impl Spline<4> for Cubic {
    const NAME: &'static str = "cubic";
    const SECOND_MOMENT: Option<f64> = Some(1.0 / 3.0);

    fn value(r: f64) -> f64 {
        let r = r.abs();
        if r < 1.0 {
            (0.5 * r - 1.0) * r * r + 2.0 / 3.0
        } else if r < 2.0 {
            (2.0 - r).powi(3) / 6.0
        } else {
            0.0
        }
    }

    fn derivative(r: f64) -> f64 {
        let s = r.abs();
        if s < 1.0 {
            (1.5 * s - 2.0) * r
        } else if s < 2.0 {
            -0.5 * (2.0 - s) * (2.0 - s) * r.signum()
        } else {
            0.0
        }
    }

    #[inline(always)]
    fn row(u: f64) -> Row<4> {
        let base = round(u - 0.5) - 1.0;
        let f = u - base; // in [1, 2]: distance to the first node
        let (a, b, c, d) = (2.0 - f, f - 1.0, 2.0 - f, f - 1.0);
        let inner = |r: f64| (0.5 * r - 1.0) * r * r + 2.0 / 3.0;
        let slope = |r: f64| (1.5 * r - 2.0) * r;
        Row {
            base: base as i64,
            weights: [a * a * a / 6.0, inner(b), inner(c), d * d * d / 6.0],
            derivatives: [-0.5 * a * a, slope(b), -slope(c), 0.5 * d * d],
        }
    }
}
