use super::{Filling, MOST_POINTS, counts, place};
use crate::SceneFault;
use crate::shape::{Bounds, Shape};

/// One particle in the middle of each part of a lattice of parts with sides `steps`, with a corner at `origin`, wherever the middle is inside the
/// shape (d < 0); V⁰ = Π steps. `room` bounds a shape that is infinite; `body` is whose particles they are.
///
/// With the grid's origin and steps of h / n every cell of the grid that lies inside the shape gets nᴰ particles.
///
/// # Errors
/// [`SceneFault::TooManyPoints`] for a step too short to be counted.
pub fn regular<const D: usize>(
    body: &str,
    shape: &dyn Shape<D>,
    origin: &[f64; D],
    steps: &[f64; D],
    room: &Bounds<D>,
) -> Result<Filling<D>, SceneFault> {
    let bounds = shape.bounds().finite_within(room);
    let first: [f64; D] = std::array::from_fn(|a| ((bounds.lower[a] - origin[a]) / steps[a]).floor());
    let sides: [f64; D] = std::array::from_fn(|a| bounds.upper[a] - origin[a] - first[a] * steps[a]);
    let counts = counts(body, &sides, steps, MOST_POINTS)?;
    let middle = |number: u64| -> [f64; D] {
        let place = place(&counts, number);
        std::array::from_fn(|a| origin[a] + (first[a] + place[a] as f64 + 0.5) * steps[a])
    };
    let all = (0..counts.iter().product()).map(middle);
    let inside = all.filter(|x| shape.distance(x) < 0.0).collect();
    Ok(Filling::of_equal(inside, steps.iter().product()))
}
