//! Checkpoints: a run that was killed goes on to the same bits.

mod saved;

use std::fs::{self, File};
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::sync::PoisonError;

use parvi_targets::{Frame, Target};
use serde::{Deserialize, Serialize};

use self::saved::{SavedBody, SavedState};
use crate::cached_scores::Tape;
use crate::driven::Driven;
use crate::guard::{INTERVAL, State};
use crate::start::check;
use crate::{MpmOptions, Run, SampleError};

/// Where a run of the calibrated sampler leaves its state.
///
/// If the file exists when a run of the same target, options and seed begins, the run goes on from it, and its particles are the same to the bit as those
/// of a run that was never stopped. The file is replaced as a whole, so that a process killed at any moment leaves a good one. That of a run which has
/// succeeded stays, so that particles which are lost before they are written can be had again: [`remove`](Self::remove) it when they are safe.
/// A score that depends on earlier calls (minibatches) is beyond it.
///
/// The file of another run is refused. A target is known by log p and its score at three points, and by some values of it that the file holds: up to 32 log densities and 32 scores that a survey or a cache asked for
/// are evaluated again, and have to be the same to the bit. No run counts these among its evaluations.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Checkpoint {
    /// The file.
    pub path: PathBuf,
    /// It is written every so many steps, rounded up to a multiple of 8; ≥ 1. In a survey after every round, and every five seconds where evaluations take long.
    pub every: usize,
}

impl Checkpoint {
    /// Removes the file, if it is there.
    ///
    /// # Errors
    /// [`SampleError::Checkpoint`] for a file that cannot be removed.
    pub fn remove(&self) -> Result<(), SampleError> {
        match fs::remove_file(&self.path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(refused(&self.path, &error)),
            _ => Ok(()),
        }
    }
}

/// What the file holds. What leads to the bodies is computed again, from the values on the tape where there is a survey.
#[derive(Default, Serialize, Deserialize)]
struct Saved {
    /// What the run was asked for.
    identity: String,
    /// Values of the target that the survey asked for, in their order, or places and cached scores.
    tape: Vec<f64>,
    /// All bodies that have come to their end so far.
    finished: Vec<SavedBody>,
    /// The state of the one that moves.
    moving: Option<SavedState>,
}

/// The states of a run on their way to and from its checkpoint; without one, by default, it does nothing.
#[derive(Default)]
pub(crate) struct Journal {
    checkpoint: Option<Checkpoint>,
    saved: Saved,
    /// A tape that grows elsewhere.
    evaluations: Option<Tape>,
    /// Bodies that came to their end in this process or an earlier one and were asked for.
    replayed: usize,
}

impl Journal {
    /// The journal of a run, with what an earlier process left in its file.
    pub fn open<const D: usize>(
        options: &MpmOptions,
        target: &dyn Target<D>,
        frame: &Frame<D>,
        run: &Run,
    ) -> Result<Self, SampleError> {
        let Some(checkpoint) = &options.checkpoint else {
            return Ok(Self::default());
        };
        let (every, traced) = (checkpoint.every, options.trace_every);
        check("steps between checkpoints", every as f64, every > 0, "at least 1")?;
        let of_history = "steps between records of the history";
        check(of_history, traced as f64, traced == 0, "0 beside a checkpoint")?;
        let identity = identity(options, target, frame, run);
        let path = &checkpoint.path;
        let saved = match File::open(path) {
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => Saved {
                identity,
                ..Saved::default()
            },
            Err(error) => return Err(refused(path, &error)),
            Ok(file) => {
                let saved = read(file).map_err(|reason| refused(path, &reason))?;
                if saved.identity != identity {
                    return Err(of_another_run(path));
                }
                saved
            }
        };
        Ok(Self {
            checkpoint: Some(checkpoint.clone()),
            saved,
            ..Self::default()
        })
    }

    /// The error that what its file holds is not of this target.
    pub fn of_another_target(&self) -> SampleError {
        of_another_run(
            self.checkpoint
                .as_ref()
                .map_or(Path::new(""), |checkpoint| &checkpoint.path),
        )
    }

    /// What a survey evaluated before.
    pub fn tape(&self) -> Vec<f64> {
        self.saved.tape.clone()
    }

    /// From now on the tape is this one, whenever anything is kept.
    pub fn keep_evaluations(&mut self, tape: Tape) {
        self.evaluations = Some(tape);
    }

    /// What a survey has evaluated so far.
    pub fn keep_tape(&mut self, tape: &[f64]) -> Result<(), SampleError> {
        if self.checkpoint.is_some() && tape.len() > self.saved.tape.len() {
            self.saved.tape = tape.to_vec();
            self.write()?;
        }
        Ok(())
    }

