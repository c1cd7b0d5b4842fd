//! Lines of equal density by marching squares, and the levels that enclose given masses.

use std::collections::BTreeMap;

use crate::statistics::DensityGrid;

/// The density levels whose super-level sets hold the fractions `masses` of the grid's mass (highest-density regions).
/// Each node stands for the cell around it. Levels of a grid without mass are infinite.
pub fn levels_of_mass(grid: &DensityGrid, masses: &[f64]) -> Vec<f64> {
    let (widths, heights) = (cell_sizes(&grid.x), cell_sizes(&grid.y));
    let columns = grid.x.len();
    let mut cells: Vec<(f64, f64)> = grid
        .values
        .iter()
        .enumerate()
        .filter(|(_, value)| value.is_finite() && **value > 0.0)
        .map(|(node, &value)| {
            let area = widths[node % columns] * heights[node / columns];
            (value, value * area)
        })
        .collect();
    cells.sort_by(|left, right| right.0.total_cmp(&left.0));
    let total: f64 = cells.iter().map(|cell| cell.1).sum();
    masses
        .iter()
        .map(|mass| {
            let mut enclosed = 0.0;
            cells
                .iter()
                .find(|cell| {
                    enclosed += cell.1;
                    enclosed >= mass * total
                })
                .map_or(f64::INFINITY, |cell| cell.0)
        })
        .collect()
}

/// The extent of the cell around each of the ascending `nodes`.
fn cell_sizes(nodes: &[f64]) -> Vec<f64> {
    (0..nodes.len())
        .map(|index| {
            let below = nodes[index.saturating_sub(1)];
            let above = nodes[(index + 1).min(nodes.len() - 1)];
            if nodes.len() < 2 { 1.0 } else { 0.5 * (above - below) }
        })
        .collect()
}

/// The lines on which the grid, interpolated linearly along cell edges, equals `level`. Closed lines end with their first
/// point; lines that leave the grid are open. Values that are not finite count as zero.
pub fn contour_lines(grid: &DensityGrid, level: f64) -> Vec<Vec<(f64, f64)>> {
    let (columns, rows) = (grid.x.len(), grid.y.len());
    if !level.is_finite() || columns < 2 || rows < 2 {
        return Vec::new();
    }
    let value = |node: usize| {
        let value = grid.values[node];
        if value.is_finite() { value } else { 0.0 }
    };
    // Where the line crosses the edge between two nodes; edges are named by their nodes, the smaller first.
    let crossing = |edge: (usize, usize)| {
        let (first, second) = (value(edge.0), value(edge.1));
        let fraction = (level - first) / (second - first);
        let along = |nodes: &[f64], from: usize, to: usize| nodes[from] + fraction * (nodes[to] - nodes[from]);
        (
            along(&grid.x, edge.0 % columns, edge.1 % columns),
            along(&grid.y, edge.0 / columns, edge.1 / columns),
        )
    };
    let mut links: BTreeMap<(usize, usize), Vec<(usize, usize)>> = BTreeMap::new();
    let mut link = |from: (usize, usize), to: (usize, usize)| {
        links.entry(from).or_default().push(to);
        links.entry(to).or_default().push(from);
    };
    for row in 0..rows - 1 {
        for column in 0..columns - 1 {
            let lower_left = row * columns + column;
            let corners = [
                lower_left,
                lower_left + 1,
                lower_left + columns + 1,
                lower_left + columns,
            ];
            let inside = corners.map(|corner| value(corner) > level);
            let edges: Vec<(usize, usize)> = (0..4)
                .filter(|&side| inside[side] != inside[(side + 1) % 4])
                .map(|side| {
                    let (a, b) = (corners[side], corners[(side + 1) % 4]);
                    (a.min(b), a.max(b))
                })
                .collect();
            match edges[..] {
                [first, second] => link(first, second),
                [first, second, third, fourth] => {
                    // A saddle: the mean of the corners decides which sides belong together.
                    let centre = corners.iter().map(|&c| value(c)).sum::<f64>() > 4.0 * level;
                    if centre == inside[0] {
                        link(first, second);
                        link(third, fourth);
                    } else {
                        link(fourth, first);
                        link(second, third);
                    }
                }
                _ => {}
            }
        }
    }
    let mut lines = Vec::new();
    // Open lines start at edges with a single link; what remains is closed.
    let ends: Vec<(usize, usize)> = links
        .iter()
        .filter(|(_, next)| next.len() == 1)
        .map(|(edge, _)| *edge)
        .collect();
    let all: Vec<(usize, usize)> = links.keys().copied().collect();
    for start in ends.into_iter().chain(all) {
        let mut path = vec![start];
        let mut current = start;
        while let Some(next) = links.get_mut(&current).and_then(Vec::pop) {
            if let Some(back) = links.get_mut(&next)
                && let Some(position) = back.iter().position(|edge| *edge == current)
            {
                back.remove(position);
            }
            path.push(next);
            current = next;
        }
        if path.len() > 1 {
            lines.push(path.into_iter().map(crossing).collect());
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gaussian(size: usize) -> DensityGrid {
        DensityGrid::evaluate((-5.0, 5.0), (-5.0, 5.0), (size, size), |x, y| {
            (-0.5 * (x * x + y * y)).exp()
        })
    }

    /// The super-level set of mass q of N(0, I₂) is the disc of squared radius −2 ln(1 − q), at density 1 − q of the peak's.
    #[test]
    fn levels_enclose_their_mass() {
        let levels = levels_of_mass(&gaussian(201), &[0.5, 0.9, 0.99]);
        for (level, expected) in levels.iter().zip([0.5, 0.1, 0.01]) {
            assert!((level / expected - 1.0).abs() < 0.02, "{level} {expected}");
        }
    }

    #[test]
    fn the_contour_of_a_gaussian_is_one_closed_circle() {
        let lines = contour_lines(&gaussian(101), 0.5);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].first(), lines[0].last());
        let radius = (2.0 * 2f64.ln()).sqrt();
        for (x, y) in &lines[0] {
            assert!((x.hypot(*y) - radius).abs() < 0.005);
        }
    }

    #[test]
    fn a_line_that_leaves_the_grid_is_open() {
        let grid = DensityGrid::evaluate((0.0, 1.0), (0.0, 1.0), (5, 5), |x, _| x);
        let lines = contour_lines(&grid, 0.4);
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].len(), 5);
        assert!(lines[0].iter().all(|(x, _)| (x - 0.4).abs() < 1e-12));
    }

    #[test]
    fn a_saddle_has_two_branches_and_nothing_has_none() {
        let saddle = DensityGrid {
            x: vec![0.0, 1.0],
            y: vec![0.0, 1.0],
            values: vec![1.0, 0.0, 0.0, 1.0],
        };
        assert_eq!(contour_lines(&saddle, 0.4).len(), 2);
        assert!(contour_lines(&saddle, f64::INFINITY).is_empty());
        let empty = DensityGrid::evaluate((0.0, 1.0), (0.0, 1.0), (3, 3), |_, _| f64::NAN);
        assert_eq!(levels_of_mass(&empty, &[0.5]), [f64::INFINITY]);
        assert!(contour_lines(&empty, 0.1).is_empty());
    }
}
