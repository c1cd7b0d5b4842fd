//! One-dimensional B-spline kernels (MPM-ParVI paper, Eqs. 33–35; Steffen, Kirby & Berzins 2008).

use crate::lanes::Lanes;

/// A cardinal B-spline N(r), r = x/h, that touches `W` grid nodes per axis from any position.
///
/// Σ_i N(u − i) = 1 for every u (partition of unity) and Σ_i i N(u − i) = u (linear reproduction).
pub trait Spline<const W: usize>: Copy + Default + Send + Sync + 'static {
    /// Name on the command line.
    const NAME: &'static str;

    /// N(r), r in units of the spacing.
    fn value(&self, r: f64) -> f64;

    /// dN/dr.
    fn derivative(&self, r: f64) -> f64;

    /// D_p = Σ_i w_ip (x_i − x_p)(x_i − x_p)ᵀ.
    const SECOND_MOMENT: SecondMoment;

    /// Whether this is the kernel that [`QuadraticCube`](crate::QuadraticCube) is written for.
    const IS_QUADRATIC: bool = false;

    /// All nodes touched from four grid coordinates u = x/h side by side, |u| < 2⁵¹, with values and derivatives. Beyond, and for NaN,
    /// the rows are without meaning. The first of them is that of the default, whatever else varies among kernels of a kind.
    fn rows(&self, u: Lanes) -> Rows<W>;

    /// [`rows`](Self::rows) of one coordinate.
    #[inline(always)]
    fn row(&self, u: f64) -> Row<W> {
        let rows = self.rows(Lanes::splat(u));
        let first = |lanes: Lanes| lanes.to_array()[0];
        Row {
            base: first(rows.base) as i64,
            weights: rows.weights.map(first),
            derivatives: rows.derivatives.map(first),
        }
    }
}

/// The second moment D_p of a tensor product of kernels, on which the affine part of a velocity is spread.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SecondMoment {
    /// D_p is this number times h² I, at every position.
    Constant(f64),
    /// D_p vanishes somewhere, as that of hat functions does at the nodes; ∇w_ip stands for w_ip D_p⁻¹ (x_i − x_p), which it
    /// equals elsewhere (Jiang et al. 2015, §5.3).
    Gradient,
    /// D_p = diag(m_1, …, m_D) depends on the position and is positive definite.
    Varies,
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

/// As [`Row`], for four coordinates side by side.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rows<const W: usize> {
    /// Index of the first node.
    pub base: Lanes,
    /// N(u − base − j).
    pub weights: [Lanes; W],
    /// dN/du (u − base − j).
    pub derivatives: [Lanes; W],
}

/// The integer nearest to u, ties to even; exact for |u| < 2⁵¹.
///
/// Adding 1.5 · 2⁵² leaves no bits for a fraction. Two additions: `f64::floor` is a function call on baseline x86-64, and a
/// conversion to an integer and back has three times the latency, on which every weight waits.
#[inline(always)]
pub(crate) fn round(u: Lanes) -> Lanes {
    const SHIFT: f64 = 6_755_399_441_055_744.0;
    (u + SHIFT) - SHIFT
}

/// Hat function: 1 − |r| on |r| < 1 (Eq. 33).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Linear;

impl Spline<2> for Linear {
    const NAME: &'static str = "linear";
    const SECOND_MOMENT: SecondMoment = SecondMoment::Gradient;

    fn value(&self, r: f64) -> f64 {
        (1.0 - r.abs()).max(0.0)
    }

    fn derivative(&self, r: f64) -> f64 {
        if r.abs() < 1.0 { -r.signum() } else { 0.0 }
    }

    #[inline(always)]
    fn rows(&self, u: Lanes) -> Rows<2> {
        let base = round(u - 0.5);
        let f = u - base;
        Rows {
            base,
            weights: [1.0 - f, f],
            derivatives: [Lanes::splat(-1.0), Lanes::splat(1.0)],
        }
    }
}

/// Quadratic B-spline: ¾ − r² on |r| < ½, ½(3/2 − |r|)² on |r| < 3/2 (Eq. 34).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quadratic;

impl Spline<3> for Quadratic {
    const NAME: &'static str = "quadratic";
    const SECOND_MOMENT: SecondMoment = SecondMoment::Constant(0.25);
    const IS_QUADRATIC: bool = true;

    fn value(&self, r: f64) -> f64 {
        let r = r.abs();
        if r < 0.5 {
            0.75 - r * r
        } else if r < 1.5 {
            0.5 * (1.5 - r) * (1.5 - r)
        } else {
            0.0
        }
    }

    fn derivative(&self, r: f64) -> f64 {
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
    fn rows(&self, u: Lanes) -> Rows<3> {
        let base = round(u) - 1.0;
        let f = u - base; // in [½, 3/2]: distance to the first node
        let (left, right) = (1.5 - f, f - 0.5);
        let centre = f - 1.0;
        Rows {
            base,
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
    const SECOND_MOMENT: SecondMoment = SecondMoment::Constant(1.0 / 3.0);

    fn value(&self, r: f64) -> f64 {
        let r = r.abs();
        if r < 1.0 {
            (0.5 * r - 1.0) * r * r + 2.0 / 3.0
        } else if r < 2.0 {
            (2.0 - r).powi(3) / 6.0
        } else {
            0.0
        }
    }

    fn derivative(&self, r: f64) -> f64 {
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
    fn rows(&self, u: Lanes) -> Rows<4> {
        let base = round(u - 0.5) - 1.0;
        let f = u - base; // in [1, 2]: distance to the first node
        let (left, right) = (2.0 - f, f - 1.0);
        let (first, last) = (left * left * left / 6.0, right * right * right / 6.0);
        let (falling, rising) = (-0.5 * left * left, 0.5 * right * right);
        // The inner two are what Σ N = 1, Σ j N = f, Σ N′ = 0 and Σ j N′ = 1 leave: four rounded polynomials would lose mass, momentum and
        // angular momentum step by step.
        Rows {
            base,
            weights: [first, left + last - 2.0 * first, right + first - 2.0 * last, last],
            derivatives: [
                falling,
                rising - 2.0 * falling - 1.0,
                1.0 + falling - 2.0 * rising,
                rising,
            ],
        }
    }
}
