//! A density that a program evaluates, as a target.

use std::sync::{Mutex, OnceLock, PoisonError};

use super::conversation::{Conversation, Question, asked, failed};
use crate::{CatalogueTarget, FiniteDifferenceScore, Frame, Target, TargetError};

/// A target in any language: a program that reads questions, a line each, and answers each with a line of numbers.
///
/// | question | answer |
/// |---|---|
/// | `density x1 … xD` | log p(x) up to a constant; `nan`, `inf` and `-inf` are numbers |
/// | `score x1 … xD` | ∂ log p/∂x1 … ∂ log p/∂xD, or an empty line by a program that has no gradient: central differences take its place ([`FiniteDifferenceScore`]) |
///
/// Numbers are decimal, with a space between them; answers may have commas. The program has to send every answer at once (flush its output) and to end when its input does; what it prints as errors is shown.
/// As many run side by side as there are threads, and which one is asked is left to chance, so the same question must have the same answer.
///
/// Where a program fails, every value from then on is NaN, and [`fault`](CatalogueTarget::fault) says how. It also ends the programs, the next question starts one anew, since only at the end it is
/// certain that a program has printed one line for every question: one too many is a failure, for it shifts all answers after it.
pub struct ProgramTarget<const D: usize> {
    command: String,
    /// Programs that are not being asked.
    idle: Mutex<Vec<Conversation>>,
    has_score: bool,
    fault: OnceLock<TargetError>,
}

impl<const D: usize> ProgramTarget<D> {
    /// Starts a program by a command line of the shell (`sh -c`, on Windows `cmd /C`), and asks it for both about the origin.
    ///
    /// # Errors
    /// [`TargetError::ProgramFailed`] if it does not start or does not answer.
    pub fn start(command: &str) -> Result<Self, TargetError> {
        if command.trim().is_empty() {
            return Err(failed(command, "is an empty command line".to_owned()));
        }
        let mut program = Conversation::begin(command)?;
        let origin = [0.0; D];
        if program.ask(Question::Density, &origin, D)?.is_none() {
            let question = asked(Question::Density, &origin);
            return Err(failed(command, format!("answers `{question}` with an empty line")));
        }
        let has_score = program.ask(Question::Score, &origin, D)?.is_some();
        Ok(Self {
            command: command.to_owned(),
            idle: Mutex::new(vec![program]),
            has_score,
            fault: OnceLock::new(),
        })
    }

    /// Whether the program has a gradient.
    pub fn has_score(&self) -> bool {
        self.has_score
    }

    /// The answers about points, NaN once something has failed.
    fn answers(&self, question: Question, xs: &[[f64; D]]) -> Vec<f64> {
        let asked = || {
            let idle = self.idle.lock().unwrap_or_else(PoisonError::into_inner).pop();
            let mut program = idle.map_or_else(|| Conversation::begin(&self.command), Ok)?;
            let answers = program.ask(question, xs.as_flattened(), D)?;
            self.idle.lock().unwrap_or_else(PoisonError::into_inner).push(program);
            answers.ok_or_else(|| {
                let question = asked(question, &xs[0]);
                let reason = format!("answers `{question}` with an empty line, which its first answer was not");
                failed(&self.command, reason)
            })
        };
        let nothing = || vec![f64::NAN; xs.len() * question.width(D)];
        if self.fault.get().is_some() {
            return nothing();
        }
        asked().unwrap_or_else(|fault| {
            // The first of several stays.
            let _ = self.fault.set(fault);
            nothing()
        })
    }
}

impl<const D: usize> Target<D> for ProgramTarget<D> {
    fn log_density(&self, x: &[f64; D]) -> f64 {
        self.answers(Question::Density, &[*x])[0]
    }

    fn score(&self, x: &[f64; D]) -> [f64; D] {
        let mut score = [[0.0; D]];
        self.scores(&[*x], &mut score);
        score[0]
    }

    /// A program may take long, and asking costs little.
    fn points_per_call(&self) -> usize {
        1
    }

    fn scores(&self, xs: &[[f64; D]], out: &mut [[f64; D]]) {
        if self.has_score {
            out.as_flattened_mut()
                .copy_from_slice(&self.answers(Question::Score, xs));
        } else {
            let differences = FiniteDifferenceScore::new(|x: &[f64; D]| self.log_density(x));
            for (x, score) in xs.iter().zip(out) {
                *score = differences.score(x);
            }
        }
    }

    fn log_densities(&self, xs: &[[f64; D]], out: &mut [f64]) {
        out.copy_from_slice(&self.answers(Question::Density, xs));
    }
}

impl<const D: usize> CatalogueTarget<D> for ProgramTarget<D> {
    fn name(&self) -> &str {
        "program"
    }

    /// Nothing is known of place and scale.
    fn frame(&self) -> Frame<D> {
        Frame::identity()
    }

    /// The whole space.
    fn domain(&self) -> [[f64; 2]; D] {
        [[f64::NEG_INFINITY, f64::INFINITY]; D]
    }

    fn fault(&self) -> Option<TargetError> {
        let idle = std::mem::take(&mut *self.idle.lock().unwrap_or_else(PoisonError::into_inner));
        for program in idle {
            if let Err(fault) = program.close() {
                let _ = self.fault.set(fault);
            }
        }
        self.fault.get().cloned()
    }
}
