//! Posteriors, whose moments are not known in closed form.

use super::promises::conforms;

#[test]
fn schools() {
    conforms::<3>("schools");
    conforms::<4>("schools");
    conforms::<8>("schools");
}

#[test]
fn probit_and_poisson() {
    conforms::<1>("probit");
    conforms::<3>("probit");
    conforms::<5>("probit");
    conforms::<6>("probit");
    conforms::<1>("poisson");
    conforms::<2>("poisson");
    conforms::<4>("poisson");
    conforms::<8>("poisson");
}

#[test]
fn regressions() {
    conforms::<1>("wells");
    conforms::<2>("wells");
    conforms::<3>("wells");
    conforms::<4>("wells");
    conforms::<5>("wells");
    conforms::<6>("wells");
    conforms::<2>("wells-small");
    conforms::<5>("wells-small");
}
