//! The paper's algorithms with their guards and without.

use parvi::{Guards, Method, PaperOptions, Run, Silent, sample};
use parvi_targets::{Banana, CatalogueTarget, Funnel, Gaussian, GaussianMixture, Ring, StudentT};

#[test]
fn the_paper_s_algorithms_stay_finite_with_their_guards() {
    let targets: [Box<dyn CatalogueTarget<2>>; 6] = [
        Box::new(Gaussian::<2>::autoregressive(0.9).expect("a correlation below one")),
        Box::new(Banana::new(1.0, 0.5).expect("a banana")),
        Box::new(Ring::new(2.0, 0.2).expect("a ring")),
        Box::new(GaussianMixture::<2>::four_equal(0.5).expect("a mixture")),
        Box::new(Funnel::<2>::new(1.5).expect("a funnel")),
        Box::new(StudentT::<2>::new(5.0).expect("a t distribution")),
    ];
    for target in &targets {
        for affine in [false, true] {
            let options = PaperOptions {
                affine,
                ..PaperOptions::default()
            };
            for seed in 0..2 {
                let samples = sample(
                    &**target,
                    &Method::Paper(options.clone()),
                    &Run::new(500, seed),
                    &mut Silent,
                );
                let samples = samples.unwrap_or_else(|error| panic!("{}, affine {affine}: {error}", target.name()));
                assert!(samples.positions.iter().flatten().all(|c| c.is_finite()));
            }
        }
    }
    let unguarded = PaperOptions {
        guards: Guards::none(),
        ..PaperOptions::default()
    };
    for target in &targets {
        // Without guards the algorithms may fail, but they say so.
        if let Ok(samples) = sample(
            &**target,
            &Method::Paper(unguarded.clone()),
            &Run::new(500, 0),
            &mut Silent,
        ) {
            assert!(samples.positions.iter().flatten().all(|c| c.is_finite()));
        }
    }
}
