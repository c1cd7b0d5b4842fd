//! The history of a run as files: frames of the particles on their way, and of what was returned.

mod frame;
mod index;

use std::ops::ControlFlow;

use parvi::{Observer, ParticleView};

use self::frame::{Frame, Stamp};
use self::index::Entry;
use super::{AtomicFile, FileError, OutputDirectory, Particles};

/// Names of the files.
pub mod names {
    /// The table of the frames.
    pub const TABLE: &str = "frames.csv";
    /// The collection for ParaView.
    pub const COLLECTION: &str = "frames.pvd";
    /// The frame of what the run returned.
    pub const RETURNED: &str = "returned";
    /// What arrays of frames are called.
    pub const ARRAYS: [&str; 4] = ["positions", "velocities", "deformation_gradients", "weights"];

    /// The frame after so many steps.
    pub fn frame(step: usize) -> String {
        format!("{step:06}")
    }

    /// The VTK file of a frame.
    pub fn vtp(frame: &str) -> String {
        format!("frame_{frame}.vtp")
    }

    /// An array of a frame.
    pub fn npy(array: &str, frame: &str) -> String {
        format!("{array}_{frame}.npy")
    }

    /// Whether a file is one of a frame.
    pub fn is_of_frame(name: &str) -> bool {
        let stem = |prefix: &str, suffix: &str| name.strip_prefix(prefix)?.strip_prefix('_')?.strip_suffix(suffix);
        let array = ARRAYS.iter().find_map(|array| stem(array, ".npy"));
        let is_frame = |stem: &str| stem == RETURNED || stem.parse().is_ok_and(|step| frame(step) == stem);
        array.or_else(|| stem("frame", ".vtp")).is_some_and(is_frame)
    }
}

/// Writes frames while it observes a run.
pub struct FrameWriter {
    directory: OutputDirectory,
    every: usize,
    /// Names of the coordinates, where they have some.
    coordinates: Vec<String>,
    /// Whether the run goes on from a checkpoint, so that earlier frames are its own.
    goes_on: bool,
    /// Told what a user should know.
    notice: fn(&str),
    /// Whether the first particles have been seen.
    begun: bool,
    entries: Vec<Entry>,
    failure: Option<FileError>,
}

impl FrameWriter {
    /// A frame of every step whose number is a multiple of `every`, that of the start among them. Frames of an earlier run are removed, unless the run `goes_on` from its checkpoint; where that run has
    /// left none, `notice` is told.
    ///
    /// # Errors
    /// [`FileError::System`] where earlier frames cannot be removed.
    pub fn new(
        directory: OutputDirectory,
        every: usize,
        coordinates: Vec<String>,
        goes_on: bool,
        notice: fn(&str),
    ) -> Result<Self, FileError> {
        let writer = Self {
            directory,
            every,
            coordinates,
            goes_on,
            notice,
            begun: false,
            entries: Vec::new(),
            failure: None,
        };
        if !goes_on {
            writer.remove_earlier()?;
        }
        Ok(writer)
    }

    /// Writes what the run returned as the last frame; returns the number of frames.
    ///
    /// # Errors
    /// [`FileError::System`].
    pub fn finish(mut self, returned: &Particles, steps: usize) -> Result<usize, FileError> {
        if !self.begun && self.goes_on {
            // The run came to its end before; only what it returned is missing.
            self.entries = index::read(&self.directory.path)?.unwrap_or_default();
        }
        let stamp = Stamp {
            time: index::time_of_returned(&self.entries),
            step: steps,
            of_body: None,
        };
        self.write(names::RETURNED, &Frame::from(returned), stamp)?;
        Ok(self.entries.len())
    }

    /// Why the run was stopped, if it was stopped here.
    pub fn failure(&mut self) -> Option<FileError> {
        self.failure.take()
    }

