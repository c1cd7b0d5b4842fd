//! Questions to a running program and its answers: a line each.

use std::fmt::Write as _;
use std::io::{self, BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};
use std::sync::mpsc;
use std::thread;
use std::time::{Duration, Instant};

use crate::TargetError;

/// Questions that are sent before their answers are read. What both sides have written and not yet read must fit into the system's pipes: a program that cannot write does not read.
const AHEAD: usize = 32;

/// How long a program may take to end after its input has.
const GRACE: Duration = Duration::from_secs(2);
const LOOK: Duration = Duration::from_millis(5);

/// Letters of a line that an error repeats.
const SHOWN: usize = 80;

/// What a program is asked about a point.
#[derive(Clone, Copy)]
pub(super) enum Question {
    Density,
    Score,
}

/// A program that runs.
pub(super) struct Conversation {
    command: String,
    child: Child,
    /// Until the end, which tells the program to end as well.
    input: Option<ChildStdin>,
    /// Until what is left in it is read.
    output: Option<BufReader<ChildStdout>>,
    sent: String,
    line: String,
}

impl Question {
    fn word(self) -> &'static str {
        match self {
            Self::Density => "density",
            Self::Score => "score",
        }
    }

    /// Numbers of an answer in so many dimensions.
    pub fn width(self, dimension: usize) -> usize {
        match self {
            Self::Density => 1,
            Self::Score => dimension,
        }
    }
}

impl Conversation {
    /// Starts a program by a command line of the shell.
    pub fn begin(command: &str) -> Result<Self, TargetError> {
        let unstarted = |error: io::Error| failed(command, format!("does not start: {error}"));
        let mut child = shell(command)
            // What Python prints is to arrive when it is printed.
            .env("PYTHONUNBUFFERED", "1")
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()
            .map_err(unstarted)?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(unstarted(io::ErrorKind::BrokenPipe.into()));
        };
        Ok(Self {
            command: command.to_owned(),
            child,
            input: Some(input),
            output: Some(BufReader::new(output)),
            sent: String::new(),
            line: String::new(),
        })
    }

    /// The answers to a question about points of so many `coordinates` in all, one after the other; `None` where the answer to the first is an empty line.
    pub fn ask(
        &mut self,
        question: Question,
        coordinates: &[f64],
        dimension: usize,
    ) -> Result<Option<Vec<f64>>, TargetError> {
        let width = question.width(dimension);
        let mut answers = Vec::with_capacity(coordinates.len() / dimension * width);
        for points in coordinates.chunks(AHEAD * dimension) {
            self.has_said_no_more()?;
            let points = points.chunks_exact(dimension);
            self.sent.clear();
            points.clone().for_each(|x| write_question(&mut self.sent, question, x));
            // A program that has ended is found out by its silence.
            if let Some(input) = &mut self.input {
                let _ = input.write_all(self.sent.as_bytes()).and_then(|()| input.flush());
            }
            for x in points {
                let before = answers.len();
                self.read(question, x, &mut answers)?;
                match answers.len() - before {
                    0 if before == 0 => return Ok(None),
                    found if found == width => {}
                    found => {
                        let numbers = if found == 1 { "number" } else { "numbers" };
                        let what = format!("{found} {numbers}, not {width}");
                        return Err(self.misunderstood(question, x, &what));
                    }
                }
            }
        }
        Ok(Some(answers))
    }

    /// The numbers of the next line.
    fn read(&mut self, question: Question, x: &[f64], numbers: &mut Vec<f64>) -> Result<(), TargetError> {
        self.line.clear();
        let output = self.output.as_mut();
        match output.map_or(Ok(0), |output| output.read_line(&mut self.line)) {
            Ok(length) if length > 0 => {}
            Ok(_) => return Err(self.silent(question, x)),
            Err(error) => return Err(self.misunderstood(question, x, &format!("what cannot be read ({error})"))),
        }
        for word in self.line.split([' ', '\t', ',']).map(str::trim) {
            if word.is_empty() {
                continue;
            }
            match word.parse() {
                Ok(number) => numbers.push(number),
                Err(_) => {
                    let what = format!("'{word}', which is not a number");
                    return Err(self.misunderstood(question, x, &what));
                }
            }
        }
        Ok(())
    }

    /// Refuses what has come with answers and is none: it would be taken for the answer to the next question, and that for the one after. What the program has not sent yet, or what was
    /// not read with an answer, is found later, at the [end](Self::close).
    fn has_said_no_more(&self) -> Result<(), TargetError> {
        let left = self.output.as_ref().map_or(&[][..], BufReader::buffer);
        if left.is_empty() {
            return Ok(());
        }
        Err(self.said_too_much(left))
    }

    fn said_too_much(&self, left: &[u8]) -> TargetError {
        let line = left.split(|&byte| byte == b'\n').next().unwrap_or_default();
        let line: String = String::from_utf8_lossy(line).trim().chars().take(SHOWN).collect();
        let reason = format!("prints '{line}' beside its answers, which are one line for every question");
        failed(&self.command, reason)
    }

    /// Ends the program. What it has printed and nobody has read is an error.
    pub fn close(mut self) -> Result<(), TargetError> {
        let Some(mut output) = self.output.take() else {
            return Ok(());
        };
        drop(self.input.take());
        // What the program has started may keep its output open.
        let (sender, receiver) = mpsc::channel();
        thread::spawn(move || {
            let mut line = Vec::new();
            let _ = output.read_until(b'\n', &mut line);
            let _ = sender.send(line);
        });
        self.end();
        match receiver.recv_timeout(GRACE) {
            Ok(line) if !line.is_empty() => Err(self.said_too_much(&line)),
            _ => Ok(()),
        }
    }

    fn misunderstood(&self, question: Question, x: &[f64], what: &str) -> TargetError {
        failed(&self.command, format!("answers `{}` with {what}", asked(question, x)))
    }

    /// The program's output has ended.
    fn silent(&mut self, question: Question, x: &[f64]) -> TargetError {
        let ending = self.end().map_or_else(String::new, |status| format!(" ({status})"));
        failed(
            &self.command,
            format!("ended{ending} without an answer to `{}`", asked(question, x)),
        )
    }

    /// Ends the program: its input first, and if that does not help, the program.
    fn end(&mut self) -> Option<std::process::ExitStatus> {
        drop(self.input.take());
        let begin = Instant::now();
        while begin.elapsed() < GRACE {
            if let Ok(Some(status)) = self.child.try_wait() {
                return Some(status);
            }
            std::thread::sleep(LOOK);
        }
        end_group(&self.child);
        self.child.kill().ok()?;
        self.child.wait().ok()
    }
}

