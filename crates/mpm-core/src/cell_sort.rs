//! Particles by cell, for bases that number their cells once and for all.

use crate::Schedule;
use crate::counting_sort::counting_sort;

/// Particles are sorted once one in so many is followed by one of an earlier cell, as on a grid.
const PARTICLES_PER_DESCENT: usize = 8;

/// The buffers of a sort by cell.
#[derive(Clone, Debug, Default)]
pub struct CellSort {
    bin_starts: Vec<u32>,
    cursors: Vec<u32>,
}

impl CellSort {
    /// Lay out particles of which the k-th is in cell `cells[k]` < `cell_count`. Particles that are nearly in the order of the cells
    /// stay where they are, and the cells of the schedule are runs of them; others are sorted, those of one cell in the order in which they come.
    ///
    /// The outcome depends on `cells` alone. The parts of the schedule are left for [`Schedule::cut`].
    pub fn sort(&mut self, cells: &[u32], cell_count: usize, schedule: &mut Schedule) {
        let Schedule { order, cell_starts, .. } = schedule;
        let descents = cells.windows(2).filter(|pair| pair[1] < pair[0]).count();
        let keeps_order = descents * PARTICLES_PER_DESCENT <= cells.len();
        cell_starts.clear();
        if keeps_order {
            if !schedule.keeps_order || order.len() != cells.len() {
                order.clear();
                order.extend(0..cells.len() as u32);
            }
            let begins = |&k: &usize| k == 0 || cells[k] != cells[k - 1];
            cell_starts.extend((0..cells.len()).filter(begins).map(|k| k as u32));
        } else {
            counting_sort(cells, cell_count, &mut self.bin_starts, order, &mut self.cursors);
            let occupied = self.bin_starts.windows(2).filter(|bin| bin[0] < bin[1]);
            cell_starts.extend(occupied.map(|bin| bin[0]));
        }
        cell_starts.push(cells.len() as u32);
        schedule.keeps_order = keeps_order;
    }

    /// [`sort`](Self::sort), after which `cells` are those of the particles in the new order.
    pub fn sort_with_cells(&mut self, cells: &mut Vec<u32>, cell_count: usize, schedule: &mut Schedule) {
        self.sort(cells, cell_count, schedule);
        if !schedule.keeps_order {
            let order = schedule.order.iter();
            *cells = order.map(|&particle| cells[particle as usize]).collect();
        }
    }

    /// Bytes held.
    pub fn storage_bytes(&self) -> usize {
        (self.bin_starts.capacity() + self.cursors.capacity()) * 4
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sorted(cells: &[u32]) -> (Schedule, Vec<Vec<u32>>) {
        let mut schedule = Schedule::default();
        CellSort::default().sort(cells, 100, &mut schedule);
        let order = schedule.order().to_vec();
        let by_cell = (0..schedule.cell_count()).map(|cell| order[schedule.cell(cell)].to_vec());
        let by_cell = by_cell.collect();
        (schedule, by_cell)
    }

    #[test]
    fn a_shuffled_list_is_sorted_by_cell() {
        let (schedule, by_cell) = sorted(&[7, 3, 7, 3, 99, 0]);
        assert!(!schedule.keeps_order());
        assert_eq!(by_cell, [vec![5], vec![1, 3], vec![0, 2], vec![4]]);
    }

    #[test]
    fn a_list_that_is_nearly_sorted_stays_and_its_runs_are_the_cells() {
        let (schedule, by_cell) = sorted(&[0, 0, 0, 2, 2, 1, 2, 2, 5, 5]);
        assert!(schedule.keeps_order());
        assert_eq!(by_cell, [vec![0, 1, 2], vec![3, 4], vec![5], vec![6, 7], vec![8, 9]]);
    }

    #[test]
    fn without_particles_there_are_no_cells() {
        let (schedule, by_cell) = sorted(&[]);
        assert!(by_cell.is_empty() && schedule.keeps_order());
    }
}
