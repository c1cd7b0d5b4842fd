//! Reference moments and the errors that they state.

use parvi_targets::{CatalogueTarget, Frame, Moments, ReferenceOptions, StudentT, Target, reference_moments, wells};

use super::target;

/// A target of which nothing but the density and a frame is known.
struct Hidden<'a, const D: usize> {
    target: &'a dyn CatalogueTarget<D>,
    frame: Frame<D>,
}

impl<const D: usize> Target<D> for Hidden<'_, D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.target.log_density(x)
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        self.target.score(x)
    }
}

impl<const D: usize> CatalogueTarget<D> for Hidden<'_, D> {
    fn name(&self) -> &str {
        "hidden"
    }

    fn frame(&self) -> Frame<D> {
        self.frame
    }

    fn domain(&self) -> [[f64; 2]; D] {
        self.target.domain()
    }
}

/// Moments by quadrature against an importance sample, which knows the density only.
#[test]
fn moments_of_the_schools_follow_from_their_density() {
    let known = target::<4>("schools");
    let schools = Hidden {
        frame: known.frame(),
        target: &*known,
    };
    let options = ReferenceOptions {
        points: 1 << 17,
        degrees_of_freedom: 5.0,
        ..ReferenceOptions::default()
    };
    let (found, known) = (reference_moments(&schools, &options).unwrap(), known.moments().unwrap());
    for axis in 0..4 {
        let deviation = known.covariance.0[axis][axis].sqrt();
        let error = (found.moments.mean[axis] - known.mean[axis]).abs();
        assert!(
            error < 6.0 * found.mean_error[axis] && error < 5e-3 * deviation,
            "mean {axis}: {error}"
        );
        let error = (found.moments.covariance.0[axis][axis].sqrt() - deviation).abs();
        assert!(
            error < 6.0 * found.standard_deviation_error[axis] && error < 1e-2 * deviation,
            "deviation {axis}: {error}"
        );
    }
}

/// The importance sampler against moments known in closed form.
#[test]
fn importance_sampling_finds_known_moments() {
    let target = StudentT::new(12.0).unwrap();
    let hidden = Hidden {
        frame: Frame::from_scales([0.3; 3], [1.3; 3]).unwrap(),
        target: &target,
    };
    let options = ReferenceOptions {
        points: 1 << 16,
        ..ReferenceOptions::default()
    };
    let found = reference_moments(&hidden, &options).unwrap();
    assert!(found.effective_sample_size > 0.8 * f64::from(1 << 16));
    for axis in 0..3 {
        let deviation = found.moments.covariance.0[axis][axis].sqrt();
        assert!(found.moments.mean[axis].abs() < 6.0 * found.mean_error[axis]);
        assert!((deviation - 1.2_f64.sqrt()).abs() < 6.0 * found.standard_deviation_error[axis]);
        assert!(found.mean_error[axis] < 1e-3 && found.standard_deviation_error[axis] < 1e-3);
    }
    // In closed form there is no error.
    let known = reference_moments(&target, &options).unwrap();
    assert_eq!(known.mean_error, [0.0; 3]);
    assert_eq!(Some(known.moments), target.moments());
}

#[test]
fn references_of_the_regressions_state_their_error() {
    const POINTS: usize = 1 << 14;
    fn check<const D: usize>(name: &str) {
        let target = target::<D>(name);
        let run = |seed, points| {
            let options = ReferenceOptions {
                points,
                seed,
                ..ReferenceOptions::default()
            };
            reference_moments(&*target, &options).unwrap()
        };
        let (one, two) = (run(1, POINTS), run(2, POINTS));
        let deviations =
            |moments: &Moments<D>| -> [f64; D] { std::array::from_fn(|k| moments.covariance.0[k][k].sqrt()) };
        for axis in 0..D {
            let deviation = deviations(&one.moments)[axis];
            let combined = one.mean_error[axis].hypot(two.mean_error[axis]);
            let difference = (one.moments.mean[axis] - two.moments.mean[axis]).abs();
            assert!(
                difference < 6.0 * combined,
                "{name} {axis}: {difference} for {combined}"
            );
            assert!(
                combined < 4e-3 * deviation,
                "{name} {axis}: error {}",
                combined / deviation
            );
            let difference = (deviation - deviations(&two.moments)[axis]).abs();
            let combined = one.standard_deviation_error[axis].hypot(two.standard_deviation_error[axis]);
            assert!(
                difference < 6.0 * combined && combined < 8e-3 * deviation,
                "{name} {axis}"
            );
        }
        let share = one.effective_sample_size / POINTS as f64;
        assert!(share > 0.5, "{name}: effective share {share}");
    }
    crate::in_dimensions!(check("wells"), 1, 6);
    check::<5>("wells-small");
    crate::in_dimensions!(check("probit"), 1, 5);
    crate::in_dimensions!(check("poisson"), 2, 4, 8);
    assert_eq!(wells(5, None).unwrap().rows(), 3020);
}
