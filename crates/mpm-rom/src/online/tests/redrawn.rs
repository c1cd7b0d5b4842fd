//! Sample points that are drawn anew in every step.

use super::*;

const LISTS: Quadrature = Quadrature::Lagrangian {
    search: Search::Lists { skin: 0.2 },
};

fn redrawn(count: usize) -> SampleChoice {
    SampleChoice::Redrawn { count, seed: 2 }
}

/// The block, held at its left end and pulled down.
fn held(chosen: Options) -> ReducedModel<'static, 2> {
    let text = BLOCK.replace("gravity = [0.0, 0.0]", "gravity = [0.0, -8.0]") + HELD;
    model(&text, Fields::bending(4), chosen)
}

/// x̂ and 𝒫 of so many steps.
fn path(model: &mut ReducedModel<'_, 2>, steps: usize) -> Vec<(Vec<f64>, Vec<u32>)> {
    let mut step = || {
        model.step().expect("a step");
        (model.latent().to_vec(), model.samples().to_vec())
    };
    (0..steps).map(|_| step()).collect()
}

#[test]
fn all_points_drawn_anew_are_all_points() {
    for quadrature in [LAGRANGIAN, LISTS, EULERIAN] {
        for update in [Update::VelocityOnly, Update::PositionVelocity] {
            let run = |samples| path(&mut held(options(samples, quadrature, update)), 30);
            let all = run(SampleChoice::All);
            assert_eq!(run(redrawn(128)), all, "{quadrature:?} {update:?}");
            assert_eq!(run(SampleChoice::Drawn { count: 128, seed: 7 }), all);
        }
    }
}

/// A run of 40 steps, and one that begins at the coordinates of its half, both with weights that hang on 𝒫, too.
#[test]
fn a_step_draws_the_same_whatever_came_before() {
    for quadrature in [LAGRANGIAN, LISTS] {
        let chosen = Options {
            weights: SampleWeights::Nearest,
            ..options(redrawn(14), quadrature, Update::VelocityOnly)
        };
        let mut whole = held(chosen.clone());
        assert_eq!(whole.samples(), held(chosen.clone()).samples());
        let first = path(&mut whole, 20);
        let mut half = held(chosen);
        half.coordinates.latent = whole.latent().to_vec();
        half.coordinates.rates = whole.rates().to_vec();
        half.step = whole.steps();
        let rest = path(&mut whole, 20);
        assert_eq!(path(&mut half, 20), rest);
        let draws = first.iter().chain(&rest).map(|(_, samples)| samples);
        let draws: Vec<&Vec<u32>> = draws.collect();
        assert!(draws.windows(2).all(|pair| pair[0] != pair[1]));
        let members = &whole.body().kinematics.regions()[0].members;
        for samples in draws {
            let on_region = members.iter().filter(|&&p| samples.contains(&(p as u32)));
            assert_eq!((samples.len(), on_region.count()), (14, 5));
        }
    }
}

/// Every draw has its own neighbours, from places that are known already.
#[test]
fn lists_of_every_draw_find_what_the_search_of_all_points_finds() {
    let run = |search| {
        let chosen = options(redrawn(10), Quadrature::Lagrangian { search }, Update::PositionVelocity);
        let mut model = held(chosen);
        model.coordinates.rates = vec![6.0, 0.5, -2.0, 1.0];
        let mut refreshes = 0;
        let mut step = || {
            let report = model.step().expect("a step");
            refreshes = report.refreshes;
            (report.quadrature_points, model.latent().to_vec())
        };
        let steps: Vec<_> = (0..200).map(|_| step()).collect();
        (steps, refreshes)
    };
    let (oracle, _) = run(Search::All);
    let (found, refreshes) = run(Search::Lists { skin: 0.2 });
    assert_eq!(found, oracle);
    assert!((2..150).contains(&refreshes), "{refreshes} of 200 steps");
    assert!(
        oracle.iter().any(|(points, _)| *points < 128),
        "a list leaves points out"
    );
}

#[test]
fn a_step_is_read_at_its_own_points() {
    let chosen = options(redrawn(12), LISTS, Update::VelocityOnly);
    let (mut read, mut run) = (held(chosen.clone()), held(chosen));
    path(&mut run, 7);
    let (latent, rates, time) = (run.latent().to_vec(), run.rates().to_vec(), run.time());
    let reading = read.reading(&latent, &rates, time).expect("a reading");
    run.step().expect("a step");
    assert_eq!(read.samples(), run.samples());
    assert_eq!(reading.jacobians, run.evaluation.jacobians);
    // And goes on as if nothing had been read.
    assert_eq!((read.steps(), read.time()), (0, 0.0));
    let fresh = path(&mut held(options(redrawn(12), LISTS, Update::VelocityOnly)), 3);
    assert_eq!(path(&mut read, 3), fresh);
}
