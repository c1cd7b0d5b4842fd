//! What every kernel and every stencil must do.
use mpm_kernels::{Cubic, Deposit, Gimp, Linear, Quadratic, SecondMoment, Spline, Stencil, UniformGrid};
use mpm_tensor::vector::maximum_norm;
use proptest::prelude::*;

fn kernel_conforms<const W: usize, S: Spline<W>>(kernel: S, u: f64) {
    let row = kernel.row(u);
    let sum: f64 = row.weights.iter().sum();
    let slope: f64 = row.derivatives.iter().sum();
    let first: f64 = (0..W).map(|j| row.weights[j] * (row.base + j as i64) as f64).sum();
    assert!((sum - 1.0).abs() < 1e-14, "{}: partition of unity {sum}", S::NAME);
    assert!(slope.abs() < 1e-13, "{}: derivatives sum to {slope}", S::NAME);
    assert!(
        (first - u).abs() < 1e-12 * (1.0 + u.abs()),
        "{}: linear reproduction",
        S::NAME
    );
    for j in 0..W {
        let r = u - (row.base + j as i64) as f64;
        assert!(row.weights[j] >= -f64::EPSILON * u.abs());
        assert!((row.weights[j] - kernel.value(r)).abs() < 1e-14);
        let step = 1e-6;
        let difference = (kernel.value(r + step) - kernel.value(r - step)) / (2.0 * step);
        let kink = W == 2 && (r.abs() < 2.0 * step || (r.abs() - 1.0).abs() < 2.0 * step);
        if !kink {
            assert!((kernel.derivative(r) - difference).abs() < 1e-5, "{} at {r}", S::NAME);
            assert!(
                (row.derivatives[j] - kernel.derivative(r)).abs() < 1e-12,
                "{} at {r}",
                S::NAME
            );
        }
    }
    if let SecondMoment::Constant(moment) = S::SECOND_MOMENT {
        let second: f64 = (0..W)
            .map(|j| row.weights[j] * (u - (row.base + j as i64) as f64).powi(2))
            .sum();
        assert!((second - moment).abs() < 1e-13, "{}: second moment {second}", S::NAME);
    }
}

fn stencil_conforms<const W: usize, const D: usize, S: Spline<W>>(kernel: S, x: [f64; D], origin: [f64; D], h: f64) {
    let stencil = Stencil::<W, D>::of(&kernel, &x, &UniformGrid::new(origin, h));
    let mut seen = 0;
    let (mut sum, mut mean, mut slope) = (0.0, [0.0; D], [0.0; D]);
    stencil.for_each(|index, entry| {
        assert_eq!(index, seen);
        seen += 1;
        // The naive oracle: decode the index, multiply the kernels.
        let mut rest = index;
        let mut digits = [0; D];
        for a in (0..D).rev() {
            digits[a] = rest % W;
            rest /= W;
        }
        let r: [f64; D] =
            std::array::from_fn(|a| (x[a] - origin[a]) / h - (stencil.base()[a] + digits[a] as i64) as f64);
        let weight: f64 = r.iter().map(|&r| kernel.value(r)).product();
        assert!((entry.weight - weight).abs() < 1e-12);
        for a in 0..D {
            if W > 2 {
                let gradient: f64 = (0..D)
                    .map(|b| {
                        if a == b {
                            kernel.derivative(r[b]) / h
                        } else {
                            kernel.value(r[b])
                        }
                    })
                    .product();
                assert!((entry.gradient[a] - gradient).abs() < 1e-9 / h);
            }
            assert!((entry.offset[a] + r[a] * h).abs() < 1e-12 * (1.0 + x[a].abs()));
            mean[a] += entry.weight * entry.offset[a];
            slope[a] += entry.gradient[a];
        }
        sum += entry.weight;
    });
    assert_eq!(seen, W.pow(D as u32));

    // The deposit, which takes its own way through the products.
    let value = Deposit {
        scalar: 1.7,
        vector: std::array::from_fn(|a| 0.3 + a as f64),
    };
    let scale = -0.7 * h;
    let mut expected = Vec::new();
    stencil.for_each(|_, entry| {
        let gradient = Deposit {
            scalar: 0.0,
            vector: entry.gradient,
        };
        expected.push((entry.weight, value.combine(entry.weight, &gradient, scale)));
    });
    let mut deposits = 0;
    stencil.for_each_deposit(&value, scale, |index, weight, deposit| {
        assert_eq!(index, deposits);
        deposits += 1;
        assert!((weight - expected[index].0).abs() < 1e-15);
        let error = deposit.minus(&expected[index].1);
        assert!(error.scalar.abs() < 1e-14 && maximum_norm(&error.vector) < 1e-14);
    });
    assert_eq!(deposits, seen);
    assert!((sum - 1.0).abs() < 1e-13);
    for a in 0..D {
        assert!(mean[a].abs() < 1e-12 * (1.0 + x[a].abs()));
        assert!(slope[a].abs() < 1e-12 / h);
    }
}

