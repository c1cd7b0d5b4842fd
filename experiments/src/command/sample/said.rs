//! What a run says on standard output and standard error.

use parvi::Certificate;

use super::Arguments;
use crate::console::{self, Pair};
use crate::machine::PEAK_MEMORY_KEY;
use crate::options::{MethodName, Switch, is_among};
use crate::sampling::{Outcome, Watched};

/// What only moves of `mpm`'s particles depend on.
const OF_MOVES: &str = "basis coarse-start displacement-limit flip-share friction rotation score settling settling-shifts \
     shifts spacing spacing-range time-step transfer";

/// Says which of the options that were given did nothing, since the material has moved no particle.
fn warn_of_rest(arguments: &Arguments, outcome: &Outcome) {
    if arguments.method != MethodName::Mpm || outcome.steps > 0 {
        return;
    }
    let idle = arguments.options.given().filter(|(name, _)| is_among(OF_MOVES, name));
    let idle: Vec<String> = idle.map(|(name, _)| format!("--{name}")).collect();
    if !idle.is_empty() {
        let why = match arguments.options.weighted {
            Some(Switch::On) => "weighted particles are not moved",
            _ => {
                "the weighed evaluations served all particles, and none was moved; --steps or --rounds lets the material try"
            }
        };
        console::notice(&format!("{}: without effect: {why}", idle.join(", ")));
    }
}

/// What a user should know before trusting the particles.
pub fn warn(arguments: &Arguments, outcome: &Outcome) {
    warn_of_rest(arguments, outcome);
    if outcome.scores_replaced > 0 {
        let (count, remedy) = (
            outcome.scores_replaced,
            "the particles were pulled back to where they are",
        );
        console::notice(&format!("{count} scores on the way were not finite; {remedy}"));
    }
    let found = outcome.certificate.as_ref().map(|certificate| &certificate.outcome);
    if let Some((found, reason)) = found.and_then(|found| Some((found, found.reason()?))) {
        console::notice(&format!("{}: {reason}", found.name()));
    }
}

/// What standard output says.
pub fn pairs(arguments: &Arguments, outcome: &Outcome, peak_memory: Option<u64>) -> Vec<Pair> {
    let (certificate, seen) = (outcome.certificate.as_ref(), outcome.watched.as_ref());
    let found = certificate.map(|certificate| &certificate.outcome);
    let deviation = certificate.and_then(Certificate::standard_deviation_error);
    let judging = Some(outcome.judging_evaluations).filter(|&count| count > 0);
    vec![
        ("method", arguments.method.as_str().into()),
        ("steps", outcome.steps.into()),
        ("score_evaluations", outcome.score_evaluations.into()),
        ("density_evaluations", outcome.density_evaluations.into()),
        ("judging_evaluations", judging.into()),
        ("log_evidence", outcome.log_evidence.into()),
        ("log_evidence_error", outcome.log_evidence_error.into()),
        ("score_disagreement", outcome.score_disagreement.into()),
        ("pareto_k", outcome.pareto_k.into()),
        ("unseen", outcome.unseen.into()),
        ("wall_seconds", ((1e6 * outcome.wall_seconds).round() / 1e6).into()),
        ("best_step", seen.map(|seen| seen.best_step).into()),
        ("best_monitor", seen.map(|seen| seen.best_value).into()),
        ("last_monitor", seen.map(Watched::last_value).into()),
        ("ended_early", seen.map(|seen| seen.ended.to_string()).into()),
        ("residual", outcome.residual.into()),
        ("spacing", outcome.spacing.into()),
        ("active_nodes", outcome.active_nodes.into()),
        ("bodies", outcome.bodies.into()),
        ("storage_bytes", outcome.storage_bytes.into()),
        ("divergences", outcome.divergences.into()),
        (PEAK_MEMORY_KEY, peak_memory.into()),
        ("outcome", found.map(|found| found.name()).into()),
        ("reason", found.and_then(|found| found.reason()).into()),
        ("mean_error", certificate.and_then(Certificate::mean_error).into()),
        ("sd_error", deviation.into()),
        ("unexplained", certificate.and_then(Certificate::unexplained).into()),
        ("relative_energy_distance", outcome.relative_energy_distance.into()),
        ("drift", certificate.map(|certificate| certificate.drift).into()),
        ("target", arguments.target.as_str().into()),
        ("dim", outcome.particles.dimension().into()),
        ("particles", outcome.particles.len().into()),
        ("seed", arguments.seed.into()),
    ]
}