    /// Looks at particles and writes those that are due.
    fn look(&mut self, view: &ParticleView<'_>) -> Result<(), FileError> {
        let step = view.earlier_steps + view.step;
        if !self.begun {
            self.begun = true;
            self.begin(step)?;
        }
        // Every body but the first begins where the one before has come to its end, which has a frame of its own.
        let begins_anew = view.step == 0 && view.body > 0;
        let void = if begins_anew { step + 1 } else { step };
        self.drop_from(void)?;
        if begins_anew || !step.is_multiple_of(self.every) {
            return Ok(());
        }
        let stamp = Stamp {
            time: step as f64,
            step,
            of_body: Some((view.body, view.time)),
        };
        self.write(&names::frame(step), &Frame::from(view), stamp)
    }

    /// Before the first particles, which have made so many steps.
    fn begin(&mut self, step: usize) -> Result<(), FileError> {
        if step == 0 {
            return if self.goes_on { self.remove_earlier() } else { Ok(()) };
        }
        let directory = self.directory.path.display().to_string();
        match index::read(&self.directory.path)? {
            Some(entries) => self.entries = entries,
            None => (self.notice)(&format!(
                "{directory}: the run goes on from step {step}, and there are no frames of the steps before it"
            )),
        }
        Ok(())
    }

    /// Removes frames of this step and later ones: the run went back.
    fn drop_from(&mut self, step: usize) -> Result<(), FileError> {
        let kept = self.entries.partition_point(|entry| entry.step < step);
        if kept == self.entries.len() {
            return Ok(());
        }
        let void = self.entries.split_off(kept);
        index::write(&self.directory.path, &self.entries)?;
        for entry in void {
            for array in names::ARRAYS {
                self.directory.remove(&names::npy(array, &entry.frame))?;
            }
            self.directory.remove(&names::vtp(&entry.frame))?;
        }
        Ok(())
    }

    /// The files of a frame, then the tables that name it.
    fn write(&mut self, name: &str, frame: &Frame, stamp: Stamp) -> Result<(), FileError> {
        let refused = |error| FileError::system("write", self.directory.file(name), error);
        for (array, content) in frame.arrays().map_err(refused)? {
            AtomicFile::write(self.directory.file(&names::npy(array, name)), content)?;
        }
        let vtp = frame.vtp(&stamp, &self.coordinates);
        AtomicFile::write(self.directory.file(&names::vtp(name)), vtp)?;
        self.entries.push(Entry {
            frame: name.to_owned(),
            step: stamp.step,
            body: stamp.of_body.map(|(body, _)| body),
            pseudo_time: stamp.of_body.map(|(_, time)| time),
        });
        index::write(&self.directory.path, &self.entries)
    }

    /// Removes all frames and their tables, and nothing else.
    fn remove_earlier(&self) -> Result<(), FileError> {
        let directory = &self.directory.path;
        let refused = |error| FileError::system("read", directory, error);
        for entry in std::fs::read_dir(directory).map_err(refused)? {
            let name = entry.map_err(refused)?.file_name();
            if let Some(name) = name.to_str()
                && ([names::TABLE, names::COLLECTION].contains(&name) || names::is_of_frame(name))
            {
                self.directory.remove(name)?;
            }
        }
        Ok(())
    }
}

impl Observer for FrameWriter {
    fn see(&mut self, view: &ParticleView<'_>) -> ControlFlow<()> {
        match self.look(view) {
            Ok(()) => ControlFlow::Continue(()),
            Err(error) => {
                self.failure = Some(error);
                ControlFlow::Break(())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::names::is_of_frame;

    #[test]
    fn only_names_of_frames_are_taken_for_such() {
        for name in [
            "frame_000030.vtp",
            "frame_returned.vtp",
            "positions_1234567.npy",
            "weights_returned.npy",
        ] {
            assert!(is_of_frame(name), "{name}");
        }
        for name in [
            "frame_30.vtp",
            "frame_000030.vtp.bak",
            "frame_mine.vtp",
            "positions_.npy",
            "positions_+00030.npy",
            "my_positions_000030.npy",
        ] {
            assert!(!is_of_frame(name), "{name}");
        }
    }
}
