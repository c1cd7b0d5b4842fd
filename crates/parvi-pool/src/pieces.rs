//! Space cut into pieces that hold as many particles as their mass asks for.

use mpm_tensor::{Matrix, vector};

use crate::order::extent;

/// Orthogonal directions, one in each row, oblique to the axes and for every `number` to those of the one before:
/// √(2/D) cos(π (i + ½)(j + ½)/D), the discrete cosine transform IV, in which no entry is large, with signs by columns: +, +−, ++−−, ….
pub(crate) fn oblique_directions<const D: usize>(number: u32) -> Matrix<D> {
    let period = 1_usize << number;
    Matrix::from_fn(|row, column| {
        let angle = std::f64::consts::PI * (row as f64 + 0.5) * (column as f64 + 0.5) / D as f64;
        let sign = if column % period < period.div_ceil(2) {
            1.0
        } else {
            -1.0
        };
        sign * (2.0 / D as f64).sqrt() * angle.cos()
    })
}

/// A weighted point of a measure.
#[derive(Clone, Copy)]
pub(crate) struct Weighted<const D: usize> {
    pub x: [f64; D],
    /// Its weight, of either sign.
    pub c: f64,
    /// Its share in weights of which none is negative.
    pub rise: f64,
}

/// Points and particles on one side of a cut.
type Side<'a, const D: usize> = (&'a mut [Weighted<D>], &'a mut [[f64; D]]);

/// Particles between which a piece may be cut, as shares of its own: where counts and masses agree best.
const WINDOW: [f64; 2] = [0.375, 0.625];

/// Does something with the points and particles of every piece, of `most` particles at most; pieces side by side.
///
/// A piece is cut across the direction that it is longest in, near the middle. Points keep their order within each.
pub(crate) fn in_pieces<const D: usize>(
    points: &mut [Weighted<D>],
    particles: &mut [[f64; D]],
    directions: &Matrix<D>,
    most: usize,
    act: &(impl Fn(&[Weighted<D>], &mut [[f64; D]]) + Sync),
) {
    if particles.is_empty() || points.is_empty() {
        return;
    }
    if particles.len() > most {
        let (direction, cut) = cut(points, particles, directions);
        let above = |x: &[f64; D]| vector::dot(direction, x) > cut;
        let (low, high) = parted(points, |point| above(&point.x));
        let (few, many) = parted(particles, above);
        // A side without mass, beside one heavy point, would draw its particles nowhere.
        let has_mass = |side: &[Weighted<D>]| side.iter().map(|point| point.rise).sum::<f64>() > 0.0;
        if !(few.is_empty() || many.is_empty()) && has_mass(low) && has_mass(high) {
            let sides = [(low, few), (high, many)];
            mpm_parallel::each(sides.into_iter(), &|(points, particles): Side<'_, D>| {
                in_pieces(points, particles, directions, most, act);
            });
            return;
        }
    }
    act(points, particles);
}

/// Those that are not above before those that are, both in the order in which they stood.
fn parted<T: Copy>(all: &mut [T], above: impl Fn(&T) -> bool) -> (&mut [T], &mut [T]) {
    let mut beyond = all.to_vec();
    let (mut low, mut high) = (0, 0);
    // Each is written down on both sides, and counted on one: which one it is cannot be foreseen.
    for index in 0..all.len() {
        let one = all[index];
        (all[low], beyond[high]) = (one, one);
        let is_above = above(&one);
        low += usize::from(!is_above);
        high += usize::from(is_above);
    }
    let (below, rest) = all.split_at_mut(low);
    rest.copy_from_slice(&beyond[..high]);
    (below, rest)
}

