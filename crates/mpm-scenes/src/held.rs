//! Nodes whose motion is prescribed.

use std::sync::Arc;

use mpm_core::PrescribedVelocity;
use mpm_tensor::vector;

use crate::SceneFault;
use crate::kinematics::{self, RigidMotion};
use crate::scene::Scene;
use crate::shape::{self, Bounds, Shape};

/// A region that moves as a rigid body; nodes in it have its velocity, [`RigidMotion::mean_velocity`] of the step.
#[derive(Clone, Debug)]
pub struct HeldRegion<const D: usize> {
    /// The region at t = 0.
    pub shape: Arc<dyn Shape<D>>,
    /// How it moves.
    pub motion: RigidMotion<D>,
    /// Until when; infinite: to the end.
    pub until: f64,
}

impl<const D: usize> HeldRegion<D> {
    /// The held regions of a scene, in its order.
    ///
    /// # Errors
    /// [`SceneFault::Value`] for tables that [`Scene::read`] refuses.
    pub fn of(scene: &Scene) -> Result<Vec<Self>, SceneFault> {
        let region = |(index, table): (usize, &crate::scene::HeldTable)| {
            let field = |key: &str| format!("held[{index}].{key}");
            Ok(Self {
                shape: Arc::from(shape::build::<D>(&field("shape"), &table.shape)?),
                motion: kinematics::motion(&field, table.velocity.as_ref(), table.rotation.as_ref())?,
                until: table.until.unwrap_or(f64::INFINITY),
            })
        };
        scene.held.iter().enumerate().map(region).collect()
    }

    /// A bound of its speed: that of the fastest corner of the box around it, and of its turn none where the box is infinite.
    pub(crate) fn largest_speed(&self) -> f64 {
        let (Bounds { lower, upper }, motion) = (self.shape.bounds(), &self.motion);
        let corner = |k: usize| std::array::from_fn(|a| if k >> a & 1 == 0 { lower[a] } else { upper[a] });
        let turning = |k| vector::norm(&motion.spin.apply(&vector::subtract(&corner(k), &motion.centre)));
        let finite = (0..1 << D).map(turning).filter(|speed| speed.is_finite());
        vector::norm(&motion.velocity) + finite.fold(0.0, f64::max)
    }
}

impl<const D: usize> PrescribedVelocity<D> for HeldRegion<D> {
    /// None outside and farther than `close`, and none in a step that ends after `until`: kinematic particles are free at its end, too.
    fn velocity(&self, x: &[f64; D], close: f64, time: f64, time_step: f64) -> Option<[f64; D]> {
        let inside = kinematics::prescribes(self.until, time + time_step)
            && self.shape.distance(&self.motion.reference(x, time)) <= close;
        inside.then(|| self.motion.mean_velocity(x, time, time_step))
    }
}
