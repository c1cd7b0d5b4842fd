//! The options of the paper's algorithms, from the flags.

use mpm_materials::{ElasticModuli, LinearElastic};
use parvi::{Annealing, Guards, PaperMaterial, PaperOptions};

use super::{Basis, Limit, Material, MethodOptions, OptionError, Switch};

impl MethodOptions {
    /// Algorithm 1, or 2 if `affine`.
    pub(super) fn paper(&self, steps: Option<usize>, affine: bool) -> Result<PaperOptions, OptionError> {
        let default = PaperOptions::default();
        Ok(PaperOptions {
            affine,
            basis: self.basis.and_then(Basis::uniform).unwrap_or(default.basis),
            material: self.paper_material()?,
            annealing: self.annealing().unwrap_or(default.annealing),
            score_location: self.score.map_or(default.score_location, Into::into),
            spacing: self.spacing.or(default.spacing),
            steps: steps.or(default.steps),
            time_step: self.time_step.or(default.time_step),
            guards: self.guards(),
            trace_every: self.trace_every,
            ..default
        })
    }

    /// What the body is made of.
    fn paper_material(&self) -> Result<PaperMaterial, OptionError> {
        let (modulus, ratio) = (self.youngs_modulus.unwrap_or(1.0), self.poissons_ratio.unwrap_or(0.3));
        let moduli = ElasticModuli::new(modulus, ratio).map_err(|error| OptionError {
            name: "youngs-modulus".to_owned(),
            reason: error.to_string(),
        })?;
        Ok(match self.material {
            None | Some(Material::NeoHookean) => PaperMaterial::NeoHookean(mpm_materials::NeoHookean::new(moduli)),
            Some(Material::LinearElastic) => PaperMaterial::LinearElastic(LinearElastic::new(moduli)),
        })
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
