//! The step as a textbook writes it: maps of nodes, F for every law, D_p summed up, weights from the kernels' formulas.

use std::collections::BTreeMap;

use mpm_tensor::Matrix;

/// A kernel in r = |x|/h: N(r), N′(r), support radius.
#[derive(Clone, Copy)]
pub enum Kernel {
    Linear,
    Quadratic,
    Cubic,
}

impl Kernel {
    fn radius(self) -> f64 {
        match self {
            Self::Linear => 1.0,
            Self::Quadratic => 1.5,
            Self::Cubic => 2.0,
        }
    }

    fn value(self, r: f64) -> f64 {
        let r = r.abs();
        match self {
            _ if r >= self.radius() => 0.0,
            Self::Linear => 1.0 - r,
            Self::Quadratic if r < 0.5 => 0.75 - r * r,
            Self::Quadratic => 0.5 * (1.5 - r).powi(2),
            Self::Cubic if r < 1.0 => 0.5 * r.powi(3) - r * r + 2.0 / 3.0,
            Self::Cubic => (2.0 - r).powi(3) / 6.0,
        }
    }

    fn slope(self, r: f64) -> f64 {
        let s = r.abs();
        let outward = match self {
            _ if s >= self.radius() => 0.0,
            Self::Linear => -1.0,
            Self::Quadratic if s < 0.5 => -2.0 * s,
            Self::Quadratic => s - 1.5,
            Self::Cubic if s < 1.0 => 1.5 * s * s - 2.0 * s,
            Self::Cubic => -0.5 * (2.0 - s).powi(2),
        };
        if r < 0.0 { -outward } else { outward }
    }
}

#[derive(Clone, Copy, Debug)]
pub enum Law {
    /// P = κρ.
    Gas { kappa: f64 },
    /// P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ.
    NeoHookean { lambda: f64, mu: f64 },
    /// P = 2μ ε + λ tr ε I.
    LinearElastic { lambda: f64, mu: f64 },
}

#[derive(Clone, Copy, Debug)]
pub enum Velocity {
    Pic,
    Apic,
    Flip(f64),
    AffineFlip(f64),
}

/// A body force of position.
#[derive(Clone, Copy, Debug)]
pub enum Force<const D: usize> {
    None,
    /// Per unit mass.
    Particles(fn(&[f64; D]) -> [f64; D]),
    /// Of position and nodal mass.
    Nodes(fn(&[f64; D], f64) -> [f64; D]),
}

#[derive(Clone, Debug)]
pub struct NaiveParticle<const D: usize> {
    pub x: [f64; D],
    pub v: [f64; D],
    pub mass: f64,
    pub volume: f64,
    pub affine: Matrix<D>,
    pub deformation: Matrix<D>,
}

#[derive(Clone, Copy)]
pub struct NaiveGrid<const D: usize> {
    pub kernel: Kernel,
    pub origin: [f64; D],
    pub h: f64,
}

impl<const D: usize> NaiveGrid<D> {
    fn node_position(&self, node: &[i64; D]) -> [f64; D] {
        std::array::from_fn(|a| self.origin[a] + self.h * node[a] as f64)
    }

    /// (node, w, ∇w) for all nodes in reach of x.
    fn stencil(&self, x: &[f64; D]) -> Vec<([i64; D], f64, [f64; D])> {
        let u: [f64; D] = std::array::from_fn(|a| (x[a] - self.origin[a]) / self.h);
        let mut nodes: Vec<[i64; D]> = vec![[0; D]];
        for a in 0..D {
            let (low, high) = (
                (u[a] - self.kernel.radius()).ceil() as i64,
                (u[a] + self.kernel.radius()).floor() as i64,
            );
            nodes = nodes
                .into_iter()
                .flat_map(|node| {
                    (low..=high).map(move |i| {
                        let mut node = node;
                        node[a] = i;
                        node
                    })
                })
                .collect();
        }
        let entry = |node: [i64; D]| {
            let r: [f64; D] = std::array::from_fn(|a| u[a] - node[a] as f64);
            let value = |a: usize| self.kernel.value(r[a]);
            let weight = (0..D).map(value).product();
            let gradient = std::array::from_fn(|a| {
                let others: f64 = (0..D).filter(|&b| b != a).map(value).product();
                self.kernel.slope(r[a]) / self.h * others
            });
            (node, weight, gradient)
        };
        nodes.into_iter().map(entry).collect()
    }
}

#[derive(Clone, Copy, Default)]
struct Sums<const D: usize>(f64, Vector<D>, Vector<D>);

#[derive(Clone, Copy)]
struct Vector<const D: usize>([f64; D]);

impl<const D: usize> Default for Vector<D> {
    fn default() -> Self {
        Self([0.0; D])
    }
}

