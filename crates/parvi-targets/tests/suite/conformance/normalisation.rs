//! Densities that state their normalisation.

use super::target;

/// ∫ p over the plane or the line by the midpoint rule on a box well beyond the domain.
#[test]
fn densities_of_the_plane_are_normalised() {
    for name in [
        "gaussian",
        "banana",
        "ring",
        "mixture-4",
        "mixture-2",
        "mixture-3",
        "funnel",
        "rosenbrock",
        "scales",
        "cross",
    ] {
        let target = target::<2>(name);
        // All digits of what is smooth and not much narrower than its domain.
        let count = match name {
            "funnel" | "banana" | "rosenbrock" => 2000,
            _ => 1000,
        };
        let sides = target
            .domain()
            .map(|[low, high]| [low - 0.5 * (high - low), high + 0.5 * (high - low)]);
        let step = sides.map(|[low, high]| (high - low) / f64::from(count));
        let mut sum = 0.0;
        for i in 0..count {
            for j in 0..count {
                let at = |axis: usize, k: i32| sides[axis][0] + (f64::from(k) + 0.5) * step[axis];
                sum += target.log_density(&[at(0, i), at(1, j)]).exp();
            }
        }
        let mass = sum * step[0] * step[1];
        assert!(
            (mass - 1.0).abs()
                < match name {
                    "funnel" => 2e-3,
                    "banana" | "rosenbrock" => 1e-5,
                    _ => 1e-6,
                },
            "{name}: {mass}"
        );
    }
    let line = target::<1>("student-t");
    let mass: f64 = (-400_000..400_000)
        .map(|k| line.log_density(&[1e-3 * (f64::from(k) + 0.5)]).exp())
        .sum();
    assert!((1e-3 * mass - 1.0).abs() < 1e-7);
}
