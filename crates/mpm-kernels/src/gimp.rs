//! Uniform generalised interpolation: hats averaged over a particle.

use crate::lanes::Lanes;
use crate::spline::{Rows, SecondMoment, Spline, round};

/// The hat function averaged over a particle of width h / N, one of N ≥ 1 per axis and cell that do not deform (uGIMP; Bardenhagen &
/// Kober 2004, Eq. 38 ff.; Steffen, Kirby & Berzins 2008, §3.2).
///
/// With ℓ = 1 / (2 N), N(r) = 1/(2ℓ) ∫ over (r − ℓ, r + ℓ) of max(0, 1 − |s|) ds is 1 − (r² + ℓ²)/(2ℓ) on |r| < ℓ, 1 − |r| on
/// ℓ ≤ |r| < 1 − ℓ, (1 + ℓ − |r|)²/(4ℓ) on 1 − ℓ ≤ |r| < 1 + ℓ. N = 1 is the quadratic B-spline.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gimp {
    /// ℓ.
    half_width: f64,
}

impl Gimp {
    /// For particles of which `per_axis` ≥ 1 stand along every edge of a cell; 0 is taken as 1.
    pub fn new(per_axis: u32) -> Self {
        Self {
            half_width: 0.5 / f64::from(per_axis.max(1)),
        }
    }
}

/// One particle per axis and cell.
impl Default for Gimp {
    fn default() -> Self {
        Self::new(1)
    }
}

impl Spline<3> for Gimp {
    const NAME: &'static str = "gimp";
    const SECOND_MOMENT: SecondMoment = SecondMoment::Varies;

    fn value(&self, r: f64) -> f64 {
        let (r, l) = (r.abs(), self.half_width);
        if r < l {
            1.0 - (r * r + l * l) / (2.0 * l)
        } else if r < 1.0 - l {
            1.0 - r
        } else if r < 1.0 + l {
            (1.0 + l - r) * (1.0 + l - r) / (4.0 * l)
        } else {
            0.0
        }
    }

    fn derivative(&self, r: f64) -> f64 {
        let (s, l) = (r.abs(), self.half_width);
        if s < l {
            -r / l
        } else if s < 1.0 - l {
            -r.signum()
        } else if s < 1.0 + l {
            -(1.0 + l - s) / (2.0 * l) * r.signum()
        } else {
            0.0
        }
    }

    /// Of the three nodes the outer ones are at distances in [½, 3/2]; what they leave of one is the middle one's.
    #[inline(always)]
    fn rows(&self, u: Lanes) -> Rows<3> {
        let l = self.half_width;
        let outer = |distance: Lanes| {
            let overlap = (1.0 + l) - distance.fast_max(Lanes::splat(1.0 - l)).fast_min(Lanes::splat(1.0 + l));
            let inside = ((1.0 - l) - distance).fast_max(Lanes::ZERO);
            (overlap * overlap * (0.25 / l) + inside, overlap * (0.5 / l))
        };
        let base = round(u) - 1.0;
        let f = u - base;
        let ((left, left_slope), (right, right_slope)) = (outer(f), outer(2.0 - f));
        Rows {
            base,
            weights: [left, 1.0 - left - right, right],
            derivatives: [-left_slope, left_slope - right_slope, right_slope],
        }
    }
}
