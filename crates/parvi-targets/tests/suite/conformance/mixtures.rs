//! Mixtures of Gaussians.

use parvi_targets::{CatalogueTarget, GaussianMixture, Mode};

use super::promises::{conforming, conforms};

#[test]
fn mixtures() {
    conforms::<2>("mixture-4");
    crate::in_dimensions!(conforms("mixture-2"), 1, 3);
    crate::in_dimensions!(conforms("mixture-3"), 2, 4, 8);
    let modes = [
        Mode {
            centre: [0.0, 1.0, 2.0],
            width: 0.2,
            mass: 2.0,
        },
        Mode {
            centre: [1.0, -1.0, 0.0],
            width: 1.0,
            mass: 1.0,
        },
    ];
    conforming(&GaussianMixture::new("own", &modes[..1]).unwrap());
    assert_eq!(GaussianMixture::new("own", &modes).unwrap().modes()[0].mass, 2.0 / 3.0);
}