impl Drop for Conversation {
    fn drop(&mut self) {
        self.end();
    }
}

/// The system's shell with a command line. An interruption from the keyboard is not the program's: whoever asks, and ends the conversation, gets it.
fn shell(command: &str) -> Command {
    #[cfg(unix)]
    {
        use std::os::unix::process::CommandExt;
        let mut shell = Command::new("sh");
        shell.arg("-c").arg(command).process_group(0);
        shell
    }
    #[cfg(not(unix))]
    {
        let mut shell = Command::new("cmd");
        shell.arg("/C").arg(command);
        shell
    }
}

/// Ends what the shell has started: the program itself, where the command line is more than one program.
fn end_group(shell: &Child) {
    #[cfg(unix)]
    {
        let line = format!("kill -KILL -{}", shell.id());
        let kill = Command::new("sh").arg("-c").arg(line).stderr(Stdio::null()).status();
        // Where that fails the shell is ended alone.
        let _ = kill;
    }
    #[cfg(not(unix))]
    let _ = shell;
}

/// A word and the coordinates, with as many digits as they have, and the end of the line.
fn write_question(text: &mut String, question: Question, x: &[f64]) {
    text.push_str(question.word());
    for coordinate in x {
        // Into a string, which takes everything.
        let _ = write!(text, " {coordinate:e}");
    }
    text.push('\n');
}

/// A question as it was asked.
pub(super) fn asked(question: Question, x: &[f64]) -> String {
    let mut text = String::new();
    write_question(&mut text, question, x);
    text.trim_end().to_owned()
}

/// The error that a program is none to ask.
pub(super) fn failed(command: &str, reason: String) -> TargetError {
    TargetError::ProgramFailed {
        command: command.to_owned(),
        reason,
    }
}
