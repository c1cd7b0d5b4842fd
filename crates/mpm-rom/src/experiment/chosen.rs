//! Sample points that were chosen on training runs.

use std::rc::Rc;

use super::{ChoiceName, ManifoldName};
use crate::online::{
    KnownPoints, OnlineError, Reading, ReducedBody, SampleChoice, choose_cubature, choose_greedily, rank_exchanges,
};

/// A manifold, the number of the network, how points are chosen, and |𝒫|.
pub(super) type Of = (ManifoldName, usize, ChoiceName, usize);

/// The sample points of every manifold, network and number of them. They hang on the scene, too: its kinematic regions need not be the same in all cases.
#[derive(Default)]
pub(super) struct Chosen<const D: usize>(Vec<Best<D>>);

/// The readings on which points are chosen, and the points.
pub(super) struct Best<const D: usize> {
    pub of: Of,
    /// Of training runs, in per cent; infinite where none has been made.
    pub error: f64,
    readings: Rc<Readings<D>>,
    made: Vec<Made>,
    /// Points of the readings that the choice takes, and those that stand in their place.
    exchanges: Vec<(usize, usize)>,
}

/// Steps from states of training runs, and where the points that they are read at are at rest.
pub(super) struct Readings<const D: usize> {
    pub positions: Vec<[f64; D]>,
    pub steps: Vec<Reading<D>>,
}

/// The choice for a body with these members of its kinematic regions; all bodies that are asked for one after another are alike but for these.
struct Made {
    regions: Vec<Vec<usize>>,
    known: KnownPoints,
    points: SampleChoice,
}

impl<const D: usize> Chosen<D> {
    /// Takes choices that have been tried. What they made for the bodies of their trials is forgotten: a finer body may have the same kinematic regions.
    pub fn extend(&mut self, chosen: impl IntoIterator<Item = Best<D>>) {
        let forgetting = |best| Best {
            made: Vec::new(),
            ..best
        };
        self.0.extend(chosen.into_iter().map(forgetting));
    }

    /// The points of a run of this body.
    ///
    /// # Errors
    /// Those of the choice; [`OnlineError::Readings`] where nothing has been read for it.
    pub fn points(&mut self, of: Of, coordinates: usize, body: &ReducedBody<D>) -> Result<SampleChoice, OnlineError> {
        match self.0.iter_mut().find(|best| best.of == of) {
            Some(best) => best.points(coordinates, body),
            None => Err(OnlineError::Readings {
                readings: 0,
                points: body.reference.len(),
            }),
        }
    }
}

impl<const D: usize> Best<D> {
    pub fn new(of: Of, readings: Rc<Readings<D>>) -> Self {
        Self {
            of,
            error: f64::INFINITY,
            readings,
            made: Vec::new(),
            exchanges: Vec::new(),
        }
    }

    /// The points of a run of this body.
    ///
    /// # Errors
    /// Those of the choice.
    pub fn points(&mut self, coordinates: usize, body: &ReducedBody<D>) -> Result<SampleChoice, OnlineError> {
        let made = made(&mut self.made, self.of, &self.readings, coordinates, body)?;
        Ok(made.with(&self.exchanges))
    }

    /// Exchanges of its points in this body, the most promising first, by their numbers in the readings.
    ///
    /// # Errors
    /// Those of the choice.
    pub fn ranked(&mut self, coordinates: usize, body: &ReducedBody<D>) -> Result<Vec<(usize, usize)>, OnlineError> {
        let made = made(&mut self.made, self.of, &self.readings, coordinates, body)?;
        let SampleChoice::Given(numbers) = made.with(&self.exchanges) else {
            return Ok(Vec::new());
        };
        let (steps, known) = (&self.readings.steps, &made.known);
        let ranked = rank_exchanges(steps, coordinates, &body.kinematics, known, &numbers)?.into_iter();
        Ok(ranked
            .filter_map(|(from, to)| Some((known.place(from)?, known.place(to)?)))
            .collect())
    }

    /// Takes the second of these points of the readings where the choice, with the exchanges before, takes the first; bodies where that makes no sense, as one of them is in a kinematic region, keep what they have.
    pub fn exchange(&mut self, exchanged: (usize, usize)) {
        self.exchanges.push(exchanged);
    }

    /// Takes the last exchange back.
    pub fn restore(&mut self) {
        self.exchanges.pop();
    }
}

