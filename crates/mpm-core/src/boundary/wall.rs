use super::{Contact, Plane};

/// The side of the domain that a wall stands on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// The domain lies above the wall.
    Lower,
    /// The domain lies below the wall.
    Upper,
}

/// A plane wall across an axis, endless in the others: a [`Plane`] by another description. A spline grid has mirror images of nodes where
/// the wall stands on nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wall<const D: usize> {
    /// The axis the wall is normal to; below D.
    pub axis: usize,
    /// Which side of the domain it stands on.
    pub side: Side,
    /// Its coordinate on the axis.
    pub position: f64,
    /// What it does to material at it.
    pub contact: Contact,
    /// Velocity of its surface. The wall itself stays where it is.
    pub velocity: [f64; D],
}

impl<const D: usize> Wall<D> {
    /// The same wall by a point and its normal.
    pub fn plane(&self) -> Plane<D> {
        let inward = match self.side {
            Side::Lower => 1.0,
            Side::Upper => -1.0,
        };
        let along = |value: f64| std::array::from_fn(|a| if a == self.axis { value } else { 0.0 });
        Plane {
            point: along(self.position),
            normal: along(inward),
            contact: self.contact,
            velocity: self.velocity,
        }
    }
}
