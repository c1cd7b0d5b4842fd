use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::{Filling, MOST_POINTS, counts, place};
use crate::SceneFault;
use crate::shape::{Bounds, Shape};

/// Candidates around a point before it is given up (Bridson's k).
const CANDIDATES: u32 = 30;

/// Points in the box around a shape, at most, at the density of the filling: each takes some thirty candidates.
const MOST_DISKS: f64 = 1e7;

/// Random points in the shape, no two closer than r = (θ_D stepᴰ)^{1/D} and with no room for another one that 30 candidates around
/// every point would have found; their volumes are equal and sum to the shape's.
///
/// θ_D is the number of points per rᴰ at which random placing ends (the jamming of random sequential addition: coverages 0.7476, 0.5470 and
/// 0.3841 for D = 1, 2, 3), so that the density is close to one point per stepᴰ. Points are spread from one to the next; after that every free place of the
/// background grid is tried once, so that separate parts of a shape are filled too.
///
/// Where the shape's volume is not known in closed form, it is counted on a lattice of a quarter of the step.
///
/// Source: Bridson, *Fast Poisson disk sampling in arbitrary dimensions*, SIGGRAPH sketches 2007; Torquato, Uche & Stillinger, Phys. Rev. E 74,
/// 061308 (2006), Table I.
///
/// # Errors
/// [`SceneFault::TooManyPoints`] for a step too short to be counted.
pub fn poisson_disk<const D: usize>(
    body: &str,
    shape: &dyn Shape<D>,
    step: f64,
    room: &Bounds<D>,
    seed: u64,
) -> Result<Filling<D>, SceneFault> {
    let bounds = shape.bounds().finite_within(room);
    let radius = step * points_per_radius::<D>().powf(1.0 / D as f64);
    counts(body, &bounds.sides(), &[step; D], MOST_DISKS)?;
    let mut disks = Disks::new(body, bounds, radius)?;
    let mut generator = ChaCha8Rng::seed_from_u64(seed);
    for cell in 0..disks.cells.len() {
        let start = disks.point_in(cell, &mut generator);
        if shape.distance(&start) < 0.0 && bounds.contains(&start) && disks.add(start) {
            disks.spread(shape, &bounds, &mut generator);
        }
    }
    let volume = volume_within(body, shape, &bounds, 0.25 * step)?;
    let each = volume / disks.points.len().max(1) as f64;
    Ok(Filling::of_equal(disks.points, each))
}

/// θ_D: coverage times 2ᴰ over the volume of the unit ball.
fn points_per_radius<const D: usize>() -> f64 {
    use std::f64::consts::PI;
    match D {
        1 => 0.7476,
        2 => 0.5470 * 4.0 / PI,
        _ => 0.3841 * 6.0 / PI,
    }
}

/// Volume of the part of a shape that is within its bounds cut by the room; by the middles of a lattice that lie in it, where it is not known in
/// closed form.
pub(super) fn volume_within<const D: usize>(
    body: &str,
    shape: &dyn Shape<D>,
    bounds: &Bounds<D>,
    step: f64,
) -> Result<f64, SceneFault> {
    match shape.volume() {
        Some(volume) if shape.bounds() == *bounds => Ok(volume),
        _ => Ok(super::regular(body, shape, &bounds.lower, &[step; D], bounds)?.volume()),
    }
}

/// Points on a background grid of cells so small that each has one at most.
struct Disks<const D: usize> {
    origin: [f64; D],
    radius: f64,
    counts: [u64; D],
    /// Number of the point in a cell, counted from 1; 0 for none.
    cells: Vec<u32>,
    points: Vec<[f64; D]>,
    /// Points around which there may be room.
    active: Vec<u32>,
}

impl<const D: usize> Disks<D> {
    fn new(body: &str, bounds: Bounds<D>, radius: f64) -> Result<Self, SceneFault> {
        let width = radius / (D as f64).sqrt();
        let counts = counts(body, &bounds.sides(), &[width; D], MOST_POINTS)?;
        Ok(Self {
            origin: bounds.lower,
            radius,
            counts,
            cells: vec![0; counts.iter().product::<u64>() as usize],
            points: Vec::new(),
            active: Vec::new(),
        })
    }

    fn width(&self) -> f64 {
        self.radius / (D as f64).sqrt()
    }

    /// A random point of a cell.
    fn point_in(&self, cell: usize, generator: &mut ChaCha8Rng) -> [f64; D] {
        let place = place(&self.counts, cell as u64);
        std::array::from_fn(|a| self.origin[a] + (place[a] as f64 + generator.random::<f64>()) * self.width())
    }

