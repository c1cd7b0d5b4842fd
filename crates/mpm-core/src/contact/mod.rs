//! Contact by a potential of the distance, solved at the nodes.

mod minimum;
mod nodal;

pub(crate) use nodal::NodalContact;

use crate::Sites;

/// A particle near something rigid.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ContactPoint<const D: usize> {
    /// Its place among the particles, in the present order.
    pub particle: usize,
    /// The area A_p > 0 that it presses with.
    pub area: f64,
    /// Its distance g_p > 0 to the surface.
    pub distance: f64,
    /// The unit normal n_p of the surface, towards the particle: the gradient of the distance.
    pub normal: [f64; D],
}

/// A convex potential b(g) per area that keeps particles off something rigid, without bound towards g = 0. A step takes it implicitly, at the nodes, once all forces have acted: the
/// displacement u_i = Δt v_i of every node is the minimum of
///
/// m_i |u_i − Δt v_i*|² / 2 e^(−γΔt) Δt² + Σ_p w_ip A_p b(g_p + n_p · u_i),
///
/// v_i* the velocity without the contact, γ the rate of [damping](crate::StepControl::friction), which acts on the contact's impulses as on all others: v_i = v_i* + e^(−γΔt) Δt f_i / m_i. As b is convex, Σ_i w_ip b(g_p + n_p · u_i) ≥ b(g_p + n_p · Σ_i w_ip u_i): where weights are not negative, no particle comes to a plane surface, and
/// kinetic energy and potential together never grow, however long the step. What a step dissipates is at least Σ m_i |v_i − v_i*|² / 2, as by backward Euler; it is small where Δt is
/// small beside the time of the contact's spring. Bodies that rest are pressed on by A_p p(g_p), whatever the step.
/// The price of nodes that are solved alone: where they would move against each other and no particle with them, each is held by itself, so that a layer of a cell along the surface is stiffer than it
/// should be until Δt is small beside the spring's time. The distance to curved surfaces is linear in a step, and a term with
/// a negative weight is linear in u_i.
///
/// Source: Li et al., *Incremental potential contact*, ACM Trans. Graph. 39 (2020); at the nodes Li, Fang, Li & Jiang, *BFEMP*, Comput. Methods Appl. Mech. Engrg. 390 (2022)
/// 114350; the bound that makes it a problem of every node alone is ours.
pub trait ContactPotential<const D: usize>: Sync {
    /// Adds all particles to `points` that are nearer to a surface than where b begins and `reach`, in their order. Where distances are 0 or less, or not a number, the step ends with
    /// [`MpmError::Penetration`](crate::MpmError::Penetration).
    fn points(&self, sites: &Sites<D>, reach: f64, points: &mut Vec<ContactPoint<D>>);

    /// p = −b'(g) ≥ 0 and b''(g) ≥ 0 at a distance g > 0.
    fn pressure_and_stiffness(&self, distance: f64) -> (f64, f64);
}
