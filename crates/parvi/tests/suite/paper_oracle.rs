//! Algorithms 1 and 2 as the paper writes them, and their hybrid with FLIP, beside a second program of theirs on dense arrays that shares nothing with the first.

use mpm_materials::{ElasticModuli, IsothermalGas, Law, LinearCauchy, LinearElastic, Memory, NeoHookean, Numbered};
use mpm_tensor::Matrix;
use parvi::{Annealing, GivenParticles, PaperBody, PaperOptions, Run, ScoreLocation, Silent};
use parvi_targets::{Frame, Target};

/// What the paper's list of inputs has; vectors and matrices row by row in flat arrays.
struct Inputs {
    d: usize,
    h: f64,
    dt: f64,
    steps: usize,
    alpha: f64,
    apic: bool,
    /// Share of FLIP (footnote 2 of Algorithm 1).
    flip: f64,
    at_nodes: bool,
    x: Vec<f64>,
    v: Vec<f64>,
    m: Vec<f64>,
    v0: Vec<f64>,
    /// τ = P Fᵀ from F.
    stress: fn(&[f64], usize) -> Vec<f64>,
}

/// Nodes h k with |k_a| ≤ 5, which no particle leaves.
const REACH: i64 = 5;

/// K and K′ of Eq. 34.
fn kernel(r: f64) -> [f64; 2] {
    match r.abs() {
        s if s < 0.5 => [0.75 - s * s, -2.0 * r],
        s if s < 1.5 => [0.5 * (1.5 - s) * (1.5 - s), (s - 1.5) * r.signum()],
        _ => [0.0, 0.0],
    }
}

/// ∇ log p of log p = −½ |x|² − (Σ x)⁴ / 40.
fn score(x: &[f64]) -> Vec<f64> {
    let sum: f64 = x.iter().sum();
    x.iter().map(|c| -c - 0.1 * sum.powi(3)).collect()
}

/// Steps (1) to (7) of Algorithm 1, or of 2, T times; every particle against every node.
#[rustfmt::skip]
fn oracle(given: &Inputs) -> Vec<f64> {
    let Inputs { d, h, dt, steps, alpha, apic, flip, at_nodes, stress, .. } = *given;
    let (m, v0, side) = (&given.m, &given.v0, 2 * REACH as usize + 1);
    let (count, (mut x, mut v)) = (m.len(), (given.x.clone(), given.v.clone()));
    let (mut b, mut f) = (vec![0.0; count * d * d], vec![0.0; count * d * d]);
    for k in 0..count * d { f[k / d * d * d + k % d * (d + 1)] = 1.0; }
    let node = |i: usize| -> Vec<f64> {
        (0..d).map(|a| h * (i / side.pow(a as u32) % side) as f64 - h * REACH as f64).collect()
    };
    for _ in 0..steps {
        let nodes: Vec<Vec<f64>> = (0..side.pow(d as u32)).map(node).collect();
        let weights = |p: usize, i: usize| -> Option<(f64, Vec<f64>)> { // (1), Eq. 1 and 2
            let k: Vec<[f64; 2]> = (0..d).map(|a| kernel((x[p * d + a] - nodes[i][a]) / h)).collect();
            let w: f64 = k.iter().map(|k| k[0]).product();
            let slope = |a: usize| (0..d).map(|c| if c == a { k[c][1] / h } else { k[c][0] }).product();
            (w != 0.0).then(|| (w, (0..d).map(slope).collect()))
        };
        let (mut mass, mut momentum, mut force) = (vec![0.0; nodes.len()], vec![0.0; nodes.len() * d], vec![0.0; nodes.len() * d]);
        let mut pairs = vec![Vec::new(); count];
        for p in 0..count {
            pairs[p] = (0..nodes.len()).filter_map(|i| weights(p, i).map(|(w, g)| (i, w, g))).collect::<Vec<_>>();
            let offset = |i: usize, a: usize| nodes[i][a] - x[p * d + a];
            let moment: Vec<f64> = (0..d).map(|a| pairs[p].iter().map(|(i, w, _)| w * offset(*i, a).powi(2)).sum()).collect(); // Eq. 28, diagonal
            let (tau, pull) = (stress(&f[p * d * d..(p + 1) * d * d], d), score(&x[p * d..(p + 1) * d]));
            for (i, w, g) in &pairs[p] {
                mass[*i] += w * m[p]; // (2), Eq. 25 or 27
                for a in 0..d {
                    let affine: f64 = (0..d).map(|c| b[(p * d + a) * d + c] / moment[c] * offset(*i, c)).sum();
                    momentum[i * d + a] += w * m[p] * (v[p * d + a] + if apic { affine } else { 0.0 });
                    force[i * d + a] -= v0[p] * (0..d).map(|c| tau[a * d + c] * g[c]).sum::<f64>(); // (4), Eq. 31
                    if !at_nodes { force[i * d + a] += w * alpha * pull[a]; } // Eq. 5
                }
            }
        }
        let mut velocity = vec![0.0; nodes.len() * d];
        for i in (0..nodes.len()).filter(|&i| mass[i] > 0.0) { // (3), (5), Eq. 3, 4 and 6
            let pull = score(&nodes[i]);
            for a in 0..d {
                let outer = if at_nodes { alpha * pull[a] } else { 0.0 };
                velocity[i * d + a] = momentum[i * d + a] / mass[i] + dt * (force[i * d + a] + outer) / mass[i];
            }
        }
        for p in 0..count { // (6), Eq. 26, 29 and 32
            let old: Vec<f64> = x[p * d..(p + 1) * d].to_vec();
            let mut gradient = vec![0.0; d * d];
            for k in 0..d * d {
                b[p * d * d + k] = pairs[p].iter().map(|(i, w, _)| w * velocity[i * d + k / d] * (nodes[*i][k % d] - old[k % d])).sum();
                gradient[k] = pairs[p].iter().map(|(i, _, g)| velocity[i * d + k / d] * g[k % d]).sum();
            }
            let before = f[p * d * d..(p + 1) * d * d].to_vec();
            for k in 0..d * d {
                f[p * d * d + k] += dt * (0..d).map(|c| gradient[k / d * d + c] * before[c * d + k % d]).sum::<f64>();
            }
            for a in 0..d {
                let seen: f64 = pairs[p].iter().map(|(i, w, _)| w * velocity[i * d + a]).sum();
                let before: f64 = pairs[p].iter().map(|(i, w, _)| w * momentum[i * d + a] / mass[*i]).sum();
                v[p * d + a] = (1.0 - flip) * seen + flip * (v[p * d + a] + seen - before);
                x[p * d + a] += dt * seen;
            }
        }
    }
    x
}

