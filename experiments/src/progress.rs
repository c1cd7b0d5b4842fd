//! Progress bars with the time left, on standard error; where that is no terminal, a plain line now and then.

use std::ops::ControlFlow;
use std::time::{Duration, Instant};

use indicatif::{ProgressBar, ProgressStyle};
use parvi::{Observer, Progress};

use crate::{console, interrupt};

/// Units of a bar that shows shares of something.
const UNITS: f64 = 1e6;

/// Whether a run should go on.
pub(crate) fn unless_interrupted() -> ControlFlow<()> {
    if interrupt::requested() {
        ControlFlow::Break(())
    } else {
        ControlFlow::Continue(())
    }
}

/// A bar that appears with the first thing done, from which on the time left is told; that of a study is there at once.
pub struct Bar {
    bar: ProgressBar,
    begun: bool,
    /// The cost of a whole study; what is done of it, and that of the case at hand.
    study: Option<(f64, f64, f64)>,
    /// The case at hand of a study.
    case: String,
    /// What stands in for the bar where there is no terminal.
    lines: Option<Lines>,
}

/// When a line is due where nobody sees a bar: after so much more of the whole and so long since the last one, so that short runs say nothing and long ones ten lines at most.
struct Lines {
    start: Instant,
    last: Instant,
    share: f64,
}

/// The share of the whole, and the time, from one line to the next, at least.
const LINE_SHARE: f64 = 0.1;
const LINE_TIME: Duration = Duration::from_secs(30);

impl Lines {
    fn begin(now: Instant) -> Self {
        Self {
            start: now,
            last: now,
            share: 0.0,
        }
    }

    /// The line that this share of the whole, now, asks for.
    fn due(&mut self, share: f64, now: Instant) -> Option<String> {
        // A phase of its own begins anew.
        self.share = self.share.min(share);
        let is_due = share >= self.share + LINE_SHARE && now.duration_since(self.last) >= LINE_TIME;
        is_due.then(|| {
            (self.share, self.last) = (share, now);
            let seconds = now.duration_since(self.start).as_secs();
            format!("{:.0} % done after {seconds} s", 100.0 * share)
        })
    }
}

impl Bar {
    /// A bar with this layout.
    pub fn new(template: &str) -> Self {
        let bar = ProgressBar::new(0).with_style(style(template));
        Self {
            lines: bar.is_hidden().then(|| Lines::begin(Instant::now())),
            bar,
            begun: false,
            study: None,
            case: String::new(),
        }
    }

    /// The bar of a number of things of this name, `step` or `run`.
    pub fn counting(name: &str) -> Self {
        let bar = Self::new("{bar:30} {prefix} {pos}/{len}, {eta} left");
        bar.bar.set_prefix(name.to_owned());
        bar
    }

    /// The bar of a study: cases, weighted by what they are expected to cost, a part of which is done.
    pub fn of_study(total: f64, done: f64) -> Self {
        let mut bar = Self::new("{bar:30} {percent:>3} %, {eta} left  {msg}");
        bar.study = Some((total, done, 0.0));
        bar.set_share(0.0);
        bar.bar.enable_steady_tick(Duration::from_millis(500));
        bar
    }

    /// Begins the next case of a study.
    pub fn begin(&mut self, case: &str, cost: f64) {
        self.bar.set_message(case.to_owned());
        case.clone_into(&mut self.case);
        self.study = self.study.map(|(total, done, last)| (total, done + last, cost));
        self.set_share(0.0);
    }

    /// So many of so many are done.
    pub fn set(&mut self, done: usize, count: usize) {
        self.bar.set_length(count as u64);
        self.bar.set_position(done as u64);
        if !self.begun {
            self.bar.reset_eta();
            self.begun = true;
        }
        let lines = self.lines.as_mut().filter(|_| done < count);
        if let Some(line) = lines.and_then(|lines| lines.due(done as f64 / count as f64, Instant::now())) {
            match self.case.as_str() {
                "" => console::notice(&line),
                case => console::notice(&format!("{line}, now {case}")),
            }
        }
    }

    /// This share is done: of the case at hand, if it is the bar of a study.
    pub fn set_share(&mut self, share: f64) {
        let whole = |(total, done, cost): (f64, f64, f64)| (done + cost * share) / total;
        let share = self.study.map_or(share, whole);
        self.set((share * UNITS) as usize, UNITS as usize);
    }

    /// What it says, where it is seen; that of a study has a message of its own.
    #[cfg(any(feature = "mechanics", feature = "rom"))]
    pub fn say(&self, message: impl FnOnce() -> String) {
        if !self.bar.is_hidden() && self.study.is_none() {
            self.bar.set_message(message());
        }
    }

    /// Begins anew with another layout.
    #[cfg(feature = "rom")]
    pub fn restyle(&mut self, template: &str) {
        self.bar.set_style(style(template));
        self.begun = false;
    }

    /// Takes the bar off the screen.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }
}

fn style(template: &str) -> ProgressStyle {
    ProgressStyle::with_template(template).unwrap_or_else(|_| ProgressStyle::default_bar())
}

/// Shows the steps of a run and, while it only evaluates, how many of these are done; stops it on Ctrl-C.
impl Observer for Bar {
    fn after_step(&mut self, progress: Progress) -> ControlFlow<()> {
        self.show("step", progress.step, progress.steps);
        unless_interrupted()
    }

    fn evaluated(&mut self, evaluations: u64, limit: u64) -> ControlFlow<()> {
        self.show("evaluation", evaluations as usize, limit as usize);
        unless_interrupted()
    }
}

impl Bar {
    /// So many things of this name are done, of so many.
    fn show(&mut self, name: &'static str, done: usize, count: usize) {
        match self.study {
            None => {
                self.bar.set_prefix(name);
                self.set(done, count);
            }
            Some(_) => self.set_share(done as f64 / count.max(1) as f64),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_due_after_a_share_and_a_time() {
        let start = Instant::now();
        let after = |seconds| start + Duration::from_secs(seconds);
        let mut lines = Lines::begin(start);
        assert_eq!(lines.due(0.5, after(29)), None);
        assert_eq!(lines.due(0.5, after(30)).as_deref(), Some("50 % done after 30 s"));
        assert_eq!(lines.due(0.59, after(300)), None);
        assert_eq!(lines.due(0.61, after(301)).as_deref(), Some("61 % done after 301 s"));
        assert_eq!(lines.due(0.95, after(330)), None);
        // Another phase.
        assert_eq!(lines.due(0.05, after(340)), None);
        assert_eq!(lines.due(0.16, after(341)).as_deref(), Some("16 % done after 341 s"));
    }
}
