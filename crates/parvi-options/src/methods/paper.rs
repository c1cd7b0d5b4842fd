//! `paper-pic` and `paper-apic`: Algorithms 1 and 2 of the MPM-ParVI paper.

use parvi::{Annealing, Coordinates, Guards, Method, PaperOptions, ReferenceVolumes, Watch};

use super::MethodKind;
use crate::{AlphaSchedule, Basis, FrameName, Limit, MethodOptions, OptionError, StepCount, Switch};

/// Algorithm 1.
pub const PIC: MethodKind = MethodKind {
    name: "paper-pic",
    options: "steps basis spacing time-step score displacement-limit flip-share friction certificate material youngs-modulus poissons-ratio \
        as-written frame peak-yield-stress residual-yield-stress softening-rate friction-angle cohesion density sound-speed viscosity \
        forgets-expansion pressure-per-density grid-renewal masses volumes velocities stretch-limit alpha alpha-from alpha-to \
        alpha-schedule alpha-cycles monitor monitor-every patience best guards mass-floor mass-weighted-force courant start start-law \
        start-centre start-covariance start-mean start-sd start-draws",
    iterates: true,
    build: |options, steps| Ok(Method::Paper(options.paper(steps, false)?)),
};

/// Algorithm 2.
pub const APIC: MethodKind = MethodKind {
    name: "paper-apic",
    build: |options, steps| Ok(Method::Paper(options.paper(steps, true)?)),
    ..PIC
};

impl MethodOptions {
    /// Algorithm 1, or 2 if `affine`.
    fn paper(&self, steps: Option<usize>, affine: bool) -> Result<PaperOptions, OptionError> {
        if self.basis == Some(Basis::Mesh) {
            let name = if affine { APIC.name } else { PIC.name };
            return Err(OptionError::misfit("basis", "mesh", name));
        }
        let default = match self.as_written {
            Some(Switch::On) => PaperOptions::as_written(affine),
            _ => PaperOptions {
                affine,
                ..PaperOptions::default()
            },
        };
        Ok(PaperOptions {
            basis: self.basis.and_then(Basis::uniform).unwrap_or(default.basis),
            flip_share: self.flip_share.unwrap_or(default.flip_share),
            material: self.paper_material()?,
            annealing: self.annealing().unwrap_or(default.annealing),
            score_location: self.score.map_or(default.score_location, Into::into),
            spacing: self.spacing.or(default.spacing),
            steps: steps.or(default.steps),
            time_step: self.time_step.or(default.time_step),
            friction: self.friction.unwrap_or(default.friction),
            guards: self.guards(default.guards),
            coordinates: match self.frame {
                Some(FrameName::Identity) => Coordinates::Own,
                Some(FrameName::Target) => Coordinates::Frame,
                None => default.coordinates,
            },
            reference_volumes: self.volume_rule().unwrap_or(default.reference_volumes),
            grid_renewal: self.grid_renewal.map(StepCount::get),
            certificate: self.certificate.map_or(default.certificate, Switch::is_on),
            trace_every: self.trace_every,
            watch: self.watch(),
            ..default
        })
    }

    /// The watch, where a flag asks for one.
    fn watch(&self) -> Option<Watch> {
        let asked =
            self.monitor.is_some() || self.monitor_every.is_some() || self.patience.is_some() || self.best.is_some();
        let default = Watch::default();
        asked.then(|| Watch {
            monitor: self.monitor.unwrap_or_default().into(),
            every: self.monitor_every.map_or(default.every, StepCount::get),
            patience: self.patience.map(StepCount::get),
        })
    }

    /// α over the steps, where one is given.
    pub(crate) fn annealing(&self) -> Option<Annealing> {
        match (self.alpha, self.alpha_from, self.alpha_to) {
            (Some(alpha), _, _) => Some(Annealing::Constant { alpha }),
            (None, Some(from), Some(to)) => Some(match self.alpha_schedule {
                None | Some(AlphaSchedule::Geometric) => Annealing::Geometric { from, to },
                Some(AlphaSchedule::Linear) => Annealing::Linear { from, to },
                Some(AlphaSchedule::Cyclic) => Annealing::Cyclic {
                    from,
                    to,
                    cycles: self.alpha_cycles.map_or(4, StepCount::get),
                },
            }),
            _ => None,
        }
    }

    /// How reference volumes are found, where a word says it.
    pub(crate) fn volume_rule(&self) -> Option<ReferenceVolumes> {
        match self.volumes.as_deref()? {
            "uniform" => Some(ReferenceVolumes::Uniform),
            "start-density" => Some(ReferenceVolumes::OfStartDensity),
            "grid" => Some(ReferenceVolumes::OfGrid),
            _ => None,
        }
    }

    fn guards(&self, default: Guards) -> Guards {
        let base = match self.guards {
            Some(Switch::Off) => Guards::none(),
            Some(Switch::On) => Guards::default(),
            None => default,
        };
        Guards {
            mass_floor: self.mass_floor.unwrap_or(base.mass_floor),
            mass_weighted_force: self.mass_weighted_force.map_or(base.mass_weighted_force, Switch::is_on),
            courant: self.courant.map_or(base.courant, Limit::value),
            displacement_limit: self.displacement_limit.map_or(base.displacement_limit, Limit::value),
            stretch_limit: self.stretch_limit.map_or(base.stretch_limit, Limit::value),
        }
    }
}
