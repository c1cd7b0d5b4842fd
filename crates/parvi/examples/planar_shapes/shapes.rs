//! Shapes of the plane by their log densities, up to constants.

use std::f64::consts::FRAC_PI_4;

/// A log density.
type Log = Box<dyn Fn([f64; 2]) -> f64 + Send + Sync>;

/// A log density, and the half widths of a box about the origin outside of which is nothing to speak of.
pub struct Shape {
    pub name: &'static str,
    pub half: [f64; 2],
    pub log_density: Log,
}

/// log Σ e^t.
fn log_sum(terms: impl Iterator<Item = f64> + Clone) -> f64 {
    let top = terms.clone().fold(f64::NEG_INFINITY, f64::max);
    top + terms.map(|term| (term - top).exp()).sum::<f64>().ln()
}

/// log 1/(1 + e^(t/width)): an edge.
fn below(t: f64, width: f64) -> f64 {
    let t = t / width;
    -(t.max(0.0) + (-t.abs()).exp().ln_1p())
}

/// log of m N(z; c, s² I), up to a constant.
fn normal([x, y]: [f64; 2], mass: f64, [a, b]: [f64; 2], deviation: f64) -> f64 {
    mass.ln() - 2.0 * deviation.ln() - 0.5 * ((x - a).powi(2) + (y - b).powi(2)) / deviation.powi(2)
}

/// A ridge where t = 0.
fn ridge(t: f64, width: f64) -> f64 {
    -0.5 * (t / width).powi(2)
}

/// Half of a circle of radius 1.5, the upper one where `side` = 1.
fn arc(x: f64, y: f64, side: f64) -> f64 {
    let radius = x.hypot(y);
    ridge(radius - 1.5, 0.1) + 4.0 * side * y / radius
}

/// All shapes.
pub fn all() -> Vec<Shape> {
    let shape = |name, half, log_density: Log| Shape {
        name,
        half,
        log_density,
    };
    let turn = |t: f64| [0.2 * t * t.cos(), 0.2 * t * t.sin()];
    let spiral: Vec<[f64; 2]> = (0..260).map(|k| turn(1.5 + 15.0 * f64::from(k) / 259.0)).collect();
    vec![
        shape(
            "parabola",
            [6.0, 12.0],
            Box::new(|[x, y]| -0.25 * x * x + ridge(y + 3.0 - x * x, 0.15)),
        ),
        shape("ring", [4.0; 2], Box::new(|[x, y]| ridge(x.hypot(y) - 2.5, 0.1))),
        shape(
            "arcs",
            [5.0; 2],
            Box::new(|[x, y]| {
                let arcs = [arc(x + 0.7, y + 0.2, 1.0), arc(x - 0.8, y - 0.3, -1.0) - 0.7];
                log_sum(arcs.into_iter())
            }),
        ),
        shape(
            "box",
            [2.0; 2],
            Box::new(|[x, y]| below(x.abs() - 1.0, 0.02) + below(y.abs() - 1.0, 0.02)),
        ),
        shape(
            "spiral",
            [4.5; 2],
            Box::new(move |z| {
                // As much mass on every length.
                log_sum(
                    spiral
                        .iter()
                        .map(|&[a, b]| normal(z, (a * a + b * b + 0.04).sqrt(), [a, b], 0.08)),
                )
            }),
        ),
        shape(
            "cusp",
            [16.0, 20.0],
            Box::new(|[x, y]| -x.abs() - 5.0 * (y - x.abs()).abs()),
        ),
        shape(
            "root",
            [20.0; 2],
            Box::new(|[x, y]| -3.0 * (x * x + 2.0 * y * y + 1e-6).powf(0.25)),
        ),
        shape(
            "tails",
            [200.0; 2],
            Box::new(|[x, y]| -2.5 * ((x * x + y * y - 1.2 * x * y) / 3.0).ln_1p()),
        ),
        shape(
            "nested",
            [5.0; 2],
            Box::new(|z| {
                let levels = [
                    (0.5, [0.0, 0.0], 1.0),
                    (0.3, [0.5, 0.3], 0.15),
                    (0.2, [0.55, 0.3], 0.02),
                ];
                log_sum(
                    levels
                        .into_iter()
                        .map(|(mass, centre, deviation)| normal(z, mass, centre, deviation)),
                )
            }),
        ),
        shape(
            "eight",
            [6.0; 2],
            Box::new(|z| {
                let mode = |k| {
                    let angle = FRAC_PI_4 * f64::from(k);
                    normal(z, f64::from(k), [4.0 * angle.cos(), 4.0 * angle.sin()], 0.2)
                };
                log_sum((1..=8).map(mode))
            }),
        ),
        shape(
            "funnel",
            [7.0, 60.0],
            Box::new(|[x, y]| -0.35 * x * x - 0.5 * y * y * (-x).exp() - 0.5 * x),
        ),
        shape(
            "snake",
            [5.0; 2],
            Box::new(|[x, y]| -0.5 * x * x + ridge(y - 1.5 * (3.0 * x).sin(), 0.1)),
        ),
        shape(
            "triangle",
            [3.0; 2],
            Box::new(|[x, y]| below(-y - 0.5, 0.01) + below(y + 2.0 * x - 1.5, 0.01) + below(y - 2.0 * x - 1.5, 0.01)),
        ),
        shape(
            "cross",
            [9.0; 2],
            Box::new(|[x, y]| {
                let beams = [[x, y], [y, x]].into_iter();
                log_sum(beams.map(|[along, across]| ridge(along, 2.0) + ridge(across, 0.05)))
            }),
        ),
        shape(
            "ripples",
            [5.0; 2],
            Box::new(|[x, y]| -(x * x + y * y) / 3.0 + 3.0 * (5.0 * x).cos() * (5.0 * y).cos()),
        ),
    ]
}
