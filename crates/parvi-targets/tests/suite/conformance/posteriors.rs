//! Posteriors, whose moments are not known in closed form.

use super::promises::conforms;

#[test]
fn schools() {
    in_dimensions!(conforms("schools"), 3, 4, 8);
}

#[test]
fn probit_and_poisson() {
    in_dimensions!(conforms("probit"), 1, 3, 5, 6);
    in_dimensions!(conforms("poisson"), 1, 2, 4, 8);
}

#[test]
fn regressions() {
    in_dimensions!(conforms("wells"), 1, 3, 6);
    in_dimensions!(conforms("wells-small"), 2, 5);
}
