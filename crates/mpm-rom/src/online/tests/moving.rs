//! Points of space, and bodies that are held.

use super::*;
use crate::online::eulerian::Eulerian;
use crate::online::step::Scheme;

/// The block, held at its left end and pulled down.
fn held_and_pulled() -> String {
    BLOCK.replace("gravity = [0.0, 0.0]", "gravity = [0.0, -8.0]") + HELD
}

#[test]
fn at_rest_the_points_of_space_fill_the_body() {
    let chosen = options(SampleChoice::All, EULERIAN, Update::VelocityOnly);
    let mut model = model(BLOCK, Fields::bending(3), chosen);
    let report = model.step().expect("a step");
    // 8 × 4 cells of the grid, four points in each.
    assert_eq!((report.quadrature_points, report.limited), (128, 0));
    let volume: f64 = model.quadrature.volumes.iter().sum();
    assert!((volume - 0.5).abs() < 1e-12, "{volume}");
}

#[test]
fn points_of_space_give_nearly_the_motion_of_the_material_points() {
    let run = |quadrature| {
        let chosen = options(SampleChoice::All, quadrature, Update::VelocityOnly);
        let mut model = model(&held_and_pulled(), Fields::bending(4), chosen);
        (0..10).for_each(|_| {
            advance_frame(&mut model).expect("a frame");
        });
        let (points, mut there) = (all_points(&model), Evaluation::default());
        model.evaluate(&points, Wanted::default(), &mut there);
        (there.positions, points.reference)
    };
    let ((material, start), (space, _)) = (run(LAGRANGIAN), run(EULERIAN));
    let moved = crate::least_squares::squared_distance(&material, &start);
    let apart = crate::least_squares::squared_distance(&material, &space);
    assert!(apart < 0.05f64.powi(2) * moved && moved > 0.0, "{apart} {moved}");
}

#[test]
fn held_points_hold_the_coordinates() {
    let chosen = options(
        SampleChoice::Drawn { count: 20, seed: 0 },
        LAGRANGIAN,
        Update::PositionVelocity,
    );
    let mut model = model(&held_and_pulled(), Fields::affine(), chosen);
    let held = model
        .samples()
        .iter()
        .filter(|&&p| model.body().prescribed(p as usize, 0.0).is_some());
    assert!(held.count() >= 5);
    advance_frame(&mut model).expect("a frame");
    let free = 0.5 * 8.0 * 0.02 * 0.02;
    assert!(
        model.latent()[1] < 0.0 && model.latent()[1] > -free,
        "{:?}",
        model.latent()
    );
}

#[test]
fn velocities_alone_do_not_lose_the_prescribed_path() {
    let region =
        "[[kinematic]]\nregion = { kind = \"box\", lower = [0.0, 0.0], upper = [1.0, 0.5] }\nvelocity = [0.5, -0.25]\n";
    let curved = Fields {
        curvature: 1.0,
        ..Fields::translations()
    };
    let chosen = options(SampleChoice::All, LAGRANGIAN, Update::VelocityOnly);
    let mut model = model(&format!("{BLOCK}{region}"), curved, chosen);
    (0..20).for_each(|_| {
        advance_frame(&mut model).expect("a frame");
    });
    for (y, v) in model.latent().iter().zip([0.5, -0.25]) {
        // A step leaves y² of its own, 1e-6; 200 of them without a memory of positions would leave 1e-4.
        let missed = y + y * y - 0.4 * v;
        assert!(missed.abs() < 2e-6, "{missed}");
    }
}

/// As in the full-order run, nodes that move take all points in them along: a block of which all nodes are held.
#[test]
fn held_nodes_that_turn_carry_the_body() {
    let region =
        "[[held]]\nshape = { kind = \"box\", lower = [-0.5, -0.5], upper = [1.5, 1.0] }\nvelocity = [0.5, -0.25]\n";
    let text = format!("{BLOCK}{region}rotation = {{ centre = [0.2, 0.1], rate = [3.0] }}\nuntil = 0.1\n");
    let chosen = options(
        SampleChoice::Drawn { count: 9, seed: 0 },
        LAGRANGIAN,
        Update::PositionVelocity,
    );
    let mut model = model(&text, Fields::affine(), chosen);
    let (points, mut there) = (all_points(&model), Evaluation::default());
    for frame in 1..=5 {
        advance_frame(&mut model).expect("a frame");
        model.evaluate(&points, Wanted::default(), &mut there);
        let body = model.body();
        for (found, start) in there.positions.iter().zip(&points.reference) {
            let start = vector::add(start, &body.centroid);
            let expected = body.held[0].motion.position(&start, f64::from(frame) * 0.02);
            let found = vector::add(found, &body.centroid);
            assert!(vector::distance(&found, &expected) < 1e-10, "{found:?} {expected:?}");
        }
    }
    assert!(model.body().held_velocity(&[0.0; 2], 0.05).is_some());
    assert_eq!(model.body().held_velocity(&[0.0; 2], 0.1), None, "let go");
}

