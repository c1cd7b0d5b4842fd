//! Input that makes no sense.

use super::*;

#[test]
fn bad_input_is_an_error_with_its_name() {
    let held = format!("{BLOCK}{HELD}");
    let refused = |text: &str, samples: SampleChoice, quadrature: Quadrature| {
        let (body, fields) = (body(text), Fields::bending(5));
        let map = DeformationMap::new(&fields, &body.reference, &[0.0; 5]).expect("at rest");
        let model = ReducedModel::new(body, map, options(samples, quadrature, Update::VelocityOnly));
        model.err().expect("refused").to_string()
    };
    let drawn = |count| SampleChoice::Drawn { count, seed: 0 };
    let redrawn = |count| SampleChoice::Redrawn { count, seed: 0 };
    let members = body(&held).kinematics.regions()[0].members.clone();
    let free = (0..128).filter(|p| !members.contains(&(*p as usize))).take(9);
    let mut four_held: Vec<u32> = free.chain(members.iter().take(4).map(|&p| p as u32)).collect();
    four_held.sort_unstable();
    let apic = Scene::parse(&BLOCK.replace("\"pic\"", "\"apic\""), "block.toml".as_ref()).expect("a scene");
    let error = ReducedBody::<2>::of(&apic).err().expect("another transfer");
    for (error, expected) in [
        (
            refused(BLOCK, drawn(2), LAGRANGIAN),
            "the number of sample points is 2, at least 3 are needed",
        ),
        (
            refused(&held, drawn(7), LAGRANGIAN),
            "the number of sample points is 7, at least 8 are needed",
        ),
        (
            refused(BLOCK, redrawn(2), EULERIAN),
            "the number of sample points is 2, at least 3 are needed",
        ),
        (
            refused(&held, redrawn(7), LAGRANGIAN),
            "the number of sample points is 7, at least 8 are needed",
        ),
        (
            refused(BLOCK, redrawn(129), LAGRANGIAN),
            "129 sample points of 128 material points",
        ),
        (
            refused(&held, SampleChoice::Given(four_held), LAGRANGIAN),
            "kinematic region 0 has 4 of the sample points, at least 5 are needed",
        ),
        (
            refused(BLOCK, drawn(1000), LAGRANGIAN),
            "1000 sample points of 128 material points",
        ),
        (
            refused(BLOCK, SampleChoice::All, Quadrature::Eulerian { per_axis: 0 }),
            "per_axis = 0: must be",
        ),
        (error.to_string(), "transfer.kind: must be"),
    ] {
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn an_inverted_map_is_an_error_and_a_named_fallback() {
    let squashed = |quadrature, inverted| {
        let options = Options {
            inverted,
            ..options(SampleChoice::All, quadrature, Update::VelocityOnly)
        };
        let mut model = model(BLOCK, Fields::bending(3), options);
        // ∂x/∂X_1 = 1 + (y + 0.3 y²) X_1² ... of field 1 is X_0 X_1 along the first axis: J ≤ 0 where X_1 is low.
        model.coordinates.latent = vec![0.0, 4.0, 0.0];
        let step = model.step();
        assert_eq!(
            (model.time() > 0.0, model.steps()),
            (step.is_ok(), u64::from(step.is_ok()))
        );
        step
    };
    for quadrature in [LAGRANGIAN, EULERIAN] {
        let error = squashed(quadrature, Inverted::Refuse).expect_err("J < 0");
        let OnlineError::Inverted {
            step: 1,
            reference,
            volume_ratio,
        } = error
        else {
            panic!("{error}");
        };
        assert!(volume_ratio <= 0.0 && vector::norm(&[reference[0], reference[1]]) < 1.0);
        let report = squashed(quadrature, Inverted::Limit).expect("a step");
        assert!(report.quadrature_points > 0 && report.limited > 0, "{report:?}");
    }
}
