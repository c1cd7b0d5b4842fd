//! Mixtures of kernels.

use mpm_tensor::Matrix;

use crate::lanes::packed;
use crate::{Kernel, Mixture};

#[test]
fn a_mixture_integrates_to_one_and_its_draws_are_its_own() {
    // E_q[q'/q] = 1 for any normalised q'.
    let kernel = |x: f64, width: f64| Kernel {
        centre: [x, 0.0, -x],
        factor: Matrix::IDENTITY * width,
        share: width,
    };
    let wide = Mixture::new(vec![kernel(0.0, 2.0), kernel(1.0, 1.0)]).unwrap();
    let other = Mixture::new(vec![kernel(0.5, 1.0)]).unwrap();
    let groups = packed(&wide.draws(1 << 14, 3));
    let (q, p) = (wide.densities(&groups), other.densities(&groups));
    let ratios = p.as_flattened().iter().zip(q.as_flattened()).map(|(p, q)| p / q);
    let mean = ratios.sum::<f64>() / f64::from(1 << 14);
    assert!((mean - 1.0).abs() < 2e-3, "{mean}");
}

#[test]
fn kernels_whose_distances_have_no_squares_are_left_out() {
    let kernel = |centre: f64, width: f64| Kernel {
        centre: [centre],
        factor: Matrix([[width]]),
        share: 1.0,
    };
    let far = [
        (1e151, 1.0),
        (-1e200, 1e100),
        (0.0, 1e151),
        (f64::NAN, 1.0),
        (0.0, f64::INFINITY),
    ];
    for (centre, width) in far {
        assert!(
            Mixture::new(vec![kernel(centre, width)]).is_none(),
            "{centre:e} {width:e}"
        );
        let mixture = Mixture::new(vec![kernel(centre, width), kernel(1e150, 1e150)]).unwrap();
        assert_eq!(mixture.kernels().len(), 1);
    }
}