/// What has been made for a body like this one, or is made now.
fn made<'a, const D: usize>(
    list: &'a mut Vec<Made>,
    (_, _, choice, count): Of,
    readings: &Readings<D>,
    coordinates: usize,
    body: &ReducedBody<D>,
) -> Result<&'a Made, OnlineError> {
    let kinematics = &body.kinematics;
    let regions: Vec<_> = kinematics
        .regions()
        .iter()
        .map(|region| region.members.clone())
        .collect();
    if let Some(earlier) = list.iter().position(|made| made.regions == regions) {
        return Ok(&list[earlier]);
    }
    let known = KnownPoints::nearest(&body.reference, &readings.positions);
    let steps = &readings.steps;
    let points = match choice {
        ChoiceName::Cubature => SampleChoice::Weighted(choose_cubature(steps, coordinates, kinematics, &known, count)?),
        _ => SampleChoice::Given(choose_greedily(steps, coordinates, kinematics, &known, count)?),
    };
    list.push(Made { regions, known, points });
    Ok(&list[list.len() - 1])
}

impl Made {
    fn is_kinematic(&self, number: u32) -> bool {
        let own = number as usize;
        self.regions.iter().any(|members| members.binary_search(&own).is_ok())
    }

    /// The choice after these exchanges.
    fn with(&self, exchanges: &[(usize, usize)]) -> SampleChoice {
        let mut points = self.points.clone();
        if let SampleChoice::Given(numbers) = &mut points {
            for &(from, to) in exchanges {
                let (from, to) = (self.known.numbers()[from], self.known.numbers()[to]);
                let place = numbers.iter().position(|&number| number == from);
                let sensible = !numbers.contains(&to) && !self.is_kinematic(from) && !self.is_kinematic(to);
                if let Some(place) = place.filter(|_| sensible) {
                    numbers[place] = to;
                    numbers.sort_unstable();
                }
            }
        }
        points
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use mpm_scenes::Scene;

    use super::*;

    /// A square of so many points along each side, nothing of which is held.
    fn square(points: usize) -> ReducedBody<2> {
        let text = format!(
            r#"
            title = "a square"
            dimension = 2
            domain = {{ lower = [-1.0, -1.0], upper = [2.0, 2.0] }}
            grid = {{ spacing = 0.25 }}
            transfer = {{ kind = "pic" }}
            time = {{ end = 0.2, step = 0.005, courant = 0.5 }}
            materials.rubber = {{ law = "fixed-corotated", density = 2.0, young_modulus = 500.0, poisson_ratio = 0.3 }}
            output = {{ interval = 0.05 }}
            [[bodies]]
            name = "square"
            shape = {{ kind = "box", lower = [0.0, 0.0], upper = [1.0, 1.0] }}
            material = "rubber"
            spacing = {}
            "#,
            1.0 / points as f64
        );
        ReducedBody::of(&Scene::parse(&text, Path::new("square.toml")).expect("a scene")).expect("a body")
    }

    #[test]
    fn another_body_with_the_same_regions_gets_its_own_points() {
        let (coarse, fine) = (square(4), square(8));
        assert_eq!([coarse.reference.len(), fine.reference.len()], [16, 64]);
        let value = |n: usize| (1.0 + 0.37 * n as f64).sin();
        let step = Reading {
            jacobians: (0..32).map(|n| [value(n), value(3 * n + 7)]).collect(),
            velocities: (0..16).map(|n| [value(5 * n + 1), value(2 * n + 9)]).collect(),
        };
        let readings = Rc::new(Readings {
            positions: coarse.reference.clone(),
            steps: vec![step],
        });
        let of = (ManifoldName::Network, 0, ChoiceName::Greedy, 6);
        let mut best = Best::new(of, Rc::clone(&readings));
        let of_coarse = best.points(2, &coarse).expect("points");
        let mut chosen = Chosen::default();
        chosen.extend([best]);
        let of_fine = chosen.points(of, 2, &fine).expect("points");
        assert_eq!(of_fine, Best::new(of, readings).points(2, &fine).expect("points"));
        assert_ne!(of_fine, of_coarse);
    }

    #[test]
    fn free_points_are_exchanged_where_that_makes_sense() {
        let made = Made {
            regions: vec![vec![0, 1, 2]],
            known: KnownPoints::all(9),
            points: SampleChoice::Given(vec![0, 1, 4, 6]),
        };
        let after = |exchanges: &[(usize, usize)]| match made.with(exchanges) {
            SampleChoice::Given(numbers) => numbers,
            other => panic!("{other:?}"),
        };
        assert_eq!(after(&[(6, 3)]), [0, 1, 3, 4]);
        assert_eq!(after(&[(6, 3), (3, 8)]), [0, 1, 4, 8]);
        for none in [(6, 4), (6, 2), (0, 8), (5, 8)] {
            assert_eq!(after(&[none]), [0, 1, 4, 6], "{none:?}");
        }
    }
}
