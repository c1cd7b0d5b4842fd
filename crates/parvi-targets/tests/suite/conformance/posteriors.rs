//! Posteriors, whose moments are not known in closed form.

use super::promises::conforms;

#[test]
fn schools() {
    crate::in_dimensions!(conforms("schools"), 3, 4, 8);
}

#[test]
fn probit_and_poisson() {
    crate::in_dimensions!(conforms("probit"), 1, 3, 5, 6);
    crate::in_dimensions!(conforms("poisson"), 1, 2, 4, 8);
}

#[test]
fn regressions() {
    crate::in_dimensions!(conforms("wells"), 1, 3, 6);
    crate::in_dimensions!(conforms("wells-small"), 2, 5);
}
