//! From data to fractions of an axis, and the ticks between.

use super::text::{decimal, power_of_ten};

/// Values beyond this magnitude are not drawn.
const LARGEST: f64 = 1e300;

/// Values up to this one have no place on a logarithmic axis.
const LEAST: f64 = 1e-300;

/// An axis shorter than this has no ends to tell apart: densities of values up to [`LARGEST`] are longer.
const LEAST_SPAN: f64 = 1e-302;

/// The factor between the ends of an axis above which it is better logarithmic.
const LOGARITHMIC_FROM: f64 = 30.0;

/// Whether a figure can show this value.
pub fn plottable(value: f64) -> bool {
    value.is_finite() && value.abs() < LARGEST
}

/// How an axis is divided.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum AxisKind {
    /// Logarithmic where all values are positive and span more than a factor of 30, linear otherwise.
    #[default]
    Automatic,
    /// Equal steps.
    Linear,
    /// Equal factors; values that are not positive are left out.
    Logarithmic,
}

impl AxisKind {
    /// Whether a value has a place on such an axis.
    pub(crate) fn can_show(self, value: f64) -> bool {
        plottable(value) && (self != Self::Logarithmic || value > LEAST)
    }
}

/// An axis of a figure.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct Axis {
    /// Its label, with the unit.
    pub label: String,
    /// Its division.
    pub kind: AxisKind,
}

impl Axis {
    /// An axis with a label.
    pub fn new(label: impl Into<String>, kind: AxisKind) -> Self {
        let label = label.into();
        Self { label, kind }
    }

    /// One of equal factors.
    pub fn logarithmic(label: impl Into<String>) -> Self {
        Self::new(label, AxisKind::Logarithmic)
    }
}

/// The map from an interval of data to 0…1.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Whether the map is logarithmic.
    pub logarithmic: bool,
    low: f64,
    high: f64,
}

/// The ticks of an axis.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Ticks {
    /// Labelled ticks: fraction of the axis and label.
    pub major: Vec<(f64, String)>,
    /// Ticks without labels.
    pub minor: Vec<f64>,
    /// The common power of ten that the labels leave out.
    pub exponent: i32,
}

/// The least, the least above zero and the largest of the values that can be drawn.
fn extremes(values: impl IntoIterator<Item = f64>) -> [f64; 3] {
    let drawn = values.into_iter().filter(|&value| plottable(value));
    let first = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY];
    drawn.fold(first, |[least, positive, most], value| {
        let above_zero = if value > LEAST { value } else { f64::INFINITY };
        [least.min(value), positive.min(above_zero), most.max(value)]
    })
}

impl Scale {
    /// A scale for `values` with a margin of `padding` times their span on both sides. Without any drawable value it is
    /// 0…1 (1…10), around a single one an interval that contains it.
    pub fn around(values: impl IntoIterator<Item = f64>, kind: AxisKind, padding: f64) -> Scale {
        let [low, smallest_positive, high] = extremes(values);
        let logarithmic = match kind {
            AxisKind::Linear => false,
            AxisKind::Logarithmic => true,
            AxisKind::Automatic => low > LEAST && high / low > LOGARITHMIC_FROM,
        };
        if !logarithmic {
            return Scale::linear(low, high, padding);
        }
        let (low, high) = if smallest_positive.is_finite() {
            (smallest_positive.log10(), high.log10())
        } else {
            (0.0, 1.0)
        };
        let span = high - low;
        let margin = if span < 0.05 { 0.3 } else { padding * span };
        Scale {
            logarithmic,
            low: low - margin,
            high: high + margin,
        }
    }

    /// Whether an axis that chooses for itself is linear because of zeros alone: without them it would be logarithmic.
    pub fn is_linear_for_zeros(values: impl IntoIterator<Item = f64>, kind: AxisKind) -> bool {
        let [least, positive, most] = extremes(values);
        kind == AxisKind::Automatic && least == 0.0 && most / positive > LOGARITHMIC_FROM
    }

    /// A linear scale from `low` to `high` with a margin.
    pub fn linear(low: f64, high: f64, padding: f64) -> Scale {
        if low.partial_cmp(&high).is_none_or(|order| order.is_gt()) {
            return Scale {
                logarithmic: false,
                low: 0.0,
                high: 1.0,
            };
        }
        let span = high - low;
        let magnitude = low.abs().max(high.abs());
        let margin = if span <= 1e-11 * magnitude || span < LEAST_SPAN {
            if magnitude < 1e-280 { 0.5 } else { 0.1 * magnitude }
        } else {
            padding * span
        };
        Scale {
            logarithmic: false,
            low: low - margin,
            high: high + margin,
        }
    }

    /// The data at the ends of the axis.
    pub fn ends(&self) -> (f64, f64) {
        if self.logarithmic {
            (10f64.powf(self.low), 10f64.powf(self.high))
        } else {
            (self.low, self.high)
        }
    }

