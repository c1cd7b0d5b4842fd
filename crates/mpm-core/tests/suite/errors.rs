//! States that the step refuses: what it says, and that the particles stay as they were.

use mpm_core::{
    Apic, Basis, BodyForce, Continuum, ForceLocation, Masses, Medium, Mpm, MpmError, Particles, Pic, SimplexLattice,
    Sites, SplineGrid, Transfer, UniformBasis,
};
use mpm_kernels::{Linear, Quadratic};
use mpm_materials::{DeformationError, ElasticModuli, IsothermalGas, KelvinVoigt, LinearElastic};
use mpm_tensor::Matrix;

use crate::scenes::{Pull, bits, free, gaussian_cloud, matrix_bits, neo_hookean, solid};

const COUNT: usize = 50;

fn grid() -> SplineGrid<Quadratic, 3, 2> {
    SplineGrid::new([0.0; 2], 0.5).unwrap()
}

fn cloud() -> Particles<2> {
    Particles::at_rest(gaussian_cloud(COUNT, 21), 1.0)
}

/// Everything a particle carries, in the order of creation.
fn state(particles: &Particles<2>) -> Vec<u64> {
    let mut all = bits(&particles.in_creation_order(&particles.positions));
    all.extend(bits(&particles.in_creation_order(&particles.velocities)));
    all.extend(matrix_bits(
        &particles.in_creation_order(&particles.deformation_gradients),
    ));
    all
}

/// The error of a step, after which nothing has moved.
fn refused<T: Transfer<2>, M: Medium<2, State = ()>, F: BodyForce<2>>(
    mpm: &mut Mpm<2, SplineGrid<Quadratic, 3, 2>, T, M, F>,
) -> MpmError {
    let before = state(&mpm.particles);
    let error = mpm.step(&free(0.01)).expect_err("a state to be refused");
    assert!(before == state(&mpm.particles), "{error}: particles have changed");
    error
}

/// Where the particle created as number `identity` stands now.
fn place_of(particles: &Particles<2>, identity: usize) -> usize {
    (0..particles.len())
        .find(|&k| particles.identity(k) == identity)
        .unwrap()
}

#[test]
fn a_position_outside_the_range_names_the_particle() {
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 6e8, -6e8, 1e300] {
        let mut mpm = Mpm::new(cloud(), grid(), Pic, IsothermalGas::CALIBRATED, Pull::none());
        mpm.step(&free(0.01)).unwrap();
        let place = place_of(&mpm.particles, 17);
        assert_ne!(place, 17, "the order must have changed for this test to tell");
        mpm.particles.positions[place][1] = bad;
        let MpmError::PositionOutOfRange {
            particle,
            position,
            spacing,
        } = refused(&mut mpm)
        else {
            panic!("another error");
        };
        assert_eq!((particle, spacing), (17, 0.5));
        assert_eq!(position[1].to_bits(), bad.to_bits());
        // Put back, the body goes on: a failed rebuild leaves nothing behind.
        mpm.particles.positions[place][1] = 0.1;
        mpm.step(&free(0.01)).unwrap();
    }
}

#[test]
fn positions_up_to_two_to_the_30_spacings_are_fine() {
    let edge = 0.5 * f64::from((1u32 << 30) - 1);
    let mut mpm = Mpm::new(cloud(), grid(), Pic, IsothermalGas::CALIBRATED, Pull::none());
    mpm.particles.positions[0] = [edge, -edge];
    mpm.step(&free(0.01)).unwrap();
    mpm.particles.positions[0] = [0.0, f64::from(1u32 << 29)];
    refused(&mut mpm);
}

#[test]
fn a_rebuild_that_failed_leaves_an_empty_schedule() {
    let mut grid = grid();
    grid.rebuild(&[[0.0; 2], [3.0; 2]]).unwrap();
    assert!(grid.rebuild(&[[f64::NAN; 2]]).is_err());
    assert_eq!((grid.schedule().cell_count(), grid.schedule().parts().len()), (0, 0));
}