/// E = 1.5, ν = 0.2: μ = 0.625 and λ = 0.416̅.
const MU: f64 = 1.5 / (2.0 * 1.2);
const LAMBDA: f64 = 1.5 * 0.2 / (1.2 * 0.6);

/// Σ_c A_ac B_bc, A Bᵀ.
fn times_transpose(a: &[f64], b: &[f64], d: usize) -> Vec<f64> {
    let entry = |k: usize| (0..d).map(|c| a[k / d * d + c] * b[k % d * d + c]).sum();
    (0..d * d).map(entry).collect()
}

fn determinant(f: &[f64], d: usize) -> f64 {
    match d {
        1 => f[0],
        2 => f[0] * f[3] - f[1] * f[2],
        _ => {
            f[0] * (f[4] * f[8] - f[5] * f[7]) - f[1] * (f[3] * f[8] - f[5] * f[6]) + f[2] * (f[3] * f[7] - f[4] * f[6])
        }
    }
}

/// Eq. 24: τ = μ (F Fᵀ − I) + λ ln J I.
fn neo_hookean(f: &[f64], d: usize) -> Vec<f64> {
    let mut tau = times_transpose(f, f, d);
    let pressure = LAMBDA * determinant(f, d).ln();
    for (k, entry) in tau.iter_mut().enumerate() {
        *entry = MU * *entry + if k.is_multiple_of(d + 1) { pressure - MU } else { 0.0 };
    }
    tau
}

/// P = 2μ ε + λ tr ε I with ε = ½ (F + Fᵀ) − I.
fn linear(f: &[f64], d: usize) -> Vec<f64> {
    let strain = |k: usize| 0.5 * (f[k] + f[k % d * d + k / d]) - if k.is_multiple_of(d + 1) { 1.0 } else { 0.0 };
    let trace: f64 = (0..d).map(|a| strain(a * (d + 1))).sum();
    let first = |k: usize| 2.0 * MU * strain(k) + if k.is_multiple_of(d + 1) { LAMBDA * trace } else { 0.0 };
    times_transpose(&(0..d * d).map(first).collect::<Vec<_>>(), f, d)
}

/// Eq. 19 with the Cauchy stress, τ = J σ: σ = 2μ ε + λ tr ε I.
fn linear_cauchy(f: &[f64], d: usize) -> Vec<f64> {
    let strain = |k: usize| 0.5 * (f[k] + f[k % d * d + k / d]) - if k.is_multiple_of(d + 1) { 1.0 } else { 0.0 };
    let trace: f64 = (0..d).map(|a| strain(a * (d + 1))).sum();
    let sigma = |k: usize| 2.0 * MU * strain(k) + if k.is_multiple_of(d + 1) { LAMBDA * trace } else { 0.0 };
    (0..d * d).map(|k| determinant(f, d) * sigma(k)).collect()
}

/// Ψ = −κ ρ₀ ln J, κ ρ₀ = 0.7.
fn gas(_: &[f64], d: usize) -> Vec<f64> {
    (0..d * d)
        .map(|k| if k.is_multiple_of(d + 1) { -0.7 } else { 0.0 })
        .collect()
}

struct Quartic;

