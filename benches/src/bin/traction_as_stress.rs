//! A thick-walled cylinder (radii 1 and 2, E = 10⁶, ν = 0.3, ρ = 1000, pressure 1000 inside) loaded in two ways, beside Lamé's solution:
//! `cargo run --release -p parvi-benches --bin traction_as_stress -- experiments/meshes/ring.msh 0.04`.
//!
//! At nodes: f_i = Σ_v w_i(x_v) Σ_f t A_f / 2, as the facets of scenes do. As a stress: f_i = Σ_p V_p (S_p g_ip + w_ip div S_p) with S = −p φ I, φ falling from 1 at the hole to 0 a
//! band outside; the same sums as the internal forces, so that their errors cancel where σ = S. div S is scaled so that the work on u = x is exact.

#![allow(non_snake_case, reason = "F and X are what the field calls them")]

use std::collections::{BTreeMap, HashSet};
use std::error::Error;
use std::f64::consts::TAU;
use std::io::Write;

use mpm_core::{Boundaries, Continuum, Flip, Mpm, NoBodyForce, NodeForces, Particles, StepControl};
use mpm_materials::{ElasticModuli, Material, NeoHookean};
use mpm_mesh::generate::with_outer_layer;
use mpm_mesh::{CellSearch, KernelWidth, MeshBasis, NamedMesh, read_named_msh, recovered};
use mpm_tensor::Matrix;
use mpm_tensor::vector::{accumulate, norm};

const PRESSURE: f64 = 1000.0;
/// p a² / (b² − a²).
const MEAN: f64 = PRESSURE / 3.0;
const YOUNG: f64 = 1e6;
const POISSON: f64 = 0.3;

/// Positions and stresses of particles.
type State = (Vec<[f64; 2]>, Vec<Matrix<2>>);

/// Forces by vertex of the basis.
type Forces = BTreeMap<u32, [f64; 2]>;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [file, spacing] = &arguments[..] else {
        return Err("two arguments: the mesh of the ring and the distance between particles".into());
    };
    let spacing: f64 = spacing.parse()?;
    if !(0.005..0.2).contains(&spacing) {
        return Err("a distance from 0.005 to 0.2".into());
    }
    let named = read_named_msh::<2>(&std::fs::read(file)?)?;
    let whole = with_outer_layer(&named.mesh)?.0;
    let basis = MeshBasis::new(&whole)?.with_kernel_width(KernelWidth::Local);
    let (points, volume) = rings(spacing);
    let search = CellSearch::new(whole);
    let mut output = std::io::stdout().lock();
    writeln!(
        output,
        "load, displacements; stresses, the same from r = 1.25 on; recovered, the same from r = 1.25 on; in % of the largest"
    )?;
    let loads = [
        ("at nodes".to_owned(), at_nodes(&basis, &named)),
        ("stress, 0.15".to_owned(), as_stress(&basis, &points, volume, 0.15)),
        ("stress, 0.3".to_owned(), as_stress(&basis, &points, volume, 0.3)),
    ];
    for (name, forces) in loads {
        let (positions, stresses) = at_rest(&basis, &points, volume, &forces)?;
        let smooth = recovered(&search, &positions, &vec![volume; points.len()], &stresses);
        let [all, far] = [1.0, 1.25].map(|least| error_of_stresses(&points, &stresses, least));
        let [smooth, smooth_far] = [1.0, 1.25].map(|least| error_of_stresses(&points, &smooth, least));
        let displacement = error_of_displacements(&points, &positions);
        writeln!(
            output,
            "{name}: {displacement:.2}; {all:.2}, {far:.2}; {smooth:.2}, {smooth_far:.2}"
        )?;
    }
    Ok(())
}

/// Particles of equal volume in rings, as `fill = "rings"` of scenes.
fn rings(step: f64) -> (Vec<[f64; 2]>, f64) {
    let number = (1.0 / step).round();
    let sizes: Vec<f64> = (0..number as usize)
        .map(|k| (TAU * (1.0 + (k as f64 + 0.5) / number) / step).round())
        .collect();
    let volume = 1.5 * TAU / sizes.iter().sum::<f64>();
    let (mut points, mut square) = (Vec::new(), 1.0);
    for (k, &size) in sizes.iter().enumerate() {
        let area = 2.0 * size * volume / TAU;
        let radius = (square + 0.5 * area).sqrt();
        square += area;
        let angle = |j: usize| TAU * ((j as f64 + 0.5) / size + k as f64 * 0.618_033_988_749_894_9);
        points.extend((0..size as usize).map(|j| [radius * angle(j).cos(), radius * angle(j).sin()]));
    }
    (points, volume)
}