#[test]
fn a_force_that_is_not_finite_names_the_particle() {
    for bad in [f64::NAN, f64::INFINITY] {
        let initial = cloud().positions[33];
        let pull = Pull::at_particles(move |x| if *x == initial { [1.0, bad] } else { [0.0; 2] });
        let mut mpm = Mpm::new(cloud(), grid(), Pic, IsothermalGas::CALIBRATED, pull);
        let MpmError::BodyForceNotFinite { index, position, value } = refused(&mut mpm) else {
            panic!("another error");
        };
        assert_eq!((index, position), (33, initial.to_vec()));
        assert_eq!(value[1].to_bits(), bad.to_bits());
    }
}

/// A force that reports its own failure speaks of the batch; the step of the particle.
struct Reporting;

impl BodyForce<2> for Reporting {
    fn location(&self) -> ForceLocation {
        ForceLocation::Particles
    }

    fn at_particles(&mut self, sites: &Sites<2>, _: &mut [[f64; 2]]) -> Result<(), MpmError> {
        let wanted = gaussian_cloud::<2>(COUNT, 21)[8];
        let index = sites.positions.iter().position(|x| *x == wanted).unwrap();
        Err(MpmError::BodyForceNotFinite {
            index,
            position: wanted.to_vec(),
            value: vec![f64::NAN; 2],
        })
    }
}

#[test]
fn a_reported_force_is_renamed() {
    let mut mpm = Mpm::new(cloud(), grid(), Pic, IsothermalGas::CALIBRATED, Pull::by(Reporting));
    assert!(matches!(
        refused(&mut mpm),
        MpmError::BodyForceNotFinite { index: 8, .. }
    ));
}

#[test]
fn a_nodal_force_that_is_not_finite_gives_the_node() {
    let pull = Pull::at_nodes(|x, _| if x[0] > 0.9 { [f64::NAN, 0.0] } else { [0.0; 2] });
    let mut mpm = Mpm::new(cloud(), grid(), Pic, IsothermalGas::CALIBRATED, pull);
    let MpmError::BodyForceNotFinite { position, value, .. } = refused(&mut mpm) else {
        panic!("another error");
    };
    assert!(position[0] > 0.9 && value[0].is_nan());
}

#[test]
fn a_velocity_that_is_not_finite_is_found_at_a_node() {
    let mut mpm = Mpm::new(cloud(), grid(), Pic, IsothermalGas::CALIBRATED, Pull::none());
    mpm.particles.velocities[3] = [f64::NAN, 0.0];
    assert!(matches!(refused(&mut mpm), MpmError::VelocityNotFinite { .. }));
    mpm.particles = cloud();
    mpm.particles.masses = Masses::Each(vec![f64::NAN; COUNT]);
    assert!(matches!(refused(&mut mpm), MpmError::VelocityNotFinite { .. }));
}

/// Of a gas, whose wave speed knows no mass.
#[test]
fn a_mass_below_zero_is_refused() {
    let mut each = vec![0.02; COUNT];
    each[7] = -0.02;
    for masses in [Masses::Equal(-0.02), Masses::Each(each)] {
        let mut mpm = Mpm::new(cloud(), grid(), Pic, IsothermalGas::CALIBRATED, Pull::none());
        mpm.particles.masses = masses;
        let error = refused(&mut mpm);
        let named = matches!(
            error,
            MpmError::InvalidParameter {
                field: "masses",
                value: -0.02,
                ..
            }
        );
        assert!(named, "{error}");
    }
}