    /// The length of the axis: in data units, or in decades if logarithmic.
    pub fn span(&self) -> f64 {
        self.high - self.low
    }

    /// The same scale, widened symmetrically to `span` if that is longer.
    pub fn widened(self, span: f64) -> Scale {
        let margin = 0.5 * (span - self.span()).max(0.0);
        Scale {
            low: self.low - margin,
            high: self.high + margin,
            ..self
        }
    }

    /// Where `value` lies on the axis, 0 at its start and 1 at its end; `None` for values that cannot be drawn.
    pub fn fraction(&self, value: f64) -> Option<f64> {
        if !plottable(value) || (self.logarithmic && value <= LEAST) {
            return None;
        }
        let position = if self.logarithmic { value.log10() } else { value };
        let fraction = (position - self.low) / (self.high - self.low);
        fraction.is_finite().then_some(fraction)
    }

    /// Ticks for an axis with limited room: `kept(labels)` is the number of labels that would be shown of those given with
    /// their fractions, or `None` if some would touch. The finest division that shows two labels or more is taken, else the
    /// finest that shows one. A logarithmic axis none of whose round numbers it can show, as from 2.1 to 2.9, has ticks in equal steps.
    pub fn ticks(&self, kept: impl Fn(&[(f64, String)]) -> Option<usize>) -> Ticks {
        let shown = |ticks: &Ticks| kept(&ticks.major).unwrap_or(0);
        let best = |candidates: &[Ticks]| {
            let best = candidates.iter().find(|ticks| shown(ticks) >= 2);
            let best = best.or_else(|| candidates.iter().find(|ticks| shown(ticks) == 1));
            best.cloned()
        };
        let decades: Vec<Ticks> = match self.logarithmic {
            true => (2..=9).rev().map(|count| self.logarithmic_ticks(count)).collect(),
            false => Vec::new(),
        };
        best(&decades).unwrap_or_else(|| {
            let steps = self.steps().into_iter();
            let steps: Vec<Ticks> = steps.map(|(step, parts)| self.linear_ticks(step, parts)).collect();
            let last = decades.last().or(steps.last());
            best(&steps).or(last.cloned()).unwrap_or_default()
        })
    }

    /// The steps between labels to try and into how many parts minor ticks divide each: first 1, 2 and 5 times powers of
    /// ten, from fine to coarse, then less usual ones.
    fn steps(&self) -> Vec<(f64, f64)> {
        let (low, high) = self.ends();
        let span = high - low;
        let decade = span.log10().floor() as i32;
        let mut steps = Vec::new();
        for factors in [
            [(1.0, 5.0), (2.0, 4.0), (5.0, 5.0)],
            [(2.5, 5.0), (3.0, 3.0), (4.0, 4.0)],
        ] {
            for exponent in decade - 1..=decade {
                for (factor, parts) in factors {
                    let step = factor * 10f64.powi(exponent);
                    if step >= span / 10.0 && step <= span {
                        steps.push((step, parts));
                    }
                }
            }
        }
        steps
    }

    fn linear_ticks(&self, step: f64, parts: f64) -> Ticks {
        let (low, high) = self.ends();
        let magnitude = low.abs().max(high.abs());
        let leading = magnitude.log10().floor() as i32;
        let exponent = if (-2..4).contains(&leading) { 0 } else { leading };
        let unit = 10f64.powi(exponent);
        let whole = |decimals: &i32| {
            let multiple = step / unit * 10f64.powi(*decimals);
            (multiple - multiple.round()).abs() < 1e-6 * multiple
        };
        let decimals = (0..15).find(whole).unwrap_or(15);
        let mut ticks = Ticks {
            exponent,
            ..Ticks::default()
        };
        let minor = step / parts;
        let first = (low / minor - 1e-9).ceil();
        let total = (((high - low) / minor) as usize).min(200) + 2;
        for index in 0..total {
            let multiple = first + index as f64;
            let value = multiple * minor;
            let position = if self.logarithmic { value.log10() } else { value };
            let fraction = (position - self.low) / (self.high - self.low);
            if !(-1e-9..=1.0 + 1e-9).contains(&fraction) {
                continue;
            }
            if (multiple / parts - (multiple / parts).round()).abs() < 1e-6 {
                let label = decimal(value / unit, decimals as usize);
                ticks.major.push((fraction, label));
            } else {
                ticks.minor.push(fraction);
            }
        }
        ticks
    }