proptest! {
    #[test]
    fn kernels(u in -1e3..1e3f64) {
        kernel_conforms::<2, _>(Linear, u);
        kernel_conforms::<3, _>(Quadratic, u);
        kernel_conforms::<4, _>(Cubic, u);
        kernel_conforms::<3, _>(Gimp::new(1), u);
        kernel_conforms::<3, _>(Gimp::new(2), u);
        kernel_conforms::<3, _>(Gimp::new(5), u);
    }

    #[test]
    fn stencils(x in prop::array::uniform4(-20.0..20.0f64), o in prop::array::uniform4(-1.0..1.0f64), h in 0.05..3.0f64) {
        stencil_conforms::<2, 1, _>(Linear, [x[0]], [o[0]], h);
        stencil_conforms::<3, 1, _>(Quadratic, [x[0]], [o[0]], h);
        stencil_conforms::<3, 2, _>(Quadratic, [x[0], x[1]], [o[0], o[1]], h);
        stencil_conforms::<4, 3, _>(Cubic, [x[0], x[1], x[2]], [o[0], o[1], o[2]], h);
        stencil_conforms::<3, 3, _>(Gimp::new(2), [x[0], x[1], x[2]], [o[0], o[1], o[2]], h);
        stencil_conforms::<2, 4, _>(Linear, x, o, h);
        stencil_conforms::<3, 4, _>(Quadratic, x, o, h);
        let (x, o) = ([x[0], x[1], x[2], x[3], 0.3 * x[0], -x[1]], [o[0], o[1], o[2], o[3], o[0], o[1]]);
        stencil_conforms::<2, 6, _>(Linear, x, o, h);
        stencil_conforms::<3, 6, _>(Quadratic, x, o, h);
        stencil_conforms::<3, 5, _>(Quadratic, [x[0], x[1], x[2], x[3], x[4]], [o[0], o[1], o[2], o[3], o[4]], h);
    }

    #[test]
    fn no_coordinate_panics(bits in any::<u64>()) {
        let x = f64::from_bits(bits);
        for h in [1.0, 1e-300, 1e300, x] {
            let grid = UniformGrid::new([0.0], h);
            Stencil::<2, 1>::new::<Linear>(&[x], &grid).for_each(|_, _| ());
            Stencil::<3, 1>::new::<Quadratic>(&[x], &grid).for_each(|_, _| ());
            Stencil::<4, 1>::new::<Cubic>(&[x], &grid).for_each(|_, _| ());
        }
    }
}

#[test]
fn nodes_and_half_way_points_are_no_exception() {
    for k in -6..=6 {
        let u = f64::from(k) * 0.5;
        kernel_conforms::<2, _>(Linear, u);
        kernel_conforms::<3, _>(Quadratic, u);
        kernel_conforms::<4, _>(Cubic, u);
        kernel_conforms::<3, _>(Gimp::new(2), u);
    }
}

#[test]
fn one_particle_per_axis_and_cell_makes_gimp_the_quadratic_spline() {
    for k in -400..400 {
        let r = 0.005 * f64::from(k) + 1e-4;
        assert!((Gimp::new(1).value(r) - Quadratic.value(r)).abs() < 1e-15);
        assert!((Gimp::new(1).derivative(r) - Quadratic.derivative(r)).abs() < 1e-15);
        let (ours, theirs) = (Gimp::new(1).row(r), Quadratic.row(r));
        assert_eq!(ours.base, theirs.base);
        for j in 0..3 {
            assert!((ours.weights[j] - theirs.weights[j]).abs() < 1e-15);
            assert!((ours.derivatives[j] - theirs.derivatives[j]).abs() < 1e-15);
        }
    }
}

/// The definition: the mean of the hat over a particle, by the midpoint rule.
#[test]
fn gimp_is_the_mean_of_the_hat_over_a_particle() {
    fn check(per_axis: u32) {
        let points = 20_000;
        for k in -40..40 {
            let r = 0.04 * f64::from(k) + 0.003;
            let place = |i: i32| r + ((f64::from(i) + 0.5) / f64::from(points) - 0.5) / f64::from(per_axis);
            let mean = (0..points).map(|i| Linear.value(place(i))).sum::<f64>() / f64::from(points);
            assert!(
                (Gimp::new(per_axis).value(r) - mean).abs() < 1e-8,
                "{per_axis}, {r}: {mean}"
            );
        }
    }
    check(1);
    check(2);
    check(3);
}

#[test]
fn coordinates_without_meaning_do_not_panic() {
    for x in [
        f64::NAN,
        f64::INFINITY,
        f64::NEG_INFINITY,
        f64::MAX,
        f64::MIN,
        9.3e18,
        -9.3e18,
    ] {
        let grid = UniformGrid::new([0.0], 1.0);
        Stencil::<2, 1>::new::<Linear>(&[x], &grid).for_each(|_, _| ());
        Stencil::<3, 1>::new::<Quadratic>(&[x], &grid).for_each(|_, _| ());
        Stencil::<4, 1>::new::<Cubic>(&[x], &grid).for_each(|_, _| ());
    }
}
