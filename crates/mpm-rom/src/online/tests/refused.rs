//! Input that makes no sense.

use super::*;

#[test]
fn bad_input_is_an_error_with_its_name() {
    let few = |count| options(SampleChoice::Drawn { count, seed: 0 }, LAGRANGIAN, Update::VelocityOnly);
    let try_new = |text: &str, options: Options| {
        let body = body(text);
        let map = DeformationMap::new(Fields::bending(5), &body.reference, &[0.0; 5]).expect("at rest");
        ReducedModel::new(body, map, options).map(|_| ())
    };
    let error = try_new(BLOCK, few(2)).expect_err("two points for five coordinates");
    assert!(
        matches!(
            error,
            OnlineError::TooFewSamples {
                found: 2,
                needed: 3,
                ..
            }
        ),
        "{error}"
    );
    let error = try_new(&format!("{BLOCK}{HELD}"), few(4)).expect_err("four with a kinematic region");
    assert!(matches!(error, OnlineError::TooFewSamples { needed: 5, .. }), "{error}");
    let members = body(&format!("{BLOCK}{HELD}")).kinematics.regions()[0].members.clone();
    let free = (0..128).filter(|p| !members.contains(&(*p as usize))).take(9);
    let four = members.iter().take(4).map(|&p| p as u32);
    let mut numbers: Vec<u32> = free.chain(four).collect();
    numbers.sort_unstable();
    let given = options(SampleChoice::Given(numbers), LAGRANGIAN, Update::VelocityOnly);
    let error = try_new(&format!("{BLOCK}{HELD}"), given).expect_err("four on the region");
    let OnlineError::TooFewOnRegion {
        region: 0,
        found: 4,
        needed: 5,
    } = error
    else {
        panic!("{error}");
    };
    let error = try_new(BLOCK, few(1000)).expect_err("more than there are");
    assert!(
        matches!(
            error,
            OnlineError::TooManySamples {
                found: 1000,
                points: 128
            }
        ),
        "{error}"
    );
    let wrong = Quadrature::Eulerian { per_axis: 0 };
    let error = try_new(BLOCK, options(SampleChoice::All, wrong, Update::VelocityOnly)).expect_err("no points");
    assert!(
        matches!(error, OnlineError::Option { field: "per_axis", .. }),
        "{error}"
    );
    let apic = Scene::parse(&BLOCK.replace("\"pic\"", "\"apic\""), "block.toml".as_ref()).expect("a scene");
    let error = ReducedBody::<2>::of(&apic).err().expect("another transfer");
    assert!(
        matches!(
            error,
            OnlineError::Unsupported {
                field: "transfer.kind",
                ..
            }
        ),
        "{error}"
    );
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
        model.step()
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