    /// The next body of the run, if it came to its end before.
    pub fn finished<const D: usize>(&mut self) -> Option<Driven<D>> {
        let body = self.saved.finished.get(self.replayed)?;
        self.replayed += 1;
        Some(body.into())
    }

    /// The state that the next body of the run was left in.
    pub fn moving<const D: usize>(&mut self) -> Result<Option<State<D>>, SampleError> {
        let saved = self.saved.moving.take();
        let state = saved.map(State::try_from).transpose();
        state.map_err(|error| match &self.checkpoint {
            Some(checkpoint) => refused(&checkpoint.path, &error),
            None => SampleError::in_step(0, error),
        })
    }

    /// A state from which the run can go on.
    pub fn keep<const D: usize>(&mut self, state: &State<D>) -> Result<(), SampleError> {
        let Some(checkpoint) = &self.checkpoint else {
            return Ok(());
        };
        let every = checkpoint
            .every
            .checked_next_multiple_of(INTERVAL)
            .unwrap_or(checkpoint.every);
        if state.step > 1 && (state.step - 1).is_multiple_of(every) {
            self.saved.moving = Some(state.into());
            self.write()?;
        }
        Ok(())
    }

    /// A body has come to its end.
    pub fn finish<const D: usize>(&mut self, body: &Driven<D>) -> Result<(), SampleError> {
        if self.checkpoint.is_some() {
            self.saved.moving = None;
            self.saved.finished.push(body.into());
            self.replayed += 1;
            self.write()?;
        }
        Ok(())
    }

    /// Replace the file as a whole.
    fn write(&mut self) -> Result<(), SampleError> {
        if let Some(tape) = &self.evaluations {
            self.saved
                .tape
                .clone_from(&tape.lock().unwrap_or_else(PoisonError::into_inner));
        }
        let Some(Checkpoint { path, .. }) = &self.checkpoint else {
            return Ok(());
        };
        let mut part = path.clone().into_os_string();
        part.push(".part");
        let part = PathBuf::from(part);
        let content = cbor4ii::serde::to_vec(Vec::new(), &self.saved).map_err(|error| refused(path, &error))?;
        let replaced = File::create(&part).and_then(|mut file| {
            file.write_all(MAGIC)?;
            file.write_all(&checksum(&content).to_le_bytes())?;
            file.write_all(&content)?;
            file.sync_all()?;
            fs::rename(&part, path)
        });
        replaced.map_err(|error| {
            let _ = fs::remove_file(&part);
            refused(path, &error)
        })
    }
}

/// What a checkpoint begins with; its checksum and content follow.
const MAGIC: &[u8] = b"parvi checkpoint 2\n";

/// The content of a file, if it is a whole one.
fn read(mut file: File) -> Result<Saved, String> {
    let mut bytes = Vec::new();
    file.read_to_end(&mut bytes).map_err(|error| error.to_string())?;
    let damaged = || "it is damaged or no checkpoint; remove it or name another file".to_owned();
    let rest = bytes.strip_prefix(MAGIC).ok_or_else(damaged)?;
    let (sum, content) = rest.split_first_chunk().ok_or_else(damaged)?;
    if u64::from_le_bytes(*sum) != checksum(content) {
        return Err(damaged());
    }
    cbor4ii::serde::from_slice(content).map_err(|_| damaged())
}

/// FNV-1a (G. Fowler, L. C. Noll, K.-P. Vo), 64 bits.
fn checksum(content: &[u8]) -> u64 {
    let start = 0xcbf2_9ce4_8422_2325;
    content.iter().fold(start, |hash, &byte| {
        (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3)
    })
}

fn of_another_run(path: &Path) -> SampleError {
    refused(path, &"it belongs to another run; remove it or name another file")
}

fn refused(path: &Path, reason: &dyn std::fmt::Display) -> SampleError {
    SampleError::Checkpoint {
        path: path.to_owned(),
        reason: reason.to_string(),
    }
}

/// Everything that the particles depend on; the target by what it says at a few points, of its score where other calls do not change that.
fn identity<const D: usize>(options: &MpmOptions, target: &dyn Target<D>, frame: &Frame<D>, run: &Run) -> String {
    let options = MpmOptions {
        checkpoint: None,
        ..options.clone()
    };
    let probe = |offset: f64| {
        let z = std::array::from_fn(|a| offset / (1.0 + a as f64));
        let x = frame.to_target(&z);
        let log_density = target.has_log_density().then(|| target.log_density(&x).to_bits());
        let score = (!target.scores_depend_on_calls()).then(|| target.score(&x).map(f64::to_bits));
        (log_density, score)
    };
    format!(
        "parvi {}, D = {D}, {options:?}, {run:?}, {frame:?}, log densities and scores {:x?}",
        env!("CARGO_PKG_VERSION"),
        [0.0, 0.5, -1.0].map(probe)
    )
}