#[test]
fn an_inverted_particle_is_named() {
    let particles = cloud().with_elastic_state(vec![0.1; COUNT]);
    let mut mpm = Mpm::new(particles, grid(), Pic, neo_hookean(1.0), Pull::none());
    mpm.step(&free(0.01)).unwrap();
    let place = place_of(&mpm.particles, 5);
    assert_ne!(place, 5);
    mpm.particles.deformation_gradients[place] = Matrix::diagonal(&[1.0, -0.5]);
    let source = DeformationError::VolumeRatio { volume_ratio: -0.5 };
    assert_eq!(refused(&mut mpm), MpmError::Deformation { particle: 5, source });
    mpm.particles.deformation_gradients[place] = Matrix::diagonal(&[1.0, f64::INFINITY]);
    let MpmError::Deformation {
        particle: 5,
        source: DeformationError::NotFinite { row: 1, column: 1, .. },
    } = refused(&mut mpm)
    else {
        panic!("another error");
    };
    let message = refused(&mut mpm).to_string();
    assert_eq!(
        message,
        "particle 5: the deformation gradient is not finite: entry (1, 1) is inf"
    );
}

/// A step that is too long turns particles inside out; the one after it says so.
#[test]
fn a_step_that_is_too_long_ends_in_a_typed_error() {
    let squeeze = Pull::at_particles(|x| x.map(|c| -1e4 * c));
    let particles = cloud().with_elastic_state(vec![0.1; COUNT]);
    let mut mpm = Mpm::new(particles, grid(), Pic, neo_hookean(1.0), squeeze);
    let error = (0..50).find_map(|_| mpm.step(&free(0.05)).err());
    assert!(matches!(error, Some(MpmError::Deformation { .. })), "{error:?}");
}

#[test]
fn linear_elasticity_admits_inversion_but_not_nan() {
    let law = solid(LinearElastic::new(ElasticModuli::new(1.0, 0.3).unwrap()));
    let particles = cloud().with_elastic_state(vec![0.1; COUNT]);
    let mut mpm = Mpm::new(particles, grid(), Pic, law, Pull::none());
    mpm.particles.deformation_gradients[0] = Matrix::diagonal(&[1.0, -0.5]);
    mpm.step(&free(0.01)).unwrap();
    mpm.particles.deformation_gradients[0].0[0][1] = f64::NAN;
    assert!(matches!(refused(&mut mpm), MpmError::Deformation { .. }));
}

#[test]
fn a_reference_volume_without_sense_is_an_error() {
    for volume in [-0.1, 0.0, f64::NAN] {
        let particles = cloud().with_elastic_state(vec![volume; COUNT]);
        let mut mpm = Mpm::new(particles, grid(), Pic, neo_hookean(1.0), Pull::none());
        let error = refused(&mut mpm);
        assert!(matches!(error, MpmError::WaveSpeed { particle: 0, .. }));
        assert!(
            error.to_string().contains(&format!("and reference volume {volume}")),
            "{error}"
        );
    }
}

#[test]
fn missing_and_misfitting_fields_are_named() {
    let field = |mut particles: Particles<2>, change: fn(&mut Particles<2>)| {
        change(&mut particles);
        let mut mpm = Mpm::new(particles, grid(), Pic, neo_hookean(1.0), Pull::none());
        match mpm.step(&free(0.01)) {
            Err(MpmError::FieldLength { field, expected, .. }) => {
                assert_eq!(expected, COUNT);
                field
            }
            other => panic!("{other:?}"),
        }
    };
    let elastic = || cloud().with_elastic_state(vec![0.1; COUNT]);
    assert_eq!(field(cloud(), |_| ()), "deformation_gradients");
    assert_eq!(
        field(cloud().with_elastic_state(vec![0.1; 3]), |_| ()),
        "reference_volumes"
    );
    assert_eq!(field(elastic(), |p| p.positions.truncate(3)), "positions");
    assert_eq!(field(elastic(), |p| p.velocities.push([0.0; 2])), "velocities");
    assert_eq!(field(elastic(), |p| p.affine.push(Matrix::ZERO)), "affine");
    assert_eq!(field(elastic(), |p| p.masses = Masses::Each(vec![1.0])), "masses");
}

