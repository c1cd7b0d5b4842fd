//! A cylinder that bends and twists by formula: snapshots whose F and v are exact.

use mpm_rom::snapshots::{Body, Frame, Run, Snapshots};
use mpm_tensor::Matrix;

const RADIUS: f64 = 0.01;
const LENGTH: f64 = 0.04;
const INTERVAL: f64 = 1.0 / 144.0;
const FREQUENCY: f64 = 20.0;

/// X ↦ bend(twist(X)): a turn by τ x about the axis x, then the axis laid on a circle of curvature κ; returns position and gradient.
fn deform(x: [f64; 3], curvature: f64, twist: f64) -> ([f64; 3], Matrix<3>) {
    let along = x[0] + 0.5 * LENGTH;
    let (sin, cos) = (twist * along).sin_cos();
    let turned = [x[0], cos * x[1] - sin * x[2], sin * x[1] + cos * x[2]];
    let turning = Matrix([
        [1.0, 0.0, 0.0],
        [-twist * turned[2], cos, -sin],
        [twist * turned[1], sin, cos],
    ]);
    let (sin, cos) = (curvature * along).sin_cos();
    let stretch = 1.0 - curvature * turned[1];
    // sin(κs)/κ and (1 − cos(κs))/κ, also for κ = 0.
    let half = 0.5 * curvature * along;
    let sinc = if half == 0.0 { 1.0 } else { half.sin() / half };
    let axis = [along * sinc * half.cos(), along * sinc * half.sin()];
    let position = [
        axis[0] - turned[1] * sin - 0.5 * LENGTH,
        axis[1] + turned[1] * cos,
        turned[2],
    ];
    let bending = Matrix([[stretch * cos, -sin, 0.0], [stretch * sin, cos, 0.0], [0.0, 0.0, 1.0]]);
    (position, bending * turning)
}

/// κ(t) and τ(t) of a run: a swing that begins at rest, and a turn that begins with a velocity.
fn amplitudes(t: f64, parameters: [f64; 2]) -> (f64, f64) {
    let swing = 0.5 * (1.0 - (FREQUENCY * t).cos()) * (-2.0 * t).exp();
    let turn = (0.7 * FREQUENCY * t).sin();
    (20.0 * parameters[0] * swing, 25.0 * parameters[1] * turn)
}

/// `count` points in the cylinder: a Kronecker sequence, those outside left out.
fn points(count: usize) -> Vec<[f64; 3]> {
    let ratio = 1.220_744_084_605_759_5_f64;
    let at = |n: usize, power: i32| (0.5 + n as f64 / ratio.powi(power)).fract();
    let all = (1..).map(|n| {
        let (y, z) = (2.0 * at(n, 2) - 1.0, 2.0 * at(n, 3) - 1.0);
        [(at(n, 1) - 0.5) * LENGTH, y * RADIUS, z * RADIUS]
    });
    all.filter(|p| p[1].hypot(p[2]) < RADIUS).take(count).collect()
}

/// `runs` runs of `frames` frames whose two parameters fill [0, 1]² evenly.
pub fn bending_cylinder(count: usize, runs: usize, frames: usize) -> Snapshots<3> {
    let reference = points(count);
    let frame = |number: usize, parameters: [f64; 2]| {
        let t = number as f64 * INTERVAL;
        let at = |t: f64| {
            let (curvature, twist) = amplitudes(t, parameters);
            reference.iter().map(move |x| deform(*x, curvature, twist))
        };
        let step = 1e-5;
        let (positions, deformation_gradients) = at(t).unzip();
        let velocity = |((plus, _), (minus, _)): (([f64; 3], Matrix<3>), ([f64; 3], Matrix<3>))| {
            std::array::from_fn(|c| (plus[c] - minus[c]) / (2.0 * step))
        };
        Frame {
            time: t,
            positions,
            deformation_gradients,
            velocities: at(t + step).zip(at(t - step)).map(velocity).collect(),
        }
    };
    let ratio = 1.324_717_957_244_746_f64;
    let run = |number: usize| {
        let part = |power: i32| (0.5 + (number + 1) as f64 / ratio.powi(power)).fract();
        let parameters = [part(1), part(2)];
        Run {
            parameters: parameters.to_vec(),
            frames: (0..frames).map(|n| frame(n, parameters)).collect(),
        }
    };
    let runs = (0..runs).map(run).collect();
    let body = Body {
        scene: "bending cylinder".to_owned(),
        reference: reference.clone(),
        centroid: [0.0; 3],
        interval: INTERVAL,
        density: 1000.0,
        parameters: vec!["swing".to_owned(), "turn".to_owned()],
    };
    Snapshots::new(body, runs).unwrap()
}
