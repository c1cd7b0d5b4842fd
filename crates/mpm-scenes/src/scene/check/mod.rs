//! What a document may say: ranges of numbers, lengths of vectors, names that exist.

mod bodies;
mod boundaries;
mod facets;
mod forces;
mod mesh;
mod outputs;

use super::{BasisName, Scene, TransferKind};
use crate::SceneFault;
use crate::values::{check, not_negative, positive, vector, within};

/// Steps of a run, at most: months of computing time for the smallest bodies.
pub(crate) const MOST_STEPS: f64 = 1e9;

/// The order of PIC, at most: it takes as many passes.
const MOST_ORDER: usize = 100;

impl Scene {
    /// Whether every value is in its range and fits the others.
    ///
    /// # Errors
    /// [`SceneFault::Value`] with the first that is not.
    pub(super) fn check(&self) -> Result<(), SceneFault> {
        match self.dimension {
            1 => self.check_in::<1>(),
            2 => self.check_in::<2>(),
            3 => self.check_in::<3>(),
            other => Err(SceneFault::value("dimension", other, "1, 2 or 3")),
        }
    }

    fn check_in<const D: usize>(&self) -> Result<(), SceneFault> {
        let ramp = not_negative("gravity_ramp", self.gravity_ramp)?;
        let acts = ramp == 0.0 || !self.gravity.is_empty();
        within("gravity_ramp", ramp, acts, "left out without gravity")?;
        if !self.gravity.is_empty() {
            vector::<D>("gravity", &self.gravity)?;
        }
        self.check_discretisation::<D>()?;
        self.check_transfer()?;
        self.check_time()?;
        self.check_bodies::<D>()?;
        self.check_boundaries::<D>()?;
        self.check_forces::<D>()?;
        self.check_outputs::<D>()
    }

    fn check_transfer(&self) -> Result<(), SceneFault> {
        let table = &self.transfer;
        let blended = matches!(table.kind, TransferKind::Flip | TransferKind::AffineFlip);
        for (field, value) in [
            ("transfer.flip_share", table.flip_share),
            ("transfer.pic_rate", table.pic_rate),
        ] {
            let expected = "left out unless transfer.kind = \"flip\" or \"affine-flip\"";
            within(field, value, blended || value.is_none(), expected)?;
        }
        let (field, share) = ("transfer.flip_share", table.flip_share);
        let fits = share.is_none_or(|share| (0.0..=1.0).contains(&share));
        within(field, share, fits, "between 0 and 1")?;
        check(table.pic_rate, "transfer.pic_rate", not_negative)?;
        let (field, order) = ("transfer.pic_order", table.pic_order);
        let expected = format!("at least 1 and at most {MOST_ORDER}");
        let fits = order.is_none_or(|order| (1..=MOST_ORDER).contains(&order));
        within(field, order, fits, &expected)?;
        let of_rate = order.is_none() || table.pic_rate.is_some();
        within(field, order, of_rate, "left out unless transfer.pic_rate is given")?;
        let (field, moments) = ("transfer.moments", table.moments);
        let fits = moments.is_none() || table.kind == TransferKind::AffineFlip;
        within(field, moments, fits, "left out unless transfer.kind = \"affine-flip\"")?;
        let affine = matches!(
            table.kind,
            TransferKind::Apic | TransferKind::Mls | TransferKind::AffineFlip
        );
        let expected = "\"pic\" or \"flip\" with grid.basis = \"gimp\"";
        within("transfer.kind", table.kind, !(self.is_gimp() && affine), expected).map(drop)
    }

    /// Whether the basis is `gimp`.
    pub(super) fn is_gimp(&self) -> bool {
        self.grid.as_ref().is_some_and(|grid| grid.basis == BasisName::Gimp)
    }

    fn check_time(&self) -> Result<(), SceneFault> {
        let time = &self.time;
        positive("time.end", time.end)?;
        check(time.step, "time.step", positive)?;
        let reaches = time.step.is_none_or(|step| time.end <= MOST_STEPS * step);
        let expected = format!("so long that 1e9 steps reach time.end = {:?}", time.end);
        within("time.step", time.step, reaches, &expected)?;
        let courant = time.courant > 0.0 && time.courant <= 1.0;
        within("time.courant", time.courant, courant, "above 0 and at most 1")?;
        not_negative("time.damping", time.damping).map(|_| ())
    }
}