/// τ = P Fᵀ.
#[allow(non_snake_case)]
fn kirchhoff_stress<const D: usize>(law: Law, particle: &NaiveParticle<D>) -> Matrix<D> {
    let F = particle.deformation;
    let J = F.determinant();
    let first_piola = match law {
        Law::Gas { kappa } => {
            let density = particle.mass / (particle.volume * J);
            return Matrix::IDENTITY * (-kappa * density * J);
        }
        Law::NeoHookean { lambda, mu } => {
            let inverse_transpose = F.inverse().unwrap().transpose();
            (F - inverse_transpose) * mu + inverse_transpose * (lambda * J.ln())
        }
        Law::LinearElastic { lambda, mu } => {
            let strain = (F + F.transpose()) * 0.5 - Matrix::IDENTITY;
            strain * (2.0 * mu) + Matrix::IDENTITY * (lambda * strain.trace())
        }
    };
    first_piola * F.transpose()
}

/// One step; friction and the limit of a displacement (times h) as in `StepControl`.
pub fn naive_step<const D: usize>(
    particles: &mut [NaiveParticle<D>],
    grid: &NaiveGrid<D>,
    law: Law,
    velocity: Velocity,
    force: Force<D>,
    (dt, friction, displacement): (f64, f64, f64),
) {
    let mut sums: BTreeMap<[i64; D], Sums<D>> = BTreeMap::new();
    for p in particles.iter() {
        let stencil = grid.stencil(&p.x);
        let offset = |node: &[i64; D]| -> [f64; D] {
            let position = grid.node_position(node);
            std::array::from_fn(|a| position[a] - p.x[a])
        };
        let mut second_moment = Matrix::<D>::ZERO;
        for (node, w, _) in &stencil {
            second_moment += Matrix::outer(&offset(node), &offset(node)) * *w;
        }
        let stress = kirchhoff_stress(law, p);
        for (node, w, gradient) in &stencil {
            let affine = match (velocity, grid.kernel) {
                (Velocity::Apic | Velocity::AffineFlip(_), Kernel::Linear) => p.affine.apply(gradient),
                (Velocity::Apic | Velocity::AffineFlip(_), _) => {
                    let direction = second_moment.inverse().unwrap().apply(&offset(node));
                    p.affine.apply(&direction).map(|c| w * c)
                }
                _ => [0.0; D],
            };
            let internal = stress.apply(gradient);
            let external = match force {
                Force::Particles(g) => g(&p.x),
                _ => [0.0; D],
            };
            let node = sums.entry(*node).or_default();
            node.0 += w * p.mass;
            for a in 0..D {
                node.1.0[a] += p.mass * (w * p.v[a] + affine[a]);
                node.2.0[a] += w * p.mass * external[a] - p.volume * internal[a];
            }
        }
    }

    let damping = (-friction * dt).exp();
    let mut old = BTreeMap::new();
    let mut new = BTreeMap::new();
    for (node, Sums(mass, momentum, mut impulse)) in sums {
        if let Force::Nodes(f) = force {
            let external = f(&grid.node_position(&node), mass);
            for a in 0..D {
                impulse.0[a] += external[a];
            }
        }
        let (mut v_old, mut v_new) = ([0.0; D], [0.0; D]);
        if mass > 0.0 {
            for a in 0..D {
                v_old[a] = momentum.0[a] / mass;
                v_new[a] = damping * (v_old[a] + dt * impulse.0[a] / mass);
            }
            let length = v_new.iter().map(|c| c * c).sum::<f64>().sqrt();
            let limit = displacement * grid.h / dt;
            if length > limit {
                v_new = v_new.map(|c| c * limit / length);
            }
        }
        old.insert(node, v_old);
        new.insert(node, v_new);
    }

    for p in particles.iter_mut() {
        let (mut interpolated, mut change) = ([0.0; D], [0.0; D]);
        let (mut affine, mut velocity_gradient) = (Matrix::<D>::ZERO, Matrix::<D>::ZERO);
        for (node, w, gradient) in grid.stencil(&p.x) {
            let (v_old, v_new) = (old[&node], new[&node]);
            let position = grid.node_position(&node);
            let offset = std::array::from_fn(|a| position[a] - p.x[a]);
            for a in 0..D {
                interpolated[a] += w * v_new[a];
                change[a] += w * (v_new[a] - damping * v_old[a]);
            }
            affine += Matrix::outer(&v_new, &offset) * w;
            velocity_gradient += Matrix::outer(&v_new, &gradient);
        }
        for a in 0..D {
            p.x[a] += dt * interpolated[a];
            p.v[a] = match velocity {
                Velocity::Flip(share) | Velocity::AffineFlip(share) => {
                    (1.0 - share) * interpolated[a] + share * (damping * p.v[a] + change[a])
                }
                _ => interpolated[a],
            };
        }
        p.affine = affine;
        p.deformation = (Matrix::IDENTITY + velocity_gradient * dt) * p.deformation;
    }
}