/// The direction that points are farthest apart in, and between two particles near the middle the place where the share of the mass below is nearest to
/// that of the particles.
fn cut<'a, const D: usize>(
    points: &[Weighted<D>],
    particles: &[[f64; D]],
    directions: &'a Matrix<D>,
) -> (&'a [f64; D], f64) {
    let length = |direction: &[f64; D]| {
        let (low, high) = extent(points.iter().map(|point| vector::dot(direction, &point.x)));
        high - low
    };
    let lengths = directions.0.iter().map(|direction| (length(direction), direction));
    let longest = lengths.reduce(|longest, next| if next.0 > longest.0 { next } else { longest });
    let direction = longest.map_or(&[0.0; D], |(_, direction)| direction);
    let mut places: Vec<f64> = particles.iter().map(|x| vector::dot(direction, x)).collect();
    places.sort_unstable_by(f64::total_cmp);
    let [first, last] = WINDOW.map(|share| ((share * places.len() as f64) as usize).max(1));
    let cuts: Vec<f64> = (first..=last)
        .map(|below| 0.5 * (places[below - 1] + places[below]))
        .collect();
    let mut masses = vec![0.0; cuts.len() + 1];
    for point in points {
        let s = &vector::dot(direction, &point.x);
        // Most points of a large piece are beside the window.
        let below = match &cuts[..] {
            [first, ..] if s <= first => 0,
            [.., last] if s > last => cuts.len(),
            _ => cuts.partition_point(|cut| cut < s),
        };
        masses[below] += point.rise;
    }
    let per_particle = masses.iter().sum::<f64>() / places.len() as f64;
    let mut mass = 0.0;
    let mut best = (f64::INFINITY, f64::NAN);
    for (below, (cut, own)) in (first..).zip(cuts.iter().zip(&masses)) {
        mass += own;
        let excess = (mass - below as f64 * per_particle).abs();
        if excess < best.0 {
            best = (excess, *cut);
        }
    }
    (direction, best.1)
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    fn plane(count: usize) -> Vec<[f64; 2]> {
        let place = |n: usize| [(n as f64 * 0.618).fract(), (n as f64 * 0.755).fract() * 2.0];
        (0..count).map(place).collect()
    }

    #[test]
    fn directions_are_orthogonal_and_oblique_to_the_axes_and_to_those_before() {
        fn check<const D: usize>() {
            let mut last = Matrix::IDENTITY;
            for number in 0..3 {
                let directions = oblique_directions::<D>(number);
                assert!((directions.transpose() * directions - Matrix::IDENTITY).maximum_norm() < 1e-14);
                assert!(directions.maximum_norm() < 0.93);
                assert!((directions * last.transpose()).maximum_norm() < 0.93);
                last = directions;
            }
        }
        check::<2>();
        check::<3>();
        check::<5>();
        check::<8>();
    }

    #[test]
    fn pieces_hold_the_particles_that_their_mass_asks_for() {
        let weight = |x: &[f64; 2]| if x[0] > 0.7 { 4.0 } else { 1.0 };
        let mut points: Vec<Weighted<2>> = plane(4000)
            .iter()
            .map(|x| Weighted {
                x: *x,
                c: weight(x),
                rise: weight(x),
            })
            .collect();
        let total: f64 = points.iter().map(|point| point.c).sum();
        // Four times as many particles where the weight is.
        let mut particles: Vec<[f64; 2]> = plane(2000)
            .into_iter()
            .enumerate()
            .filter(|(n, x)| x[0] > 0.7 || n % 4 == 0)
            .map(|(_, x)| x)
            .collect();
        let count = particles.len();
        let pieces = Mutex::new(Vec::new());
        let note = |points: &[Weighted<2>], particles: &mut [[f64; 2]]| {
            let mass: f64 = points.iter().map(|point| point.rise).sum();
            let piece = (mass / total * count as f64, particles.len());
            pieces.lock().unwrap().push(piece);
        };
        in_pieces(&mut points, &mut particles, &oblique_directions(1), 100, &note);
        let pieces = pieces.into_inner().unwrap();
        assert_eq!(pieces.iter().map(|(_, own)| own).sum::<usize>(), count);
        assert!(pieces.iter().all(|(_, own)| (30..=100).contains(own)));
        let excess = |(mass, own): &(f64, usize)| (mass - *own as f64).abs();
        let excesses = pieces.iter().map(excess);
        assert!(excesses.clone().sum::<f64>() < pieces.len() as f64, "{pieces:?}");
        assert!(excesses.fold(0.0, f64::max) < 3.0, "{pieces:?}");
    }

    #[test]
    fn points_in_one_place_are_one_piece() {
        let weighted = |_| Weighted {
            x: [1.0],
            c: 1.0,
            rise: 1.0,
        };
        let mut points: Vec<Weighted<1>> = (0..9).map(weighted).collect();
        let calls = AtomicUsize::new(0);
        let count = |_: &[Weighted<1>], particles: &mut [[f64; 1]]| {
            assert_eq!(particles.len(), 7);
            calls.fetch_add(1, Ordering::Relaxed);
        };
        in_pieces(&mut points, &mut [[1.0]; 7], &Matrix::IDENTITY, 2, &count);
        assert_eq!(calls.into_inner(), 1);
    }

    #[test]
    fn no_piece_is_without_mass() {
        // All mass in one point, in the middle of the particles.
        let mut points: Vec<Weighted<1>> = (0..9_i8)
            .map(|n| Weighted {
                x: [f64::from(n)],
                c: 0.0,
                rise: if n == 4 { 1.0 } else { 0.0 },
            })
            .collect();
        let mut particles: Vec<[f64; 1]> = (0..64_i8).map(|n| [f64::from(n) / 8.0]).collect();
        let has_mass = |points: &[Weighted<1>], _: &mut [[f64; 1]]| {
            assert!(points.iter().any(|point| point.rise > 0.0));
        };
        in_pieces(&mut points, &mut particles, &Matrix::IDENTITY, 4, &has_mass);
    }
}