impl<const D: usize> Target<D> for Quartic {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        -0.5 * x.iter().map(|c| c * c).sum::<f64>() - x.iter().sum::<f64>().powi(4) / 40.0
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let scores = score(x);
        std::array::from_fn(|a| scores[a])
    }
}

/// Numbers between −1 and 1 without any pattern to speak of.
fn scattered(seed: usize) -> impl FnMut() -> f64 {
    let mut state = 0.37 + seed as f64;
    move || {
        state = (state * 97.0 + 0.618).fract();
        2.0 * state - 1.0
    }
}

/// One of five nodes of spacing h, and up to a fifth of h away from it.
fn near_a_node(which: f64, off: f64, h: f64) -> f64 {
    h * ((2.0 * which).round() + 0.2 * off)
}

fn agrees<const D: usize>() {
    let moduli = ElasticModuli::new(1.5, 0.2).expect("in range");
    let (neo_hookean_law, linear_law) = (NeoHookean::new(moduli), LinearElastic::new(moduli));
    let gas_law = IsothermalGas::new(0.7).expect("positive");
    let gas_law = Numbered(gas_law.with_reference_density(1.0).expect("positive"));
    let (neo_hookean_law, linear_law) = (Numbered(neo_hookean_law), Numbered(linear_law));
    let cauchy_law = Numbered(LinearCauchy::new(moduli));
    type WithStress<'a, const D: usize> = (&'a dyn Law<D, State = Memory>, fn(&[f64], usize) -> Vec<f64>);
    let laws: [WithStress<D>; 4] = [
        (&neo_hookean_law, neo_hookean),
        (&linear_law, linear),
        (&cauchy_law, linear_cauchy),
        (&gas_law, gas),
    ];
    // A frame that would change everything if it were looked at.
    let covariance = Matrix::from_fn(|i, j| if i == j { 3.0 } else { 1.0 });
    let frame = Frame::new([0.4; D], covariance).expect("a covariance");
    for (law, stress) in laws {
        let transfers = [(false, 0.0), (true, 0.0), (false, 0.7), (true, 0.7)];
        for ((apic, flip), at_nodes) in transfers
            .into_iter()
            .flat_map(|transfer| [(transfer, false), (transfer, true)])
        {
            let (count, mut number) = (24, scattered(D));
            let inputs = Inputs {
                d: D,
                h: 0.6,
                dt: 0.05,
                steps: 20,
                alpha: [2e-3, 5e-4, 1e-4][D - 1],
                apic,
                flip,
                at_nodes,
                // Near nodes, where none of the others that a particle touches is very light: there the forces of Eq. 3 are largest.
                x: (0..count * D)
                    .map(|_| {
                        let (which, off) = (number(), number());
                        if at_nodes { near_a_node(which, off, 0.6) } else { which }
                    })
                    .collect(),
                v: (0..count * D)
                    .map(|_| {
                        if at_nodes {
                            0.12 * number()
                        } else {
                            0.5 + 0.3 * number()
                        }
                    })
                    .collect(),
                m: (0..count).map(|_| 0.06 + 0.03 * number()).collect(),
                v0: (0..count).map(|_| 0.04 + 0.02 * number()).collect(),
                stress,
            };
            let options = PaperOptions {
                spacing: Some(inputs.h),
                time_step: Some(inputs.dt),
                steps: Some(inputs.steps),
                annealing: Annealing::Constant { alpha: inputs.alpha },
                score_location: if at_nodes {
                    ScoreLocation::Nodes
                } else {
                    ScoreLocation::Particles
                },
                flip_share: flip,
                ..PaperOptions::as_written(apic)
            };
            let mut run = Run::new(count, 0);
            run.given = GivenParticles {
                positions: Some(inputs.x.clone()),
                velocities: Some(inputs.v.clone()),
                masses: Some(inputs.m.clone()),
                reference_volumes: Some(inputs.v0.clone()),
            };
            let body = PaperBody {
                law: Some(law),
                ..PaperBody::default()
            };
            let samples = options.sample_body(&body, &Quartic, &frame, &run, &mut Silent);
            let samples =
                samples.unwrap_or_else(|error| panic!("D = {D}, APIC {apic}, FLIP {flip}, nodes {at_nodes}: {error}"));
            let expected = oracle(&inputs);
            let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            let pulled = distance(&expected, &oracle(&Inputs { alpha: 0.0, ..inputs }));
            let moved = distance(&expected, &run.given.positions.expect("given"));
            assert!(
                moved > 0.01 && pulled > 1e-4,
                "moved by {moved}, {pulled} of it by the score"
            );
            let off = distance(samples.positions.as_flattened(), &expected);
            assert!(
                off < 1e-12,
                "D = {D}, APIC {apic}, FLIP {flip}, nodes {at_nodes}: off by {off:e}"
            );
        }
    }
}

#[test]
fn the_algorithms_as_written_are_those_of_a_second_program() {
    mpm_tensor::in_dimensions!(agrees(), 1, 2, 3);
}
