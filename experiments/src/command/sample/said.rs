//! What a run says on standard output and standard error.

use parvi::Certificate;
use parvi_files::{Outcome, Watched};
use parvi_options::{Basis, MethodName, Switch, is_among};

use super::Arguments;
use crate::console::{self, Pair};
use crate::machine::PEAK_MEMORY_KEY;

/// What only moves of `mpm`'s particles depend on.
const OF_MOVES: &str = "basis coarse-start displacement-limit flip-share friction rotation score settling settling-shifts \
     shifts spacing spacing-range time-step transfer";

/// Says which of the options that were given did nothing, since the material has moved no particle.
fn warn_of_rest(arguments: &Arguments, outcome: &Outcome) {
    if arguments.method != MethodName::Mpm || outcome.steps > 0 {
        return;
    }
    let has_rounds = arguments.options.rounds.is_none_or(|rounds| rounds.get() > 0);
    let is_weighted = arguments.options.weighted == Some(Switch::On);
    // Scores at particles that rounds may move have a residual.
    let is_doubtful = has_rounds && outcome.residual.is_none();
    let why = match arguments.options.weighted {
        Some(Switch::On) => "weighted particles are not moved",
        _ if !has_rounds => "none is moved with --rounds 0",
        _ if is_doubtful => {
            "none is moved where log p is noise or may have no finite integral, or the score is not its gradient"
        }
        _ => {
            "the weighed evaluations served all particles, and none was moved; --steps or --rounds lets the material try"
        }
    };
    let is_idle = |name: &str| match name {
        "steps" | "moment-correction" => is_weighted || is_doubtful || !has_rounds,
        "rounds" => (is_weighted || is_doubtful) && has_rounds,
        name => is_among(OF_MOVES, name),
    };
    notice_idle(arguments, is_idle, why);
}

/// Says which of the options that were given do nothing beside others, in a run that moves particles.
fn warn_of_idle(arguments: &Arguments, outcome: &Outcome) {
    let options = &arguments.options;
    if arguments.method != MethodName::Mpm || outcome.steps == 0 {
        return;
    }
    let keeps_still = options.shifts == Some(Switch::Off);
    let is_lattice = matches!(options.basis, None | Some(Basis::Lattice));
    for (names, is_idle, why) in [
        (
            "rotation settling-shifts spacing-range",
            keeps_still,
            "the basis keeps still with --shifts off",
        ),
        ("rotation", !keeps_still && !is_lattice, "only the lattice is turned"),
        (
            "settling-shifts",
            !keeps_still && options.settling == Some(0.0),
            "nothing settles with --settling 0",
        ),
    ] {
        if is_idle {
            notice_idle(arguments, |name| is_among(names, name), why);
        }
    }
}

/// Names those of the options that were given.
fn notice_idle(arguments: &Arguments, is_idle: impl Fn(&str) -> bool, why: &str) {
    let idle = arguments.options.given().filter(|(name, _)| is_idle(name));
    let idle: Vec<String> = idle.map(|(name, _)| format!("--{name}")).collect();
    if !idle.is_empty() {
        console::notice(&format!("{}: without effect: {why}", idle.join(", ")));
    }
}

/// Says how many scores were not finite, and what was done about them.
fn warn_of_scores(outcome: &Outcome) {
    let (where_found, remedy) = match outcome.steps {
        0 => (
            "at the particles",
            "residual and moments by scores count a pull towards the centre of the frame in their place",
        ),
        _ => ("on the way", "the particles were pulled back to where they are"),
    };
    if outcome.scores_replaced > 0 {
        let count = outcome.scores_replaced;
        console::notice(&format!("scores that were not finite {where_found}: {count}; {remedy}"));
    }
}

/// What a user should know before trusting the particles, whose coordinates have these names, or none.
pub fn warn(arguments: &Arguments, outcome: &Outcome, names: &[String]) {
    warn_of_rest(arguments, outcome);
    warn_of_idle(arguments, outcome);
    warn_of_scores(outcome);
    let found = outcome.certificate.as_ref().map(|certificate| &certificate.outcome);
    if let Some((found, reason)) = found.and_then(|found| Some((found, found.reason_naming(names)?))) {
        console::notice(&format!("{}: {reason}", found.name()));
    }
}

/// What standard output says.
pub fn pairs(arguments: &Arguments, outcome: &Outcome, names: &[String], peak_memory: Option<u64>) -> Vec<Pair> {
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
        ("reason", found.and_then(|found| found.reason_naming(names)).into()),
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
