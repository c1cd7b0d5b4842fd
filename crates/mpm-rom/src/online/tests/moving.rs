//! Points of space, and bodies that are held.

use super::*;

#[test]
fn at_rest_the_points_of_space_fill_the_body() {
    let chosen = options(SampleChoice::All, EULERIAN, Update::VelocityOnly);
    let mut model = model(BLOCK, Fields::bending(3), chosen);
    let report = model.step().expect("a step");
    // 8 × 4 cells of the grid, four points in each.
    assert_eq!((report.quadrature_points, report.left_out), (128, 0));
    let volume: f64 = model.quadrature.volumes.iter().sum();
    assert!((volume - 0.5).abs() < 1e-12, "{volume}");
}

#[test]
fn points_of_space_give_nearly_the_motion_of_the_material_points() {
    let text = format!(
        "{}{HELD}",
        BLOCK.replace("gravity = [0.0, 0.0]", "gravity = [0.0, -8.0]")
    );
    let run = |quadrature| {
        let chosen = options(SampleChoice::All, quadrature, Update::VelocityOnly);
        let mut model = model(&text, Fields::bending(4), chosen);
        (0..10).for_each(|_| {
            model.advance_frame().expect("a frame");
        });
        let (points, mut there) = (all_points(&mut model), Evaluation::default());
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
    let text = format!(
        "{}{HELD}",
        BLOCK.replace("gravity = [0.0, 0.0]", "gravity = [0.0, -8.0]")
    );
    let chosen = options(
        SampleChoice::Drawn { count: 20, seed: 0 },
        LAGRANGIAN,
        Update::position_velocity(),
    );
    let mut model = model(&text, Fields::affine(), chosen);
    let held = model
        .samples()
        .iter()
        .filter(|&&p| model.body().prescribed(p as usize, 0.0).is_some());
    assert!(held.count() >= 5);
    model.advance_frame().expect("a frame");
    let free = 0.5 * 8.0 * 0.02 * 0.02;
    assert!(
        model.latent()[1] < 0.0 && model.latent()[1] > -free,
        "{:?}",
        model.latent()
    );
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
        Update::position_velocity(),
    );
    let mut model = model(&text, Fields::affine(), chosen);
    let (points, mut there) = (all_points(&mut model), Evaluation::default());
    for frame in 1..=5 {
        model.advance_frame().expect("a frame");
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
