//! What a run says on standard output and standard error.

use super::Arguments;
use crate::console;
use crate::machine::PEAK_MEMORY_KEY;
use crate::sampling::{Outcome, Watched};

/// What a user should know before trusting the particles.
pub fn warn(outcome: &Outcome) {
    if outcome.scores_replaced > 0 {
        console::notice(&format!(
            "{} scores on the way were not finite; the particles were pulled back to where they are",
            outcome.scores_replaced
        ));
    }
    let Some(certificate) = &outcome.certificate else {
        return;
    };
    if let Some(reason) = certificate.outcome.reason() {
        console::notice(&format!("{}: {reason}", certificate.outcome.name()));
    }
}

/// What the certificate says.
fn certificate_pairs(outcome: &Outcome) -> Vec<(&'static str, String)> {
    let Some(certificate) = &outcome.certificate else {
        return Vec::new();
    };
    let numbers = [
        ("mean_error", certificate.mean_error()),
        ("sd_error", certificate.standard_deviation_error()),
        ("unexplained", certificate.unexplained()),
        ("drift", Some(certificate.drift)),
    ];
    let mut pairs = vec![("outcome", certificate.outcome.name().to_owned())];
    pairs.extend(certificate.outcome.reason().map(|reason| ("reason", reason)));
    pairs.extend(
        numbers
            .into_iter()
            .filter_map(|(key, value)| Some((key, value?.to_string()))),
    );
    pairs
}

/// What standard output says; a key without a value is left out.
pub fn pairs(arguments: &Arguments, outcome: &Outcome, peak_memory: Option<u64>) -> Vec<(&'static str, String)> {
    let mut pairs = vec![
        ("method", arguments.method.to_string()),
        ("steps", outcome.steps.to_string()),
        ("score_evaluations", outcome.score_evaluations.to_string()),
        ("density_evaluations", outcome.density_evaluations.to_string()),
    ];
    let judging = Some(outcome.judging_evaluations).filter(|&count| count > 0);
    let watched = |key: fn(&Watched) -> String| outcome.watched.as_ref().map(key);
    let optional = [
        ("judging_evaluations", text(judging)),
        ("log_evidence", text(outcome.log_evidence)),
        ("log_evidence_error", text(outcome.log_evidence_error)),
        ("score_disagreement", text(outcome.score_disagreement)),
        ("pareto_k", text(outcome.pareto_k)),
        ("unseen", text(outcome.unseen)),
        ("wall_seconds", Some(format!("{:.6}", outcome.wall_seconds))),
        ("best_step", watched(|seen| seen.best_step.to_string())),
        ("best_monitor", watched(|seen| seen.best_value.to_string())),
        ("last_monitor", watched(|seen| seen.last_value().to_string())),
        ("ended_early", watched(|seen| seen.ended.to_string())),
        ("residual", text(outcome.residual)),
        ("spacing", text(outcome.spacing)),
        ("active_nodes", text(outcome.active_nodes)),
        ("bodies", text(outcome.bodies)),
        ("storage_bytes", text(outcome.storage_bytes)),
        ("divergences", text(outcome.divergences)),
        (PEAK_MEMORY_KEY, text(peak_memory)),
    ];
    pairs.extend(optional.into_iter().filter_map(|(key, value)| Some((key, value?))));
    pairs.extend(certificate_pairs(outcome));
    pairs.extend([
        ("target", arguments.target.clone()),
        ("dim", outcome.particles.dimension().to_string()),
        ("particles", outcome.particles.len().to_string()),
        ("seed", arguments.seed.to_string()),
    ]);
    pairs
}

fn text<T: ToString>(value: Option<T>) -> Option<String> {
    value.map(|value| value.to_string())
}
