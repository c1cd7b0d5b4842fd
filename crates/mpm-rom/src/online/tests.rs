#![allow(non_snake_case)]

use mpm_core::{Continuum, Masses, Mpm, NoBodyForce, Particles, Pic, SplineGrid, StepControl};
use mpm_kernels::Quadratic;
use mpm_materials::{ElasticModuli, FixedCorotated};
use mpm_scenes::Scene;
use mpm_tensor::vector;

use super::*;
use crate::deformation_map::{DeformationMap, MaterialPoints};
use crate::least_squares::LeastSquares;
use crate::manifold::{Evaluation, Fields, Manifold, Wanted};

const BLOCK: &str = include_str!("../../tests/data/block.toml");

const HELD: &str = "[[kinematic]]\nregion = { kind = \"box\", lower = [0.0, 0.0], upper = [0.125, 0.5] }\n";

const LAGRANGIAN: Quadrature = Quadrature::Lagrangian { search: Search::All };
const EULERIAN: Quadrature = Quadrature::Eulerian { per_axis: 2 };

fn body(text: &str) -> ReducedBody<2> {
    let scene = Scene::parse(text, "block.toml".as_ref()).expect("a scene");
    ReducedBody::of(&scene).expect("a body that can be reduced")
}

fn model(text: &str, fields: Fields<2>, options: Options) -> ReducedModel<'static, 2> {
    // A few numbers that the tests leave behind.
    let (body, fields): (_, &Fields<2>) = (body(text), Box::leak(Box::new(fields)));
    let zeros = vec![0.0; fields.coordinates()];
    let map = DeformationMap::new(fields, &body.reference, &zeros).expect("zero is at rest");
    ReducedModel::new(body, map, options).expect("options in range")
}

fn options(samples: SampleChoice, quadrature: Quadrature, update: Update) -> Options {
    Options {
        samples,
        weights: SampleWeights::default(),
        quadrature,
        update,
        inverted: Inverted::Refuse,
    }
}

/// All steps of one frame.
fn advance_frame(model: &mut ReducedModel<'_, 2>) -> Result<StepReport, OnlineError> {
    let body = model.body();
    model.advance_to(model.time() + body.steps_per_frame as f64 * body.time_step)
}

#[test]
fn free_fall_is_exact_with_every_scheme() {
    let text = BLOCK.replace("gravity = [0.0, 0.0]", "gravity = [3.0, -10.0]");
    let few = SampleChoice::Drawn { count: 3, seed: 4 };
    let redrawn = SampleChoice::Redrawn { count: 3, seed: 4 };
    for quadrature in [
        LAGRANGIAN,
        EULERIAN,
        Quadrature::Lagrangian {
            search: Search::Lists { skin: 0.5 },
        },
    ] {
        for update in [Update::VelocityOnly, Update::PositionVelocity] {
            for samples in [SampleChoice::All, few.clone(), redrawn.clone()] {
                let mut model = model(&text, Fields::translations(), options(samples, quadrature, update));
                for _ in 0..3 {
                    advance_frame(&mut model).expect("a step");
                }
                // Symplectic Euler: x_n = Δt² g n (n + 1) / 2, n = 30.
                for (a, g) in [3.0, -10.0].into_iter().enumerate() {
                    let exact = 0.002 * 0.002 * g * 465.0;
                    assert!((model.latent()[a] - exact).abs() < 1e-13, "{quadrature:?} {update:?}");
                    assert!((model.rates()[a] - 0.06 * g).abs() < 1e-12);
                }
            }
        }
    }
}

/// All points of a model's body.
fn all_points(model: &ReducedModel<'_, 2>) -> MaterialPoints<2> {
    model.prepare(&model.body().reference)
}

/// v_p of all points after one full-order step from the model's state.
fn full_order_step(model: &ReducedModel<'_, 2>) -> (Vec<[f64; 2]>, Evaluation<2>) {
    let (mut there, mut moving) = (Evaluation::default(), Evaluation::default());
    let points = all_points(model);
    model.evaluate(&points, Wanted::ALL, &mut there);
    let (latent, rates) = (model.latent(), model.rates());
    model.map.evaluate_moving(&points, latent, rates, &mut moving);
    let (body, start) = (model.body(), moving.velocities);
    let masses = body.volumes.iter().map(|volume| body.density * volume).collect();
    let numbers = (0..start.len() as u32).collect();
    let particles = Particles::in_order(
        there.positions.clone(),
        start,
        Masses::Each(masses),
        Vec::new(),
        numbers,
    );
    let mut particles = particles
        .expect("equal lengths")
        .with_elastic_state(body.volumes.clone());
    particles.deformation_gradients = there.gradients.clone();
    let grid = SplineGrid::<Quadratic, 3, 2>::new(*body.grid.origin(), body.grid.spacing()).expect("a grid");
    let law = FixedCorotated::new(ElasticModuli::new(100.0, 0.3).expect("in range"));
    let mut mpm = Mpm::new(particles, grid, Pic, Continuum { law }, NoBodyForce);
    let control = StepControl {
        time_step: body.time_step,
        courant: f64::INFINITY,
        displacement: f64::INFINITY,
        friction: 0.0,
    };
    mpm.step(&control).expect("a step");
    (
        mpm.particles.in_creation_order(&mpm.particles.velocities).to_vec(),
        there,
    )
}

