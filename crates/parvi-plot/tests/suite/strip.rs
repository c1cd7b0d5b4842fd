//! Moments that strips show.

use parvi_plot::moments;

#[test]
fn chosen_moments_are_different_and_in_order() {
    let chosen = |first: usize, end: usize| moments(&(first..end).collect::<Vec<_>>(), 5);
    assert_eq!(chosen(0, 101), [0, 4, 16, 36, 64]);
    assert_eq!(chosen(0, 6), [0, 1, 2, 3, 4]);
    assert_eq!(chosen(3, 6), [0, 1, 2]);
    assert_eq!(chosen(0, 0), [0; 0]);
}
