//! `mpm`: the calibrated gas, on a lattice or a grid and on a mesh.

use parvi::{MeshOptions, Method, MpmOptions, OnMesh, Settling, SpacingSchedule, TransferChoice};

use super::{MethodKind, is_among};
use crate::{Basis, EvaluationCount, Limit, MethodOptions, OptionError, RoundCount, Switch, Transfer};

/// The method.
pub const KIND: MethodKind = MethodKind {
    name: "mpm",
    options: "steps basis mesh spacing time-step score displacement-limit survey evaluations search-effort shifts rotation spacing-range coarse-start \
        settling settling-shifts moment-correction transfer flip-share friction rounds weighted non-finite certificate alpha \
        alpha-from alpha-to alpha-schedule alpha-cycles pool start start-law start-centre start-covariance start-mean start-sd \
        start-draws",
    iterates: true,
    build: |options, steps| {
        Ok(match options.basis {
            Some(Basis::Mesh) => Method::OnMesh(options.on_mesh(steps)?),
            _ => Method::Mpm(options.mpm(steps)),
        })
    },
};

/// What the sampler on a mesh knows.
const ON_MESH: &str =
    "basis mesh steps time-step friction shifts settling settling-shifts non-finite displacement-limit";

impl MethodOptions {
    /// The calibrated gas.
    fn mpm(&self, steps: Option<usize>) -> MpmOptions {
        let default = MpmOptions::default();
        let transfer = match self.transfer {
            None => default.transfer,
            Some(Transfer::Pic) => TransferChoice::Pic,
            Some(Transfer::Apic) => TransferChoice::Apic,
            Some(Transfer::Flip) => TransferChoice::Flip(self.flip_share.unwrap_or(0.95)),
            Some(Transfer::AffineFlip) => TransferChoice::AffineFlip(self.flip_share.unwrap_or(0.95)),
        };
        MpmOptions {
            basis: self.basis.and_then(Basis::uniform).unwrap_or(default.basis),
            transfer,
            spacing: self.spacing.or(default.spacing),
            steps: steps.or(default.steps),
            time_step: self.time_step.or(default.time_step),
            friction: self.friction.or(default.friction),
            survey: self.survey.map_or(default.survey, Switch::is_on),
            evaluations: self.evaluations(),
            search_effort: self.search_effort.unwrap_or(default.search_effort),
            shifts: self.shifts.map_or(default.shifts, Switch::is_on),
            rotation: self.rotation.map_or(default.rotation, Switch::is_on),
            spacing_schedule: SpacingSchedule {
                range: self.spacing_range.unwrap_or(default.spacing_schedule.range),
                coarse_start: self.coarse_start.unwrap_or(default.spacing_schedule.coarse_start),
                ..default.spacing_schedule
            },
            settling: self.settling(default.settling),
            moment_correction: self.moment_correction.map_or(default.moment_correction, Into::into),
            score_location: self.score.map_or(default.score_location, Into::into),
            displacement_limit: self.displacement_limit_of_gas(default.displacement_limit),
            rounds: self.rounds.map(RoundCount::get).or(default.rounds),
            non_finite_scores: self.non_finite.map_or(default.non_finite_scores, Into::into),
            annealing: self.annealing().unwrap_or(default.annealing),
            certificate: self.certificate.map_or(default.certificate, Switch::is_on),
            checkpoint: default.checkpoint,
            weighted: self.weighted.map_or(default.weighted, Switch::is_on),
            trace_every: self.trace_every,
        }
    }

    /// The calibrated gas within a mesh.
    fn on_mesh(&self, steps: Option<usize>) -> Result<OnMesh, OptionError> {
        let default = MeshOptions::default();
        if let Some((name, value)) = self.given().find(|(name, _)| !is_among(ON_MESH, name)) {
            return Err(OptionError::foreign(&name, &value, "mpm on a mesh", ON_MESH));
        }
        let options = MeshOptions {
            steps: steps.or(default.steps),
            time_step: self.time_step.or(default.time_step),
            friction: self.friction.or(default.friction),
            shifts: self.shifts.map_or(default.shifts, Switch::is_on),
            settling: self.settling(default.settling),
            non_finite_scores: self.non_finite.map_or(default.non_finite_scores, Into::into),
            displacement_limit: self.displacement_limit_of_gas(default.displacement_limit),
            trace_every: self.trace_every,
        };
        let file = self.mesh.clone().unwrap_or_default().into();
        Ok(OnMesh { file, options })
    }

    /// Evaluations of a survey, at most.
    pub(crate) fn evaluations(&self) -> Option<u64> {
        self.evaluations.map(EvaluationCount::get).map(|count| count as u64)
    }

    /// Whether the calibrated sampler surveys: it does not for p^α.
    pub(crate) fn surveys(&self) -> bool {
        let whole = self.annealing().is_none_or(|alpha| alpha.last() == 1.0);
        self.survey != Some(Switch::Off) && whole
    }

    fn settling(&self, default: Settling) -> Settling {
        Settling {
            share: self.settling.unwrap_or(default.share),
            shifts: self.settling_shifts.map_or(default.shifts, Switch::is_on),
            ..default
        }
    }

    fn displacement_limit_of_gas(&self, default: f64) -> f64 {
        self.displacement_limit.and_then(Limit::value).unwrap_or(default)
    }
}