#[test]
fn a_lagrangian_step_is_the_projected_full_order_step() {
    let draw = |count| SampleChoice::Drawn { count, seed: 1 };
    for (samples, search) in [
        (SampleChoice::All, Search::All),
        (draw(5), Search::All),
        (draw(5), Search::Lists { skin: 0.25 }),
    ] {
        let chosen = options(samples.clone(), Quadrature::Lagrangian { search }, Update::VelocityOnly);
        let mut model = model(BLOCK, Fields::bending(4), chosen);
        model.coordinates.latent = vec![0.3, -0.2, 0.4, 0.1];
        model.coordinates.rates = vec![1.0, 0.5, -2.0, 0.3];
        let before = model.latent().to_vec();
        let (full, there) = full_order_step(&model);
        let report = model.step().expect("a step");
        assert!(report.nodes > 9 && (samples != SampleChoice::All || report.quadrature_points == full.len()));
        // The naive projection: the same sum over the sample points.
        let numbers: Vec<usize> = model.samples().iter().map(|&p| p as usize).collect();
        let targets: Vec<[f64; 2]> = numbers.iter().map(|&p| full[p]).collect();
        let rows = numbers.iter().flat_map(|&p| there.jacobians[4 * p..4 * p + 4].to_vec());
        let mut expected = vec![0.0; 4];
        LeastSquares::default()
            .solve(&rows.collect::<Vec<_>>(), &targets, &mut expected)
            .expect("of full rank");
        for k in 0..4 {
            assert!(
                (model.rates()[k] - expected[k]).abs() < 1e-10,
                "{samples:?}: {:?} {expected:?}",
                model.rates()
            );
            assert!((model.latent()[k] - before[k] - 0.002 * expected[k]).abs() < 1e-12);
        }
    }
}

#[test]
fn neighbour_lists_find_what_the_search_of_all_points_finds() {
    let samples = SampleChoice::Drawn { count: 8, seed: 2 };
    let run = |search| {
        let chosen = options(
            samples.clone(),
            Quadrature::Lagrangian { search },
            Update::PositionVelocity,
        );
        let mut model = model(BLOCK, Fields::bending(3), chosen);
        model.coordinates.rates = vec![6.0, 0.5, -2.0];
        let mut bent = 0.0f64;
        let reports: Vec<StepReport> = (0..200)
            .map(|_| {
                bent = bent.max(model.latent()[0].abs());
                model.step().expect("a step")
            })
            .collect();
        (model.latent().to_vec(), reports, bent)
    };
    let (oracle, all, bent) = run(Search::All);
    let (found, lists, _) = run(Search::Lists { skin: 0.2 });
    assert_eq!(oracle, found);
    assert!(bent > 0.05, "it has bent: {bent}");
    let count = |reports: &[StepReport]| {
        let counts = reports.iter().map(|report| report.quadrature_points);
        counts.collect::<Vec<_>>()
    };
    assert_eq!(count(&all), count(&lists));
    let refreshes = lists.last().map_or(0, |report| report.refreshes);
    assert!((2..150).contains(&refreshes), "{refreshes} of 200 steps");
}

mod moving;
mod redrawn;
mod refused;

#[test]
fn states_lie_along_what_moves_the_body_only() {
    // The second coordinate moves what the first one does: one of two eigenvalues is zero but for rounding.
    let doubled = Fields {
        coordinates: 2,
        field: |k, x| {
            (
                vector::scale(&[x[0], 0.3 * x[1]], 1.0 + 2.0 * k as f64),
                mpm_tensor::Matrix::ZERO,
            )
        },
        curvature: 0.0,
    };
    let body = body(BLOCK);
    let points = SampleChoice::All;
    // x̂₀ is not unique: none is looked for.
    let map = DeformationMap::at(&doubled, vec![0.0; 2]);
    let numbers = points.choose(&body.reference, 2, &body.kinematics).expect("all");
    let model = ReducedModel::to_read(body, map, numbers, LAGRANGIAN).expect("in range");
    let states = model.states_around(&[0.0; 2], 0.01);
    assert_eq!(states.len(), 2, "{states:?}");
    assert!(states.iter().flatten().all(|y| y.abs() < 1.0), "{states:?}");
}