    fn logarithmic_ticks(&self, count: usize) -> Ticks {
        let (first, last) = (self.low.floor() as i32, self.high.ceil() as i32);
        let decades = self.high - self.low;
        let stride = ((decades / count as f64).ceil() as i32).max(1);
        let fraction = |position: f64| (position - self.low) / (self.high - self.low);
        let visible = |fraction: &f64| (-1e-9..=1.0 + 1e-9).contains(fraction);
        // With fewer than two whole decades, twos and fives are labelled too where there is room.
        let factors: &[i32] = match (decades < 2.0, count) {
            (true, 7..) => &[1, 2, 3, 5],
            (true, 4..) => &[1, 2, 5],
            (true, 3) => &[1, 3],
            _ => &[1],
        };
        let plain = first >= -3 && last <= 4;
        let mut ticks = Ticks::default();
        for exponent in first..=last {
            for factor in 1..10 {
                let place = fraction(f64::from(exponent) + f64::from(factor).log10());
                if !visible(&place) {
                    continue;
                }
                let labelled = factors.contains(&factor) && (factor > 1 || exponent.rem_euclid(stride) == 0);
                if labelled {
                    let label = match factor {
                        _ if plain => {
                            let value = f64::from(factor) * 10f64.powi(exponent);
                            decimal(value, usize::try_from(-exponent).unwrap_or(0))
                        }
                        1 => power_of_ten(exponent),
                        _ => format!("{factor}×{}", power_of_ten(exponent)),
                    };
                    ticks.major.push((place, label));
                } else if stride == 1 || (factor == 1 && decades < 40.0) {
                    ticks.minor.push(place);
                }
            }
        }
        ticks
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(ticks: &Ticks) -> Vec<&str> {
        ticks.major.iter().map(|tick| tick.1.as_str()).collect()
    }

    #[test]
    fn linear_ticks_are_round_numbers() {
        let scale = Scale::around([-1.1, 1.1], AxisKind::Linear, 0.0);
        let ticks = scale.ticks(|labels| (labels.len() <= 5).then_some(labels.len()));
        assert_eq!(labels(&ticks), ["−1.0", "−0.5", "0.0", "0.5", "1.0"]);
        assert_eq!(scale.fraction(0.0), Some(0.5));
    }

    #[test]
    fn tiny_values_share_a_power_of_ten() {
        let ticks = Scale::around([0.0, 4e-6], AxisKind::Linear, 0.0).ticks(|l| (l.len() <= 5).then_some(l.len()));
        assert_eq!(labels(&ticks), ["0", "1", "2", "3", "4"]);
        assert_eq!(ticks.exponent, -6);
    }

    #[test]
    fn logarithmic_ticks_are_decades_with_minor_ticks() {
        let scale = Scale::around([1e-6, 1e-2], AxisKind::Automatic, 0.0);
        assert!(scale.logarithmic);
        let ticks = scale.ticks(|l| Some(l.len()));
        assert_eq!(ticks.major[0].1, "10^{−6}");
        assert_eq!(ticks.major.len(), 5);
        assert_eq!(ticks.minor.len(), 4 * 8);
        assert_eq!(scale.fraction(-1.0), None);
    }

    #[test]
    fn a_logarithmic_axis_between_round_numbers_has_steps() {
        for (ends, expected) in [
            ([2.1, 2.9], vec!["2.2", "2.4", "2.6", "2.8"]),
            ([0.6, 0.9], vec!["0.6", "0.7", "0.8", "0.9"]),
            ([2.1e-7, 2.9e-7], vec!["2.2", "2.4", "2.6", "2.8"]),
            ([3.2, 4.8], vec!["3.5", "4.0", "4.5"]),
        ] {
            let scale = Scale::around(ends, AxisKind::Logarithmic, 0.0);
            let ticks = scale.ticks(|l| (l.len() <= 5).then_some(l.len()));
            assert_eq!(labels(&ticks), expected, "{ends:?}");
            let unit = 10f64.powi(ticks.exponent);
            for (fraction, label) in &ticks.major {
                let value = label.parse::<f64>().unwrap() * unit;
                assert!((fraction - scale.fraction(value).unwrap()).abs() < 1e-12, "{label}");
            }
        }
    }

    #[test]
    fn any_data_has_an_axis() {
        let hard = [
            vec![],
            vec![0.0],
            vec![3.0, 3.0],
            vec![f64::NAN, f64::INFINITY],
            vec![1e-310, 1e-308],
            vec![-1e299, 1e299],
            vec![1.0, 1.0 + 1e-15],
            vec![1e8, 1e8 + 1.0],
            vec![-5.0, 0.0],
        ];
        for values in hard {
            for kind in [AxisKind::Automatic, AxisKind::Linear, AxisKind::Logarithmic] {
                let scale = Scale::around(values.clone(), kind, 0.05);
                assert!(scale.span() > 0.0, "{values:?} {kind:?} {scale:?}");
                let ticks = scale.ticks(|l| Some(l.len()));
                assert!(ticks.major.len() < 40 && ticks.minor.len() < 400);
                assert!(!ticks.major.is_empty(), "{values:?} {kind:?} {scale:?}");
                assert!(ticks.major.iter().all(|tick| tick.0.is_finite()));
            }
        }
    }
}
