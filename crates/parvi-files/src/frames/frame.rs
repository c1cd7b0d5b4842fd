//! The particles of one moment as files.

use mpm_vtk::Appended;
use parvi::ParticleView;

use crate::npy::array;
use crate::{Particles, distinct_names};

/// What the files say of particles.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Frame {
    /// D.
    pub dimension: usize,
    /// x_p, M × D, row by row.
    pub positions: Vec<f64>,
    /// v_p, M × D, row by row.
    pub velocities: Option<Vec<f64>>,
    /// F_p, M × D × D, row by row.
    pub deformation_gradients: Option<Vec<f64>>,
    /// Weights or masses, one per particle, where they differ.
    pub weights: Option<Vec<f64>>,
}

/// When a frame was taken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stamp {
    /// The time of the animation.
    pub time: f64,
    /// Steps of the run.
    pub step: usize,
    /// Number of the body and its pseudo-time; `None` for what the run returned.
    pub of_body: Option<(usize, f64)>,
}

impl From<&ParticleView<'_>> for Frame {
    fn from(view: &ParticleView<'_>) -> Self {
        Self {
            dimension: view.dimension(),
            positions: view.positions(),
            velocities: view.velocities(),
            deformation_gradients: view.deformation_gradients(),
            weights: view.masses(),
        }
    }
}

impl From<&Particles> for Frame {
    fn from(particles: &Particles) -> Self {
        Self {
            dimension: particles.dimension(),
            positions: particles.coordinates().to_vec(),
            weights: particles.weights().map(<[f64]>::to_vec),
            ..Self::default()
        }
    }
}

impl Frame {
    fn particles(&self) -> usize {
        self.positions.len() / self.dimension.max(1)
    }

    /// The arrays that there are, as a name and the bytes of a `.npy` file: `positions` and `velocities`, M × D, `deformation_gradients`, M × D × D, `weights`, M.
    pub fn arrays(&self) -> std::io::Result<Vec<(&'static str, Vec<u8>)>> {
        let (m, d) = (self.particles() as u64, self.dimension as u64);
        let gradients = self.deformation_gradients.as_ref();
        let all = [
            ("positions", Some(&self.positions), vec![m, d]),
            ("velocities", self.velocities.as_ref(), vec![m, d]),
            ("deformation_gradients", gradients, vec![m, d, d]),
            ("weights", self.weights.as_ref(), vec![m]),
        ];
        let bytes = |(name, values, shape): (_, Option<&Vec<f64>>, Vec<u64>)| {
            Some(array(&shape, values?).map(|bytes| (name, bytes)))
        };
        all.into_iter().filter_map(bytes).collect()
    }

    /// A `.vtp` file: a vertex per particle, at its first three coordinates, padded with zeros where there are fewer.
    ///
    /// Arrays at the points: every coordinate by its name (x1, x2, … where `names` has none), `velocity` (three components up to D = 3, else D), `deformation_gradient` (up to D = 3 nine, that of no
    /// deformation across the plane or line; else D²), `weight` where weights differ, and `particle`, its number. Field data: `TimeValue`, `step`, and of a body `body` and `pseudo_time`.
    pub fn vtp(&self, stamp: &Stamp, names: &[String]) -> Vec<u8> {
        let count = self.particles();
        let mut appended = Appended::default();
        let points = appended.positions(self.dimension, &self.positions);
        let connectivity = appended.integers("connectivity", (0..count).map(|p| p as i64));
        let offsets = appended.integers("offsets", (1..=count).map(|p| p as i64));
        let data = self.point_data(&mut appended, names);
        let number = |kind: &str, name: &str, value: String| {
            format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfTuples=\"1\" format=\"ascii\">{value}</DataArray>\n"
            )
        };
        let mut field = number("Float64", "TimeValue", format!("{:?}", stamp.time));
        field += &number("Int64", "step", stamp.step.to_string());
        if let Some((body, time)) = stamp.of_body {
            field += &number("Int64", "body", body.to_string());
            field += &number("Float64", "pseudo_time", format!("{time:?}"));
        }
        appended.poly_data(&format!(
            "<FieldData>\n{field}</FieldData>\n\
             <Piece NumberOfPoints=\"{count}\" NumberOfVerts=\"{count}\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n\
             <Points>\n{points}</Points>\n\
             <Verts>\n{connectivity}{offsets}</Verts>\n\
             <PointData>\n{data}</PointData>\n\
             </Piece>\n"
        ))
    }

    fn point_data(&self, appended: &mut Appended, names: &[String]) -> String {
        let (d, count) = (self.dimension, self.particles());
        let mut text = String::new();
        for (axis, name) in distinct_names(names, d, &OTHERS).iter().enumerate() {
            let column: Vec<f64> = self.positions.iter().skip(axis).step_by(d.max(1)).copied().collect();
            text += &appended.floats(name, 1, &column);
        }
        if let Some(velocities) = &self.velocities {
            text += &appended.vectors("velocity", d, velocities);
        }
        if let Some(gradients) = &self.deformation_gradients {
            text += &appended.matrices("deformation_gradient", d, gradients, |_| 1.0);
        }
        if let Some(weights) = &self.weights {
            text += &appended.floats("weight", 1, weights);
        }
        text + &appended.integers("particle", (0..count).map(|p| p as i64))
    }
}

/// Names of the other arrays.
const OTHERS: [&str; 5] = ["position", "velocity", "deformation_gradient", "weight", "particle"];
