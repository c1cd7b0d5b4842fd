//! What several families are made with.

use mpm_tensor::Matrix;

use crate::catalogue::random::dice::Dice;
use crate::{
    Affine, AxisLaw, BoxedBijection, BoxedLaw, Law, ProductLaw, Profile, PushForward, Shear, StudentT, TargetError,
};

/// The product of one law for every axis.
pub fn on_axes<const D: usize>(mut law: impl FnMut(usize) -> AxisLaw) -> Result<BoxedLaw<D>, TargetError> {
    let lines = (0..D).map(|axis| Box::new(law(axis)) as BoxedLaw<1>).collect();
    Ok(Box::new(ProductLaw::<D>::new(Vec::new(), lines)?))
}

/// A uniform law with edges of a twentieth to a third of its half width.
pub fn soft_uniform(dice: &mut Dice) -> Result<AxisLaw, TargetError> {
    AxisLaw::soft_uniform(dice.scale(0.05, 0.3))
}

/// A product of normal, Laplace or uniform laws, or a multivariate t of 3 to 8 degrees of freedom.
pub fn simple<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    match dice.whole(0, 5) {
        0 => on_axes(|_| AxisLaw::Laplace),
        1 => {
            let uniform = soft_uniform(dice)?;
            on_axes(|_| uniform)
        }
        2 => Ok(Box::new(StudentT::<D>::new(dice.scale(3.0, 8.0))?)),
        _ => on_axes(|_| AxisLaw::Normal),
    }
}

/// A law that may be stretched along the first axis: normal across it, normal or flat along it.
pub fn line<const D: usize>(dice: &mut Dice) -> Result<BoxedLaw<D>, TargetError> {
    let along = if dice.chance(0.5) {
        AxisLaw::Normal
    } else {
        soft_uniform(dice)?
    };
    on_axes(|axis| if axis == 0 { along } else { AxisLaw::Normal })
}

/// Scales: the first axis `along`, the others drawn from a range.
pub fn long_first<const D: usize>(
    dice: &mut Dice,
    along: f64,
    [thin, thick]: [f64; 2],
) -> Result<BoxedBijection<D>, TargetError> {
    let scales = std::array::from_fn(|axis| if axis == 0 { along } else { dice.scale(thin, thick) });
    Ok(Box::new(Affine::<D>::scales([0.0; D], scales)?))
}

/// A wave of some periods along a piece of length ±2.
pub fn wave<const D: usize>(dice: &mut Dice, source: usize, moved: usize) -> Result<BoxedBijection<D>, TargetError> {
    let profile = Profile::Wave {
        amplitude: dice.signed(0.3, 1.0),
        frequency: dice.scale(0.7, 2.5),
        phase: dice.between(0.0, std::f64::consts::TAU),
    };
    Ok(Box::new(Shear::new::<D>(source, moved, profile)?))
}

/// A bend that is a parabola within ±3.
pub fn bend<const D: usize>(source: usize, moved: usize, curvature: f64) -> Result<BoxedBijection<D>, TargetError> {
    let profile = Profile::Bend { curvature, knee: 3.0 };
    Ok(Box::new(Shear::new::<D>(source, moved, profile)?))
}

/// x = c + Q diag(s) y for a random orthogonal Q and scales within a factor `spread` of `scale`.
pub fn placed<const D: usize>(
    law: BoxedLaw<D>,
    dice: &mut Dice,
    centre: [f64; D],
    scale: f64,
    spread: f64,
) -> Result<BoxedLaw<D>, TargetError> {
    let scales: [f64; D] = std::array::from_fn(|_| scale * dice.scale(1.0 / spread, spread));
    let matrix = dice.orthogonal::<D>() * Matrix::diagonal(&scales);
    Ok(pushed(law, vec![Box::new(Affine::new(centre, matrix)?)]))
}

/// A law after maps.
pub fn pushed<const D: usize>(base: BoxedLaw<D>, maps: Vec<BoxedBijection<D>>) -> BoxedLaw<D> {
    boxed(PushForward::new(base, maps))
}

/// A law in a box.
pub fn boxed<const D: usize>(law: impl Law<D> + 'static) -> BoxedLaw<D> {
    Box::new(law)
}
