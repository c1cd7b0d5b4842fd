use super::{Filling, counts, place};
use crate::SceneFault;
use crate::shape::{Bounds, Shape};

/// One particle in the middle of each part of a lattice of parts of width `step`, with a corner at `origin`, wherever the middle is inside the
/// shape (d < 0); V⁰ = stepᴰ. `room` bounds a shape that is infinite.
///
/// With the grid's origin and step = h / n every cell of the grid that lies inside the shape gets nᴰ particles.
///
/// # Errors
/// [`SceneFault::Value`] for a step too short to be counted.
pub fn regular<const D: usize>(
    shape: &dyn Shape<D>,
    origin: &[f64; D],
    step: f64,
    room: &Bounds<D>,
) -> Result<Filling<D>, SceneFault> {
    let bounds = shape.bounds().finite_within(room);
    let first: [f64; D] = std::array::from_fn(|a| ((bounds.lower[a] - origin[a]) / step).floor());
    let sides: [f64; D] = std::array::from_fn(|a| bounds.upper[a] - origin[a] - first[a] * step);
    let counts = counts(&sides, step)?;
    let middle = |number: u64| -> [f64; D] {
        let place = place(&counts, number);
        std::array::from_fn(|a| origin[a] + (first[a] + place[a] as f64 + 0.5) * step)
    };
    let all = (0..counts.iter().product()).map(middle);
    let inside = all.filter(|x| shape.distance(x) < 0.0).collect();
    Ok(Filling::of_equal(inside, step.powi(D as i32)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Ball, Cuboid, HalfSpace};

    #[test]
    fn whole_cells_get_all_their_particles() {
        let shape = Cuboid {
            lower: [0.5, -0.25],
            upper: [1.5, 0.5],
        };
        let filling = regular(&shape, &[0.0, 0.0], 0.125, &Bounds::EVERYWHERE).expect("few points");
        assert_eq!(filling.positions.len(), 8 * 6);
        assert_eq!(filling.positions[0], [0.5625, -0.1875]);
        assert_eq!(filling.positions[47], [1.4375, 0.4375]);
        assert_eq!(filling.volume(), 0.75);
    }

    #[test]
    fn the_volume_of_a_ball_is_met_as_finely_as_the_lattice() {
        let shape = Ball {
            centre: [0.1, 0.2, 0.3],
            radius: 0.5,
        };
        let filling = regular(&shape, &[0.0; 3], 0.025, &Bounds::EVERYWHERE).expect("few points");
        let volume = filling.volume();
        assert!((volume / shape.volume().expect("known") - 1.0).abs() < 0.01, "{volume}");
    }

    #[test]
    fn an_infinite_shape_is_cut_by_the_room() {
        let room = Bounds {
            lower: [0.0, 0.0],
            upper: [1.0, 1.0],
        };
        let shape = HalfSpace {
            point: [0.0, 0.5],
            normal: [0.0, 1.0],
        };
        let filling = regular(&shape, &[0.0, 0.0], 0.25, &room).expect("few points");
        assert_eq!(filling.positions.len(), 8);
        assert!(regular(&shape, &[0.0, 0.0], 1e-9, &room).is_err());
    }
}
