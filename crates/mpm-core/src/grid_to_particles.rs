//! Grid → particles: particles move and deform with the nodes around them.

use mpm_kernels::{Interpolated, Wanted};
use mpm_tensor::Matrix;
use mpm_tensor::vector::multiply_add;

use crate::transfer::{CellField, Changes, Moving, Numbered, Transfer, Velocities, gather_cells};
use crate::{Basis, BodyForce, Boundary, Medium, Mpm};

impl<const D: usize, B, T, M, F, C> Mpm<D, B, T, M, F, C>
where
    B: Basis<D>,
    T: Transfer<D>,
    M: Medium<D>,
    F: BodyForce<D>,
    C: Boundary<D>,
{
    /// v_p = Σ_i w_ip v_i, B_p = Σ_i w_ip v_i (x_i − x_p)ᵀ, x_p ← x_p + Δt Σ_i w_ip v_i.
    pub(crate) fn move_particles(&mut self, dt: f64, damping: f64) {
        self.grid_to_particles::<true, false>(dt, damping);
    }

    /// F_p ← (I + Δt Σ_i v_i ∇w_ipᵀ) F_p, then whatever the medium admits of it.
    pub(crate) fn deform_particles(&mut self, dt: f64) {
        if M::DEFORMS {
            self.grid_to_particles::<false, true>(dt, 1.0);
            if self.volume_averaging {
                self.average_volume_ratios();
            }
        }
    }

    /// [`move_particles`](Self::move_particles) and [`deform_particles`](Self::deform_particles) in one pass.
    pub(crate) fn move_and_deform_particles(&mut self, dt: f64, damping: f64) {
        self.grid_to_particles::<true, true>(dt, damping);
    }

    /// G2P. With volume averaging the trial deformation gradient is left for [`average_volume_ratios`](Self::average_volume_ratios).
    fn grid_to_particles<const MOVE: bool, const DEFORM: bool>(&mut self, dt: f64, damping: f64) {
        let (basis, nodes, transfer) = (&self.basis, self.nodes.as_slice(), self.transfer);
        let (medium, admit) = (&self.medium, !self.volume_averaging);
        let rate_dependent = medium.rate_dependent();
        let velocity = Velocities::<_, D>(nodes);
        let change = Changes::<_, D> { nodes, damping };
        let update = move |data: &mut Moving<D, M::State>, k: usize, seen: &Interpolated<D>, change: &[f64; D]| {
            if MOVE {
                data.velocities[k] = transfer.particle_velocity(&seen.value, change, &data.velocities[k], damping);
                for a in 0..D {
                    data.positions[k][a] = multiply_add(dt, seen.value[a], data.positions[k][a]);
                }
                if T::AFFINE {
                    data.affine[k] = seen.moment;
                }
            }
            if DEFORM && M::DEFORMS {
                #[allow(non_snake_case)]
                let F = &mut data.deformation_gradients[k];
                let trial = (Matrix::IDENTITY + seen.gradient * dt) * *F;
                *F = if admit {
                    medium.advance(&trial, &mut data.states[k])
                } else {
                    trial
                };
                if rate_dependent {
                    data.velocity_gradients[k] = seen.gradient;
                }
            }
        };
        gather_cells(
            basis,
            Moving::of(&mut self.particles),
            move |data: &mut Moving<D, M::State>, particles, numbers, first, fields: &mut [CellField; 2]| {
                // In here and not captured, so that they are known when this is compiled.
                let incremental = MOVE && T::INCREMENTAL;
                let wanted = Wanted {
                    gradient: DEFORM && M::DEFORMS,
                    least_squares: T::MOVING_LEAST_SQUARES,
                    moment: MOVE && T::AFFINE,
                };
                let size = numbers.len();
                let [velocities, changes] = fields;
                if !B::LONE_PARTICLES {
                    velocities.collect(numbers, velocity);
                    if incremental {
                        changes.collect(numbers, change);
                    }
                }
                for p in particles {
                    let (k, value) = (p - first, Wanted::default());
                    let x = data.positions[k];
                    let mut changed = [0.0; D];
                    let seen = if B::LONE_PARTICLES {
                        if incremental {
                            let changes = Numbered { field: change, numbers };
                            changed = basis.interpolate(p, &x, value, &changes).value;
                        }
                        basis.interpolate(
                            p,
                            &x,
                            wanted,
                            &Numbered {
                                field: velocity,
                                numbers,
                            },
                        )
                    } else {
                        if incremental {
                            changed = basis.interpolate(p, &x, value, &changes.nodes(size)).value;
                        }
                        basis.interpolate(p, &x, wanted, &velocities.nodes(size))
                    };
                    update(data, k, &seen, &changed);
                }
            },
        );
    }
}