    /// Adds a point that is far enough from all others; says whether it is.
    fn add(&mut self, x: [f64; D]) -> bool {
        let cell: [i64; D] = std::array::from_fn(|a| ((x[a] - self.origin[a]) / self.width()).floor() as i64);
        let Some(own) = self.number(&cell) else { return false };
        // A point within r is at most ⌈√D⌉ ≤ 2 cells away along each axis.
        for offset in 0..5u64.pow(D as u32) {
            let step = place(&[5; D], offset);
            let other = std::array::from_fn(|a| cell[a] + step[a] as i64 - 2);
            let neighbour = self.number(&other).and_then(|number| self.cells.get(number));
            if let Some(&index @ 1..) = neighbour
                && let Some(point) = self.points.get(index as usize - 1)
                && mpm_tensor::vector::distance(&x, point) < self.radius
            {
                return false;
            }
        }
        self.points.push(x);
        let number = self.points.len() as u32;
        self.active.push(number - 1);
        if let Some(cell) = self.cells.get_mut(own) {
            *cell = number;
        }
        true
    }

    fn number(&self, cell: &[i64; D]) -> Option<usize> {
        cell.iter()
            .zip(&self.counts)
            .try_fold(0, |number: usize, (&c, &count)| {
                let inside = c >= 0 && (c as u64) < count;
                inside.then(|| number * count as usize + c as usize)
            })
    }

    /// Places points around active ones until none has room.
    fn spread(&mut self, shape: &dyn Shape<D>, bounds: &Bounds<D>, generator: &mut ChaCha8Rng) {
        while !self.active.is_empty() {
            let chosen = generator.random_range(0..self.active.len());
            let centre = self.points[self.active[chosen] as usize];
            let found = (0..CANDIDATES).any(|_| {
                let x = around(&centre, self.radius, generator);
                bounds.contains(&x) && shape.distance(&x) < 0.0 && self.add(x)
            });
            if !found {
                self.active.swap_remove(chosen);
            }
        }
    }
}

/// A point drawn evenly from the shell between r and 2r around a centre.
fn around<const D: usize>(centre: &[f64; D], radius: f64, generator: &mut ChaCha8Rng) -> [f64; D] {
    loop {
        let offset: [f64; D] = std::array::from_fn(|_| generator.random_range(-2.0..2.0));
        if (1.0..4.0).contains(&mpm_tensor::vector::norm_squared(&offset)) {
            return mpm_tensor::vector::add_scaled(centre, radius, &offset);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shape::{Ball, Cuboid, Union};

    fn check<const D: usize>(shape: &dyn Shape<D>, step: f64, volume: f64) {
        let filling = poisson_disk("block", shape, step, &Bounds::EVERYWHERE, 7).expect("few points");
        let radius = step * points_per_radius::<D>().powf(1.0 / D as f64);
        let points = &filling.positions;
        for (k, x) in points.iter().enumerate() {
            assert!(shape.distance(x) < 0.0);
            assert!(points[..k].iter().all(|y| mpm_tensor::vector::distance(x, y) >= radius));
        }
        let expected = volume / step.powi(D as i32);
        let density = points.len() as f64 / expected;
        assert!((0.9..1.25).contains(&density), "D = {D}: {density}");
        let total = filling.volume();
        assert!((total / volume - 1.0).abs() < 0.01, "{total} of {volume}");
        assert_eq!(
            poisson_disk("block", shape, step, &Bounds::EVERYWHERE, 7).expect("few points"),
            filling
        );
    }

    #[test]
    fn points_keep_their_distance_and_fill_the_shape() {
        check(
            &Cuboid {
                lower: [0.0],
                upper: [3.0],
            },
            0.01,
            3.0,
        );
        check(
            &Ball {
                centre: [0.2, 0.1],
                radius: 1.0,
            },
            0.05,
            std::f64::consts::PI,
        );
        check(
            &Cuboid {
                lower: [0.0; 3],
                upper: [1.0, 0.5, 0.5],
            },
            0.07,
            0.25,
        );
    }

    #[test]
    fn separate_parts_are_all_filled() {
        let part = |lower: [f64; 2], upper| Box::new(Cuboid { lower, upper }) as Box<dyn Shape<2>>;
        let parts = Union(vec![part([0.0, 0.0], [1.0, 1.0]), part([5.0, 3.0], [6.0, 4.0])]);
        let filling = poisson_disk("block", &parts, 0.1, &Bounds::EVERYWHERE, 0).expect("few points");
        let right = filling.positions.iter().filter(|x| x[0] > 4.0).count();
        assert!((80..140).contains(&right) && (80..140).contains(&(filling.positions.len() - right)));
        check(&parts, 0.1, 2.0);
    }
}
