//! The laws along the axes of the log-gamma problem.

use crate::special::{HALF_LOG_TWO_PI, normal_quantile};

/// β of the log-gamma laws and σ of the normal ones.
pub const WIDTH: f64 = 1.0 / 30.0;

/// The two centres.
pub const BOTH: [f64; 2] = [1.0 / 3.0, 2.0 / 3.0];

/// A law of one coordinate.
#[derive(Clone, Copy, PartialEq)]
pub enum Part {
    LogGamma,
    Normal,
}

impl Part {
    /// The law of a coordinate counted from 0, and its centres, of equal masses.
    pub fn of_axis(axis: usize, dimension: usize) -> (Self, &'static [f64]) {
        match axis {
            0 => (Self::LogGamma, &BOTH),
            1 => (Self::Normal, &BOTH),
            _ if 2 * axis <= dimension => (Self::LogGamma, &BOTH[1..]),
            _ => (Self::Normal, &BOTH[1..]),
        }
    }

    /// Log density and its slope in x.
    fn at(self, x: f64, centre: f64) -> [f64; 2] {
        let z = (x - centre) / WIDTH;
        let [log_density, slope] = match self {
            Self::LogGamma => [z - z.exp(), 1.0 - z.exp()],
            Self::Normal => [-0.5 * z * z - HALF_LOG_TWO_PI, -z],
        };
        [log_density - WIDTH.ln(), slope / WIDTH]
    }

    /// The mass below 0; that above 1 is beyond e^(−22,000), and both are 10⁻²³ for normal laws.
    fn mass_below(self, centre: f64) -> f64 {
        match self {
            Self::LogGamma => -(-(-centre / WIDTH).exp()).exp_m1(),
            Self::Normal => 0.0,
        }
    }

    /// The quantile of u given x > 0.
    pub fn quantile(self, u: f64, centre: f64) -> f64 {
        let z = match self {
            Self::LogGamma => {
                let below = self.mass_below(centre);
                (-(-(below + u * (1.0 - below))).ln_1p()).ln()
            }
            Self::Normal => normal_quantile(u),
        };
        (centre + WIDTH * z).clamp(f64::MIN_POSITIVE, 1.0 - f64::EPSILON)
    }
}

/// The mass of the cube along an axis, and the share of it that the first centre has.
pub fn inside(axis: usize, dimension: usize) -> [f64; 2] {
    let (part, centres) = Part::of_axis(axis, dimension);
    let first = 1.0 - part.mass_below(centres[0]);
    let all: f64 = centres.iter().map(|centre| 1.0 - part.mass_below(*centre)).sum();
    [all / centres.len() as f64, first / all]
}

/// log L_k and its slope.
pub fn on_axis(x: f64, axis: usize, dimension: usize) -> [f64; 2] {
    let (part, centres) = Part::of_axis(axis, dimension);
    let terms = centres.iter().map(|centre| part.at(x, *centre));
    let largest = terms.clone().fold(f64::NEG_INFINITY, |top, [term, _]| top.max(term));
    let (mut sum, mut slope) = (0.0, 0.0);
    for [term, own_slope] in terms {
        let weight = (term - largest).exp();
        sum += weight;
        slope += weight * own_slope;
    }
    [largest + (sum / centres.len() as f64).ln(), slope / sum]
}