/// A search that begins anew in every step and goes on to rounding is the oracle for points that are followed.
#[test]
fn points_of_space_are_followed_to_where_a_search_finds_them() {
    for samples in [
        SampleChoice::Drawn { count: 12, seed: 1 },
        SampleChoice::Redrawn { count: 12, seed: 1 },
    ] {
        assert_followed(&samples);
    }
}

fn assert_followed(samples: &SampleChoice) {
    let run = |fresh: bool| {
        let chosen = options(samples.clone(), EULERIAN, Update::VelocityOnly);
        let mut model = model(&held_and_pulled(), Fields::bending(4), chosen);
        let mut sums = Vec::new();
        for _ in 0..100 {
            if fresh {
                let mut search = Eulerian::new(2);
                search.tolerance = 1e-9;
                model.scheme = Scheme::Eulerian(search);
            }
            model.step().expect("a step");
            sums.push(model.quadrature.volumes.iter().sum::<f64>());
        }
        (model.latent().to_vec(), sums)
    };
    let ((followed, volumes), (searched, fresh)) = (run(false), run(true));
    let largest = searched.iter().fold(0.0, |most: f64, y| most.max(y.abs()));
    for (a, b) in followed.iter().zip(&searched) {
        assert!((a - b).abs() < 1e-3 * largest, "{followed:?} {searched:?}");
    }
    for (step, (a, b)) in volumes.iter().zip(&fresh).enumerate() {
        assert!((a - b).abs() < 0.01 * b, "step {step}: {a} {b}");
    }
}

/// The volumes of the points of space, step by step.
fn volumes(text: &str, steps: usize, fresh: bool) -> Vec<f64> {
    let chosen = options(SampleChoice::All, EULERIAN, Update::VelocityOnly);
    let mut model = model(text, Fields::translations(), chosen);
    let mut step = |_| {
        if fresh {
            model.scheme = Scheme::Eulerian(Eulerian::new(2));
        }
        model.step().expect("a step");
        model.quadrature.volumes.iter().sum()
    };
    (0..steps).map(&mut step).collect()
}

/// At rest nothing reaches the points in front of it, and then it moves by half a cell in 16 steps.
#[test]
fn points_of_space_are_met_by_a_body_that_starts_at_once() {
    let region =
        "[[kinematic]]\nregion = { kind = \"box\", lower = [0.0, 0.0], upper = [0.5, 0.5] }\nvelocity = [2.0, 0.0]\n";
    let text = format!("{BLOCK}{region}");
    let (followed, searched) = (volumes(&text, 40, false), volumes(&text, 40, true));
    for (step, (a, b)) in followed.iter().zip(&searched).enumerate() {
        assert!((a - b).abs() < 1e-12, "step {step}: {a} {b}");
    }
}

#[test]
fn a_body_is_the_same_about_another_origin_and_with_longer_steps() {
    let own = body(BLOCK);
    let moved = body(BLOCK).about(&[1.0, -2.0]);
    for (x, y) in own.reference.iter().zip(&moved.reference) {
        let (x, y) = (vector::add(x, &own.centroid), vector::add(y, &moved.centroid));
        assert!(vector::distance(&x, &y) < 1e-14);
    }
    let node = |body: &ReducedBody<2>| vector::add(&body.grid.node_position(&[3, 5]), &body.centroid);
    assert!(vector::distance(&node(&own), &node(&moved)) < 1e-14);

    let (step, steps) = (own.time_step, own.steps_per_frame);
    let longer = own.with_longer_steps(5).expect("10 steps per frame");
    assert_eq!((longer.time_step, longer.steps_per_frame * 5), (5.0 * step, steps));
    assert!(longer.with_longer_steps(3).is_none());
    assert!(body(BLOCK).with_longer_steps(0).is_none());
}
