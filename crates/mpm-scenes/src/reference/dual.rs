//! Exact derivatives for the tests: dual numbers a + b ε with ε² = 0, which nest.

#![allow(non_snake_case)]

use std::ops::{Add, Div, Mul, Sub};

use mpm_materials::ElasticModuli;

use crate::ManufacturedSolution;

/// What the formulas of a motion need of a number.
pub(super) trait Number:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn constant(value: f64) -> Self;
    fn sin(self) -> Self;
    fn cos(self) -> Self;
    fn ln(self) -> Self;
    fn sqrt(self) -> Self;
}

impl Number for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn sin(self) -> Self {
        self.sin()
    }
    fn cos(self) -> Self {
        self.cos()
    }
    fn ln(self) -> Self {
        self.ln()
    }
    fn sqrt(self) -> Self {
        self.sqrt()
    }
}

/// a + b ε.
#[derive(Clone, Copy)]
pub(super) struct Dual<N>(pub N, pub N);

impl<N: Number> Add for Dual<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        Self(self.0 + other.0, self.1 + other.1)
    }
}

impl<N: Number> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        Self(self.0 - other.0, self.1 - other.1)
    }
}

impl<N: Number> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        Self(self.0 * other.0, self.1 * other.0 + self.0 * other.1)
    }
}

impl<N: Number> Div for Dual<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let quotient = self.0 / other.0;
        Self(quotient, (self.1 - quotient * other.1) / other.0)
    }
}

impl<N: Number> Number for Dual<N> {
    fn constant(value: f64) -> Self {
        Self(N::constant(value), N::constant(0.0))
    }
    fn sin(self) -> Self {
        Self(self.0.sin(), self.1 * self.0.cos())
    }
    fn cos(self) -> Self {
        Self(self.0.cos(), self.1 * (N::constant(0.0) - self.0.sin()))
    }
    fn ln(self) -> Self {
        Self(self.0.ln(), self.1 / self.0)
    }
    fn sqrt(self) -> Self {
        let root = self.0.sqrt();
        Self(root, self.1 / (root + root))
    }
}

/// A motion (X, Y, t) ↦ x, written for any number.
pub(super) trait Motion {
    fn position<N: Number>(&self, X: [N; 2], t: N) -> [N; 2];
}

/// F(X, t) = ∂x/∂X.
pub(super) fn deformation_gradient<N: Number>(motion: &impl Motion, X: [N; 2], t: N) -> [[N; 2]; 2] {
    let (zero, one) = (N::constant(0.0), N::constant(1.0));
    let along = |a: usize| {
        let seed = |b: usize| if a == b { one } else { zero };
        let x = motion.position([Dual(X[0], seed(0)), Dual(X[1], seed(1))], Dual(t, zero));
        [x[0].1, x[1].1]
    };
    let (first, second) = (along(0), along(1));
    [[first[0], second[0]], [first[1], second[1]]]
}

/// P = μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ.
fn piola<N: Number>(F: [[N; 2]; 2], lambda: f64, mu: f64) -> [[N; 2]; 2] {
    let J = F[0][0] * F[1][1] - F[0][1] * F[1][0];
    let zero = N::constant(0.0);
    let inverse_transpose = [[F[1][1] / J, zero - F[1][0] / J], [zero - F[0][1] / J, F[0][0] / J]];
    let pressure = N::constant(lambda) * J.ln() - N::constant(mu);
    std::array::from_fn(|i| std::array::from_fn(|j| N::constant(mu) * F[i][j] + pressure * inverse_transpose[i][j]))
}

/// Asserts that position, velocity and body force of a solution are those of the motion that it states, at some places and times.
pub(super) fn assert_moves_by_its_force(
    solution: &dyn ManufacturedSolution,
    motion: &impl Motion,
    (moduli, density): (&ElasticModuli, f64),
    places: [([f64; 2], f64); 3],
) {
    let constants = (moduli.first_lame_parameter(), moduli.shear_modulus(), density);
    for (X, t) in places {
        let (velocity, force) = velocity_and_body_force(motion, X, t, constants);
        let close = |found: [f64; 2], expected: [f64; 2], tolerance: f64| {
            let near = (0..2).all(|a| (found[a] - expected[a]).abs() < tolerance);
            assert!(near, "{found:?} for {expected:?} at {X:?}, {t}");
        };
        close(solution.position(&X, t), motion.position(X, t), 1e-14);
        close(solution.velocity(&X, t), velocity, 1e-13);
        close(solution.body_force(&X, t), force, 1e-11);
    }
}

/// (v, b) of a motion at (X, t): v = ∂x/∂t and b = ∂²x/∂t² − Div P / ρ₀.
fn velocity_and_body_force(
    motion: &impl Motion,
    X: [f64; 2],
    t: f64,
    (lambda, mu, density): (f64, f64, f64),
) -> ([f64; 2], [f64; 2]) {
    let still = |value: f64| Dual(Dual(value, 0.0), Dual(0.0, 0.0));
    let x = motion.position(X.map(still), Dual(Dual(t, 1.0), Dual(1.0, 0.0)));
    let stress = |a: usize| {
        let seed = |b: usize| if a == b { 1.0 } else { 0.0 };
        let at = [Dual(X[0], seed(0)), Dual(X[1], seed(1))];
        piola(deformation_gradient(motion, at, Dual(t, 0.0)), lambda, mu)
    };
    let (first, second) = (stress(0), stress(1));
    let velocity = x.map(|c| c.0.1);
    let force = std::array::from_fn(|i| x[i].1.1 - (first[i][0].1 + second[i][1].1) / density);
    (velocity, force)
}