fn at_nodes(basis: &MeshBasis<2>, named: &NamedMesh<2>) -> Forces {
    let sorted = |facet: &[u32]| [facet[0].min(facet[1]), facet[0].max(facet[1])];
    let hole: HashSet<[u32; 2]> = named
        .facets
        .get("inner")
        .into_iter()
        .flat_map(|list| list.chunks_exact(2))
        .map(sorted)
        .collect();
    let mut forces = Forces::new();
    for facet in named.mesh.boundary() {
        if !hole.contains(&sorted(&facet.vertices)) {
            continue;
        }
        for vertex in facet.vertices {
            for weight in basis
                .weights_at(&named.mesh.vertices()[vertex as usize])
                .unwrap_or_default()
            {
                let share = -0.5 * PRESSURE * facet.area * weight.entry.weight;
                accumulate(forces.entry(weight.vertex).or_insert([0.0; 2]), share, &facet.normal);
            }
        }
    }
    forces
}

fn as_stress(basis: &MeshBasis<2>, points: &[[f64; 2]], volume: f64, band: f64) -> Forces {
    let near = || points.iter().filter(|x| norm(x) < 1.0 + band);
    let falling = |x: &[f64; 2]| 1.0 - (norm(x) - 1.0) / band;
    // ∫ t · x dA = 2π p = Σ V (tr S + x · div S).
    let of_stress: f64 = near().map(|x| -2.0 * PRESSURE * volume * falling(x)).sum();
    let of_divergence: f64 = near().map(|x| PRESSURE * volume / band * norm(x)).sum();
    let scale = (TAU * PRESSURE - of_stress) / of_divergence;
    let mut forces = Forces::new();
    for x in near() {
        for weight in basis.weights_at(x).unwrap_or_default() {
            let force = forces.entry(weight.vertex).or_insert([0.0; 2]);
            accumulate(force, -PRESSURE * volume * falling(x), &weight.entry.gradient);
            let divergence = scale * PRESSURE / band / norm(x);
            accumulate(force, volume * weight.entry.weight * divergence, x);
        }
    }
    forces
}

/// Positions and stresses after two seconds of damped motion, the load growing over the first.
fn at_rest(basis: &MeshBasis<2>, points: &[[f64; 2]], volume: f64, forces: &Forces) -> Result<State, Box<dyn Error>> {
    let law = NeoHookean::new(ElasticModuli::new(YOUNG, POISSON)?);
    let count = points.len();
    let particles =
        Particles::at_rest(points.to_vec(), 1000.0 * volume * count as f64).with_elastic_state(vec![volume; count]);
    let forces = forces
        .iter()
        .map(|(&vertex, &force)| (basis.mesh().vertices()[vertex as usize], force))
        .collect();
    let load = NodeForces { forces, ramp: 1.0 };
    let boundary = Boundaries::new(Vec::new(), Vec::new()).with_forces(vec![load]);
    let medium = Continuum { law };
    let mut body = Mpm::new(particles, basis.clone(), Flip::blend(1.0), medium, NoBodyForce).with_boundary(boundary);
    let control = StepControl {
        time_step: 1.0,
        courant: 0.4,
        displacement: f64::INFINITY,
        friction: 20.0,
    };
    while body.time < 2.0 {
        body.step(&control)?;
    }
    let particles = &body.particles;
    let deformations = particles.in_creation_order(&particles.deformation_gradients);
    let stress = |F: &Matrix<2>| body.medium.law.kirchhoff_stress(F) * (1.0 / F.determinant());
    Ok((
        particles.in_creation_order(&particles.positions),
        deformations.iter().map(stress).collect(),
    ))
}

fn error_of_displacements(points: &[[f64; 2]], positions: &[[f64; 2]]) -> f64 {
    let exact = |r: f64| (1.0 + POISSON) / YOUNG * MEAN * ((1.0 - 2.0 * POISSON) * r + 4.0 / r);
    let squares = points.iter().zip(positions).map(|(X, x)| {
        let stretch = 1.0 + exact(norm(X)) / norm(X);
        (x[0] - stretch * X[0]).powi(2) + (x[1] - stretch * X[1]).powi(2)
    });
    100.0 * (squares.sum::<f64>() / points.len() as f64).sqrt() / exact(1.0)
}

/// Of the particles that start at `least` or farther out.
fn error_of_stresses(points: &[[f64; 2]], stresses: &[Matrix<2>], least: f64) -> f64 {
    let (mut squares, mut count) = (0.0, 0.0);
    for (X, stress) in points.iter().zip(stresses).filter(|(X, _)| norm(X) >= least) {
        let ratio = 4.0 / norm(X).powi(2);
        let along = Matrix::outer(X, X) * (0.25 * ratio);
        let exact = along * (MEAN * (1.0 - ratio)) + (Matrix::IDENTITY - along) * (MEAN * (1.0 + ratio));
        squares += (*stress - exact).frobenius_norm().powi(2);
        count += 1.0;
    }
    100.0 * (squares / count).sqrt() / (MEAN * 34f64.sqrt())
}
