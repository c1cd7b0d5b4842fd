//! The options of the paper's algorithms, from the flags.

use parvi::{Annealing, Guards, PaperOptions};

use super::{Basis, Limit, MethodOptions, Switch};

impl MethodOptions {
    /// Algorithm 1, or 2 if `affine`.
    pub(super) fn paper(&self, steps: Option<usize>, affine: bool) -> PaperOptions {
        let default = PaperOptions::default();
        PaperOptions {
            affine,
            basis: self.basis.and_then(Basis::uniform).unwrap_or(default.basis),
            elasticity: self.material.map_or(default.elasticity, Into::into),
            youngs_modulus: self.youngs_modulus.unwrap_or(default.youngs_modulus),
            poissons_ratio: self.poissons_ratio.unwrap_or(default.poissons_ratio),
            annealing: self.annealing().unwrap_or(default.annealing),
            score_location: self.score.map_or(default.score_location, Into::into),
            spacing: self.spacing.or(default.spacing),
            steps: steps.or(default.steps),
            time_step: self.time_step.or(default.time_step),
            guards: self.guards(),
            trace_every: self.trace_every,
            ..default
        }
    }

    /// α over the steps, where one is given.
    pub(super) fn annealing(&self) -> Option<Annealing> {
        match (self.alpha, self.alpha_from, self.alpha_to) {
            (Some(alpha), _, _) => Some(Annealing::Constant(alpha)),
            (None, Some(from), Some(to)) => Some(Annealing::Geometric { from, to }),
            _ => None,
        }
    }

    fn guards(&self) -> Guards {
        let base = match self.guards {
            Some(Switch::Off) => Guards::none(),
            _ => Guards::default(),
        };
        Guards {
            mass_floor: self.mass_floor.unwrap_or(base.mass_floor),
            mass_weighted_force: self.mass_weighted_force.map_or(base.mass_weighted_force, Switch::is_on),
            courant: self.courant.map_or(base.courant, Limit::value),
            displacement_limit: self.displacement_limit.map_or(base.displacement_limit, Limit::value),
        }
    }
}
