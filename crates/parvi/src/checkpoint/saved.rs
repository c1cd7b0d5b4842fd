//! Bodies and states as plain numbers, for the file.

use mpm_core::{Masses, MpmError, Particles};
use mpm_tensor::Matrix;
use parvi_body::{Record, Stiffness};
use serde::{Deserialize, Serialize};

use crate::Samples;
use crate::driven::Driven;
use crate::extent::Extent;
use crate::guard::{Progressed, State};

/// A body at its end.
#[derive(Serialize, Deserialize)]
pub(super) struct SavedBody {
    positions: Vec<f64>,
    scores: Vec<f64>,
    seen: Vec<f64>,
    steps: usize,
    score_evaluations: u64,
    scores_replaced: u64,
    residual: Option<f64>,
    spacing: Option<f64>,
    active_nodes: Option<usize>,
    storage_bytes: Option<usize>,
    drift: f64,
    kinetic_energy: f64,
}

/// A body on its way.
#[derive(Serialize, Deserialize)]
pub(super) struct SavedState {
    step: usize,
    time: f64,
    caution: f64,
    retries: usize,
    evaluations: u64,
    replaced: u64,
    earlier: Vec<f64>,
    mass: f64,
    positions: Vec<f64>,
    velocities: Vec<f64>,
    affine: Vec<f64>,
    identities: Vec<u32>,
    stiffness: Option<SavedStiffness>,
}

#[derive(Serialize, Deserialize)]
struct SavedStiffness {
    estimate: f64,
    stride: usize,
    now: Vec<f64>,
    before: Vec<f64>,
}

impl<const D: usize> From<&Driven<D>> for SavedBody {
    fn from(body: &Driven<D>) -> Self {
        let samples = &body.samples;
        Self {
            positions: body.positions.as_flattened().to_vec(),
            scores: body.scores.as_flattened().to_vec(),
            seen: samples.positions.as_flattened().to_vec(),
            steps: samples.steps,
            score_evaluations: samples.score_evaluations,
            scores_replaced: samples.scores_replaced,
            residual: samples.residual,
            spacing: samples.spacing,
            active_nodes: samples.active_nodes,
            storage_bytes: samples.storage_bytes,
            drift: body.drift,
            kinetic_energy: body.kinetic_energy,
        }
    }
}

impl<const D: usize> From<&SavedBody> for Driven<D> {
    fn from(saved: &SavedBody) -> Self {
        Self {
            samples: Samples {
                positions: rows(&saved.seen),
                steps: saved.steps,
                score_evaluations: saved.score_evaluations,
                scores_replaced: saved.scores_replaced,
                residual: saved.residual,
                spacing: saved.spacing,
                active_nodes: saved.active_nodes,
                bodies: Some(1),
                storage_bytes: saved.storage_bytes,
                ..Samples::default()
            },
            positions: rows(&saved.positions),
            scores: rows(&saved.scores),
            drift: saved.drift,
            kinetic_energy: saved.kinetic_energy,
        }
    }
}

impl<const D: usize> From<&State<D>> for SavedState {
    fn from(state: &State<D>) -> Self {
        let (particles, so_far) = (&state.particles, &state.so_far);
        let identities = (0..particles.len()).map(|k| particles.identity(k) as u32).collect();
        Self {
            step: state.step,
            time: so_far.time,
            caution: state.caution,
            retries: state.retries,
            evaluations: so_far.evaluations,
            replaced: so_far.replaced,
            earlier: [so_far.earlier.mean, so_far.earlier.deviation].as_flattened().to_vec(),
            mass: particles.masses.get(0),
            positions: particles.positions.as_flattened().to_vec(),
            velocities: particles.velocities.as_flattened().to_vec(),
            affine: particles.affine.iter().flat_map(|matrix| matrix.0).flatten().collect(),
            identities,
            stiffness: state.stiffness.as_ref().map(|stiffness| SavedStiffness {
                estimate: stiffness.estimate,
                stride: stiffness.stride,
                now: flat(&stiffness.now),
                before: flat(&stiffness.before),
            }),
        }
    }
}

impl<const D: usize> TryFrom<SavedState> for State<D> {
    type Error = MpmError;

    fn try_from(saved: SavedState) -> Result<Self, MpmError> {
        let affine = rows::<D>(&saved.affine);
        let affine = affine
            .chunks_exact(D)
            .map(|chunk| Matrix(std::array::from_fn(|i| chunk[i])))
            .collect();
        let earlier = rows::<D>(&saved.earlier);
        Ok(Self {
            step: saved.step,
            caution: saved.caution,
            retries: saved.retries,
            so_far: Progressed {
                time: saved.time,
                evaluations: saved.evaluations,
                replaced: saved.replaced,
                earlier: Extent {
                    mean: earlier.first().copied().unwrap_or([0.0; D]),
                    deviation: earlier.get(1).copied().unwrap_or([1.0; D]),
                },
            },
            particles: Particles::in_order(
                rows(&saved.positions),
                rows(&saved.velocities),
                Masses::Equal(saved.mass),
                affine,
                saved.identities,
            )?
            .remembering(),
            stiffness: saved.stiffness.map(|stiffness| Stiffness {
                estimate: stiffness.estimate,
                stride: stiffness.stride,
                now: records(&stiffness.now),
                before: records(&stiffness.before),
            }),
        })
    }
}

fn flat<const D: usize>(records: &[Record<D>]) -> Vec<f64> {
    records.iter().flat_map(|(x, s)| x.iter().chain(s)).copied().collect()
}

fn records<const D: usize>(numbers: &[f64]) -> Vec<Record<D>> {
    rows::<D>(numbers)
        .chunks_exact(2)
        .map(|pair| (pair[0], pair[1]))
        .collect()
}

fn rows<const D: usize>(numbers: &[f64]) -> Vec<[f64; D]> {
    numbers.as_chunks().0.to_vec()
}