/// A body that goes on from a list of another one: neither cut nor filled with zeros.
#[test]
fn misfitting_fields_that_a_body_would_add_are_named() {
    let viscous = || Continuum {
        law: KelvinVoigt::new(ElasticModuli::new(1.0, 0.3).unwrap(), 0.1).unwrap(),
    };
    for length in [1, COUNT - 1, COUNT + 1] {
        let mut particles = cloud().with_elastic_state(vec![0.1; COUNT]);
        particles.affine = vec![Matrix::ZERO; length];
        let error = refused(&mut Mpm::new(particles, grid(), Apic, neo_hookean(1.0), Pull::none()));
        assert!(
            matches!(error, MpmError::FieldLength { field: "affine", .. }),
            "{error}"
        );
        let mut particles = cloud().with_elastic_state(vec![0.1; COUNT]);
        particles.velocity_gradients = vec![Matrix::ZERO; length];
        let error = refused(&mut Mpm::new(particles, grid(), Pic, viscous(), Pull::none()));
        let field = "velocity_gradients";
        assert!(
            matches!(error, MpmError::FieldLength { field: named, .. } if named == field),
            "{error}"
        );
    }
}

#[test]
fn a_grid_without_a_spacing_or_an_origin_is_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = SplineGrid::<Linear, 2, 2>::new([0.0; 2], bad).expect_err("a bad spacing");
        assert!(matches!(error, MpmError::InvalidParameter { field: "spacing", .. }));
        let mut grid = grid();
        assert!(grid.place([0.0; 2], bad).is_err());
        assert_eq!(grid.spacing(), 0.5, "a refused spacing changes nothing");
    }
    let error = SplineGrid::<Linear, 2, 2>::new([0.0, f64::NAN], 1.0).expect_err("a bad origin");
    assert!(matches!(error, MpmError::InvalidParameter { field: "origin", .. }));
}

#[test]
fn no_particles_are_no_error() {
    let particles = Particles::at_rest(Vec::new(), 1.0).with_elastic_state(Vec::new());
    let mut mpm = Mpm::new(particles, grid(), Pic, neo_hookean(1.0), Pull::none());
    let report = mpm.step(&free(0.01)).unwrap();
    assert_eq!((report.active_nodes, report.displacement), (0, 0.0));
}

#[test]
fn a_lattice_names_the_particle_and_recovers() {
    let limit = (1u64 << 30) as f64; // lattice coordinates, here those of space
    for bad in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, limit, -limit, 1e300] {
        let mut lattice = SimplexLattice::kuhn([0.0; 2], 1.0).unwrap();
        let mut positions = gaussian_cloud::<2>(COUNT, 21);
        lattice.rebuild(&positions).unwrap();
        let (nodes, kept) = (lattice.node_count(), positions[17]);
        positions[17][1] = bad;
        let error = lattice.rebuild(&positions).expect_err("a position out of range");
        assert!(
            matches!(&error, MpmError::PositionOutOfRange { particle: 17, .. }),
            "{bad}: {error}"
        );
        assert!(lattice.schedule().parts().is_empty());
        positions[17] = kept;
        lattice.rebuild(&positions).unwrap();
        assert_eq!(lattice.node_count(), nodes);
    }
    // The last coordinates that are in range, and none at all.
    let mut lattice = SimplexLattice::kuhn([0.0; 2], 1.0).unwrap();
    lattice.rebuild(&[[limit - 1.0, 1.0 - limit], [0.0; 2]]).unwrap();
    assert!((5..=6).contains(&lattice.node_count()));
    lattice.rebuild(&[]).unwrap();
    assert_eq!(lattice.node_count(), 0);
    lattice.rebuild(&[[0.25, 0.5]]).unwrap();
    assert_eq!(lattice.node_count(), 3);
}

/// The fields are anyone's to change.
#[test]
fn sums_over_particles_without_a_mass_are_no_numbers() {
    let mut particles = Particles::at_rest(vec![[0.0, 1.0], [1.0, 2.0]], 2.0);
    particles.masses = Masses::Each(vec![1.0]);
    assert!(particles.kinetic_energy().is_nan());
    assert!(particles.momentum()[0].is_nan());
    assert!(particles.angular_momentum((0, 1)).is_nan());
}
