//! Where the paper's elastic body comes to rest.

use mpm_materials::{ElasticModuli, NeoHookean};
use parvi::{PaperMaterial, PaperOptions, Run, Silent};
use parvi_targets::{Frame, Gaussian};

/// The stretch F that solves P(F) + α σ² F = 0, P = μ (F − 1/F) + λ ln F / F, by bisection (docs/theory.md, §11).
fn stretch_at_rest(moduli: ElasticModuli, strength: f64, deviation: f64) -> f64 {
    let force = |stretch: f64| {
        let stress =
            moduli.shear_modulus() * (stretch - 1.0 / stretch) + moduli.first_lame_parameter() * stretch.ln() / stretch;
        stress + strength * deviation * deviation * stretch
    };
    let (mut low, mut high) = (1e-6, 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (low + high);
        if force(middle) > 0.0 {
            high = middle;
        } else {
            low = middle;
        }
    }
    low
}

/// A body that starts as N(0, σ²) under the score of N(0, 1) is shrunk evenly: it remembers its start, and is never the target but by chance.
#[test]
fn an_elastic_body_rests_as_its_start_shrunk_by_the_closed_form() {
    let target = Gaussian::<1>::standard();
    for (modulus, ratio, deviation) in [(1.0, 0.3, 1.0), (4.0, 0.0, 1.5), (0.5, 0.4, 0.7)] {
        let moduli = ElasticModuli::new(modulus, ratio).expect("in range");
        for affine in [false, true] {
            let options = PaperOptions {
                affine,
                material: PaperMaterial::NeoHookean(NeoHookean::new(moduli)),
                friction: 1.0,
                spacing: Some(0.1),
                steps: Some(2000),
                ..PaperOptions::default()
            };
            let mut run = Run::new(1000, 1);
            (run.start.mean, run.start.standard_deviation) = (0.0, deviation);
            let samples = options
                .sample(&target, &Frame::identity(), &run, &mut Silent)
                .expect("samples");
            let squares: f64 = samples.positions.iter().map(|x| x[0] * x[0]).sum();
            let found = (squares / 1000.0).sqrt() / deviation;
            let expected = stretch_at_rest(moduli, 1.0, deviation);
            assert!(
                (found / expected - 1.0).abs() < 0.01,
                "E = {modulus}, ν = {ratio}, σ = {deviation}, APIC {affine}: {found} in place of {expected}"
            );
        }
    }
}
