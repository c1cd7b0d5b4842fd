//! Values as they are typed on the command line.

use std::path::PathBuf;

use super::{
    AlphaSchedule, Basis, Bounded, Correction, Draws, FrameName, Limit, Material, MonitorName, NonFinite, Score,
    Switch, Transfer,
};

/// The value of an option.
pub trait Typed {
    /// As it is typed.
    fn typed(&self) -> String;

    /// The number that has to lie in a range, if it is one.
    fn number(&self) -> Option<f64> {
        self.typed().parse().ok()
    }
}

impl Typed for PathBuf {
    fn typed(&self) -> String {
        self.display().to_string()
    }
}

impl<const LEAST: i64, const MOST: i64> Typed for Bounded<LEAST, MOST> {
    fn typed(&self) -> String {
        self.to_string()
    }
}

macro_rules! as_displayed {
    ($($type:ty),*) => {$(
        impl Typed for $type {
            fn typed(&self) -> String {
                self.to_string()
            }
        }
    )*};
}

as_displayed!(f64, String, AlphaSchedule, Basis, Correction, Draws, FrameName, Limit);
as_displayed!(Material, MonitorName, NonFinite, Score, Switch, Transfer);
