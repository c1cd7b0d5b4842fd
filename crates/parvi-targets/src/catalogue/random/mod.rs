//! Random targets: simple laws, invertible maps, and what a seed makes of them.

mod axis_law;
mod bijection;
mod dice;
mod family;
mod law;
mod maps;
mod mixture_law;
mod product_law;
mod push_forward;
mod random_target;
mod recipes;

pub use axis_law::AxisLaw;
pub use bijection::{Bijection, BoxedBijection};
pub use family::RandomFamily;
pub use law::{BoxedLaw, Law};
pub use maps::{Affine, Neck, Profile, Shear, Skew, Twist};
pub use mixture_law::MixtureLaw;
pub use product_law::ProductLaw;
pub use push_forward::PushForward;
pub use random_target::RandomTarget;
