//! The paper's algorithms with every material.

use mpm_materials::{
    DruckerPrager, ElasticModuli, FixedCorotated, Hencky, IsothermalGas, KelvinVoigt, LinearCauchy, LinearElastic,
    NeoHookean, Snow, SofteningHencky, TaitFluid,
};
use parvi::{
    BasisChoice, Method, MpmOptions, PaperBody, PaperMaterial, PaperOptions, ReferenceVolumes, Run, Samples,
    ScoreLocation, Silent, sample,
};
use parvi_metrics::{Cloud, CloudMoments, GaussianEnergy};
use parvi_targets::{Banana, CatalogueTarget, Frame, Gaussian};

/// One of each, soft enough for a banana of unit scale.
fn materials() -> Vec<PaperMaterial> {
    let moduli = ElasticModuli::new(1.0, 0.3).expect("in range");
    let gas = IsothermalGas::CALIBRATED;
    vec![
        PaperMaterial::NeoHookean(NeoHookean::new(moduli)),
        PaperMaterial::LinearCauchy(LinearCauchy::new(moduli)),
        PaperMaterial::LinearElastic(LinearElastic::new(moduli)),
        PaperMaterial::FixedCorotated(FixedCorotated::new(moduli)),
        PaperMaterial::Hencky(Hencky::new(moduli)),
        PaperMaterial::KelvinVoigt(KelvinVoigt::new(moduli, 0.1).expect("in range")),
        PaperMaterial::SofteningHencky(SofteningHencky::new(moduli, 0.1, 0.05, 1.0).expect("in range")),
        PaperMaterial::DruckerPrager(DruckerPrager::new(moduli, 0.5).expect("in range")),
        PaperMaterial::Snow(Snow::fresh(moduli)),
        PaperMaterial::TaitFluid(TaitFluid::new(1.0, 1.0, 0.05).expect("in range")),
        PaperMaterial::IsothermalGas(gas),
    ]
}

#[test]
fn every_material_ends_on_a_banana_with_guards() {
    let target = Banana::new(1.0, 0.5).expect("a banana");
    let mut ends: Vec<Vec<[f64; 2]>> = Vec::new();
    for material in materials() {
        for affine in [false, true] {
            let options = PaperOptions {
                affine,
                material,
                ..PaperOptions::default()
            };
            let samples = options.sample(&target, &target.frame(), &Run::new(500, 3), &mut Silent);
            let samples = samples.unwrap_or_else(|error| panic!("{material:?}, APIC {affine}: {error}"));
            assert_eq!(samples.steps, 200);
            assert!(samples.positions.iter().flatten().all(|c| c.is_finite()));
            assert!(
                ends.iter().all(|other| other != &samples.positions),
                "{material:?} is no other"
            );
            ends.push(samples.positions);
        }
    }
}

#[test]
fn a_material_of_ones_own_is_the_same_as_that_of_the_options() {
    let target = Banana::new(1.0, 0.5).expect("a banana");
    let hencky = Hencky::new(ElasticModuli::new(2.0, 0.1).expect("in range"));
    let (run, frame) = (Run::new(200, 3), target.frame());
    let by_options = PaperOptions {
        material: PaperMaterial::Hencky(hencky),
        ..PaperOptions::default()
    };
    let by_options = by_options.sample(&target, &frame, &run, &mut Silent).expect("samples");
    let body = PaperBody {
        material: Some(&hencky),
        ..PaperBody::default()
    };
    let own = PaperOptions::default().sample_body(&body, &target, &frame, &run, &mut Silent);
    assert_eq!(by_options.positions, own.expect("samples").positions);
}

/// ED² to N(0, I), and the largest error of an entry of the covariance.
fn errors(samples: &Samples<2>) -> (f64, f64) {
    let cloud = Cloud::new(&samples.positions).expect("finite particles");
    let energy = GaussianEnergy::<2>::standard().expect("a Gaussian");
    let energy = energy.squared(&cloud).expect("ED²");
    let moments = CloudMoments::new(&cloud).expect("moments");
    let mut off = 0.0f64;
    for a in 0..2 {
        for b in 0..2 {
            off = off.max((moments.covariance.0[a][b] - f64::from(u8::from(a == b))).abs());
        }
    }
    (energy, off)
}

/// The sentence that makes the two halves of this project one: the calibrated sampler is Algorithm 2 with the one constitutive law whose rest state is the target.
///
/// On a grid so coarse, since the covariance of a body at rest is the nearer to the target's the coarser the grid is (docs/theory.md, §5); friction, since nothing else of APIC dissipates.
#[test]
fn with_the_isothermal_gas_algorithm_2_rests_at_the_target() {
    let target = Gaussian::<2>::standard();
    let options = PaperOptions {
        affine: true,
        basis: BasisChoice::Cubic,
        spacing: Some(0.8),
        material: PaperMaterial::IsothermalGas(IsothermalGas::CALIBRATED),
        score_location: ScoreLocation::Particles,
        friction: 1.0,
        ..PaperOptions::default()
    };
    let mpm = MpmOptions {
        shifts: false,
        ..MpmOptions::default()
    };
    for seed in 0..3 {
        let mut run = Run::new(512, seed);
        (run.start.mean, run.start.standard_deviation) = (0.7, 0.6);
        let (energy, off) = errors(
            &options
                .sample(&target, &Frame::identity(), &run, &mut Silent)
                .expect("samples"),
        );
        let (of_mpm, _) = errors(&sample(&target, &Method::Mpm(mpm.clone()), &run, &mut Silent).expect("samples"));
        assert!(off < 0.02, "seed {seed}: covariance off by {off}");
        assert!(energy < 2.0 * of_mpm, "seed {seed}: ED² {energy:e}, mpm {of_mpm:e}");
        // Any volumes and masses that make the same body of gas: V⁰ τ = −κ m I whatever V⁰ is.
        let wide = PaperOptions {
            reference_volumes: ReferenceVolumes::OfGrid,
            ..options.clone()
        };
        let wide = wide
            .sample(&target, &Frame::identity(), &run, &mut Silent)
            .expect("samples");
        let (of_wide, off) = errors(&wide);
        assert!(off < 0.02 && of_wide < 2.0 * of_mpm, "seed {seed}: {of_wide:e}, {off}");
    }
}
