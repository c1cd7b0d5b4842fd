//! Particles at random.

use mpm_scenes::fill::random;
use mpm_scenes::shape::{Ball, Bounds, Shape};

#[test]
fn points_are_in_the_shape_and_spread_over_it() {
    let ball = Ball {
        centre: [1.0, 22.0],
        radius: 1.0,
    };
    let filling = random("ball", &ball, 4735, &Bounds::EVERYWHERE, 1).expect("a ball");
    assert_eq!(filling.positions.len(), 4735);
    assert!((filling.volume() - std::f64::consts::PI).abs() < 1e-12);
    assert!(filling.positions.iter().all(|x| ball.distance(x) < 0.0));
    // Half of the area is within r/√2; √(n)/2 = 34 is one standard deviation.
    let inner = filling
        .positions
        .iter()
        .filter(|x| ball.distance(x) < 0.5f64.sqrt() - 1.0)
        .count();
    assert!((2230..2505).contains(&inner), "{inner}");
    assert_eq!(
        random("ball", &ball, 4735, &Bounds::EVERYWHERE, 1).expect("a ball"),
        filling
    );
}
