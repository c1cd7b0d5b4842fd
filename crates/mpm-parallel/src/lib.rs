#![doc = include_str!("../README.md")]

mod compiled_ahead;

use rayon::prelude::*;

/// A piece of work.
type Task<'a> = Box<dyn FnOnce() + Send + 'a>;

/// Threads that work side by side here.
pub fn threads() -> usize {
    rayon::current_num_threads()
}

/// Do `work` on every item, side by side.
pub fn each<T: Send>(items: impl ExactSizeIterator<Item = T>, work: &(dyn Fn(T) + Sync)) {
    if items.len() <= 1 || threads() == 1 {
        items.for_each(work);
    } else {
        run(items.map(|item| Box::new(move || work(item)) as Task).collect());
    }
}

/// What `work` makes of every item, in the order of the items.
pub fn map<T: Send, R: Send>(items: impl ExactSizeIterator<Item = T>, work: &(dyn Fn(T) -> R + Sync)) -> Vec<R> {
    if items.len() <= 1 || threads() == 1 {
        return items.map(work).collect();
    }
    let mut results: Vec<Option<R>> = (0..items.len()).map(|_| None).collect();
    each(items.zip(&mut results), &|(item, result)| *result = Some(work(item)));
    results.into_iter().flatten().collect()
}

/// What `work` makes of the numbers below `count`, in their order; `together` of them are one piece of work.
pub fn collect<R: Send>(count: usize, together: usize, work: &(dyn Fn(usize) -> R + Sync)) -> Vec<R> {
    let together = together.max(1);
    if count <= together || threads() == 1 {
        return (0..count).map(work).collect();
    }
    let piece = |start: usize| (start..count.min(start + together)).map(work).collect::<Vec<R>>();
    let starts = (0..count.div_ceil(together)).map(|index| index * together);
    map(starts, &piece).into_iter().flatten().collect()
}

/// Pieces of work for every thread, where pieces may be of any length.
const PIECES_PER_THREAD: usize = 8;

/// `to[k]` = `work(&from[k])` as far as both go; how much one piece of work is depends on the number of threads.
pub fn write<T: Sync, R: Send>(from: &[T], to: &mut [R], work: &(dyn Fn(&T) -> R + Sync)) {
    let piece = from.len().div_ceil(PIECES_PER_THREAD * threads()).max(1);
    each(from.chunks(piece).zip(to.chunks_mut(piece)), &|(from, to): (
        &[T],
        &mut [R],
    )| {
        to.iter_mut().zip(from).for_each(|(to, from)| *to = work(from));
    });
}

/// The side of the threads.
fn run(tasks: Vec<Task>) {
    tasks.into_par_iter().for_each(|task| task());
}

#[cfg(test)]
mod tests {
    fn on_threads<R: Send>(count: usize, work: impl FnOnce() -> R + Send) -> R {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(count).build();
        pool.expect("a few threads").install(work)
    }

    #[test]
    fn results_are_in_order_on_any_number_of_threads() {
        for threads in [1, 2, 3] {
            for count in [0, 1, 2, 17, 1000] {
                let expected: Vec<usize> = (0..count).map(|k| k * k).collect();
                let square = |k: usize| k * k;
                assert_eq!(on_threads(threads, || super::map(0..count, &square)), expected);
                for together in [0, 1, 7, 5000] {
                    assert_eq!(
                        on_threads(threads, || super::collect(count, together, &square)),
                        expected
                    );
                }
            }
        }
    }

    #[test]
    fn every_entry_is_written_in_its_place() {
        for threads in [1, 2, 3] {
            for count in [0, 1, 100] {
                let from: Vec<usize> = (0..count).collect();
                let mut to = vec![0; count];
                on_threads(threads, || super::write(&from, &mut to, &|k| k + 1));
                assert!(to.iter().zip(&from).all(|(to, from)| *to == from + 1));
            }
        }
    }

    #[test]
    fn every_item_is_worked_on_once() {
        for threads in [1, 3] {
            let mut counts = vec![0; 100];
            on_threads(threads, || {
                super::each(counts.iter_mut(), &|count: &mut i32| *count += 1)
            });
            assert!(counts.iter().all(|&count| count == 1));
        }
    }
}
