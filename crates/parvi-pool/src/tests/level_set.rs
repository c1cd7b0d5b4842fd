//! Level sets of what a fold knows.

use mpm_tensor::Matrix;
use parvi_targets::{Frame, Gaussian};

use crate::density::Density;
use crate::fold::Fold;
use crate::levels::level_sample;
use crate::{Kernel, Mixture};

#[test]
fn a_level_set_ends_where_it_is_told_to() {
    // Log densities down to −1e8.
    let target = Gaussian::new([0.0; 5], Matrix::IDENTITY * 1e-6).unwrap();
    let frame = Frame::identity();
    let wide = Kernel {
        centre: [0.0; 5],
        factor: Matrix::IDENTITY * 3.0,
        share: 1.0,
    };
    let mut fold = Fold::new();
    fold.draw(
        &mut Density::of(&target, &frame),
        Mixture::new(vec![wide]).unwrap(),
        4000,
        1,
    );
    let mut values = fold.log_densities.clone();
    values.sort_by(|a, b| b.total_cmp(a));
    for rank in [0, 40, 400] {
        let level = level_sample(&fold, values[rank], 50, 0.5);
        assert!(!level.points.is_empty() && level.logs.iter().all(|&log| log >= values[rank]));
    }
}
