//! Particles that are given instead of drawn.

use parvi_targets::Frame;

use crate::SampleError;

/// What is given of the particles at the start, in the target's own coordinates and in the order of the particles; `None`: the method's own choice.
///
/// The paper's algorithms take all of it (inputs x_p, v_p, m_p, V⁰_p of Algorithms 1 and 2; B_p of Algorithm 2 begins with 0), other methods that move particles from a start take positions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct GivenParticles {
    /// X_p, M × D, row by row; finite.
    pub positions: Option<Vec<f64>>,
    /// v_p, M × D, row by row; finite. Length per pseudo-time.
    pub velocities: Option<Vec<f64>>,
    /// m_p, M of them; positive and finite. They need not sum to one.
    pub masses: Option<Vec<f64>>,
    /// V⁰_p, M of them; positive and finite.
    pub reference_volumes: Option<Vec<f64>>,
}

/// A number that every entry of a field must be.
type Range = (fn(f64) -> bool, &'static str);
const FINITE: Range = (f64::is_finite, "finite");
const POSITIVE: Range = (|value| value > 0.0 && value.is_finite(), "positive and finite");

impl GivenParticles {
    /// Given positions, the rest left to the method.
    pub fn at<const D: usize>(positions: &[[f64; D]]) -> Self {
        Self {
            positions: Some(positions.as_flattened().to_vec()),
            ..Self::default()
        }
    }

    /// Whether every field has one entry per particle and each lies in its range.
    pub(crate) fn check<const D: usize>(&self, particles: usize) -> Result<(), SampleError> {
        let fields = [
            ("start positions", &self.positions, D, FINITE),
            ("velocities", &self.velocities, D, FINITE),
            ("masses", &self.masses, 1, POSITIVE),
            ("reference volumes", &self.reference_volumes, 1, POSITIVE),
        ];
        for (field, values, columns, (holds, expected)) in fields {
            let Some(values) = values else { continue };
            if values.len() != particles * columns {
                return Err(SampleError::GivenLength {
                    field,
                    length: values.len(),
                    particles,
                    columns,
                });
            }
            if let Some(index) = values.iter().position(|&value| !holds(value)) {
                return Err(SampleError::GivenValue {
                    field,
                    particle: index / columns,
                    value: values[index],
                    expected,
                });
            }
        }
        Ok(())
    }

    /// Refuses what a method does not take.
    pub(crate) fn check_taken(&self, method: &'static str, positions: bool) -> Result<(), SampleError> {
        let given = [
            ("start positions", self.positions.is_some() && !positions),
            ("velocities", self.velocities.is_some()),
            ("masses", self.masses.is_some()),
            ("reference volumes", self.reference_volumes.is_some()),
        ];
        match given.into_iter().find(|(_, refused)| *refused) {
            None => Ok(()),
            Some((field, _)) => Err(SampleError::NotTaken { method, field }),
        }
    }

    /// Positions in coordinates of a frame, where they are given.
    pub(crate) fn positions_in<const D: usize>(&self, frame: &Frame<D>) -> Option<Vec<[f64; D]>> {
        let (rows, _) = self.positions.as_ref()?.as_chunks::<D>();
        Some(rows.iter().map(|x| frame.to_reference(x)).collect())
    }

    /// L⁻¹ v of the frame x = μ + L z, by forward substitution, where velocities are given.
    pub(crate) fn velocities_in<const D: usize>(&self, frame: &Frame<D>) -> Option<Vec<[f64; D]>> {
        let l = &frame.factor().0;
        let (rows, _) = self.velocities.as_ref()?.as_chunks::<D>();
        let solved = rows.iter().map(|row| {
            let mut v = *row;
            for i in 0..D {
                let known: f64 = (0..i).map(|j| l[i][j] * v[j]).sum();
                v[i] = (v[i] - known) / l[i][i];
            }
            v
        });
        Some(solved.collect())
    }

    /// V⁰ / det L, where volumes are given.
    pub(crate) fn reference_volumes_in<const D: usize>(&self, frame: &Frame<D>) -> Option<Vec<f64>> {
        let unit: f64 = (0..D).map(|a| frame.factor().0[a][a]).product();
        let volumes = self.reference_volumes.as_ref()?;
        Some(volumes.iter().map(|volume| volume / unit).collect())
    }
}

#[cfg(test)]
mod tests {
    use mpm_tensor::Matrix;

    use super::*;

    #[test]
    fn what_is_given_arrives_in_coordinates_of_the_frame() {
        let frame = Frame::new([1.0, -2.0], Matrix([[4.0, 1.8], [1.8, 1.0]])).expect("a covariance");
        let (x, v) = ([[0.3, -1.0]], [[0.5, 2.0]]);
        let given = GivenParticles {
            velocities: Some(v.as_flattened().to_vec()),
            reference_volumes: Some(vec![0.25]),
            ..GivenParticles::at(&x)
        };
        let z = given.positions_in(&frame).expect("positions")[0];
        let w = given.velocities_in(&frame).expect("velocities")[0];
        let volume = given.reference_volumes_in(&frame).expect("volumes")[0];
        let (back, moved) = (frame.factor().apply(&w), frame.to_target(&z));
        for a in 0..2 {
            assert!((back[a] - v[0][a]).abs() < 1e-14 && (moved[a] - x[0][a]).abs() < 1e-14);
        }
        assert!((volume * frame.factor().determinant() - 0.25).abs() < 1e-15);
    }

    #[test]
    fn what_is_wrong_is_named_with_its_particle() {
        let good = GivenParticles::at(&[[0.0, 1.0], [2.0, 3.0]]);
        assert_eq!(good.check::<2>(2), Ok(()));
        assert_eq!(
            good.check::<3>(2),
            Err(SampleError::GivenLength {
                field: "start positions",
                length: 4,
                particles: 2,
                columns: 3
            })
        );
        let wrong = |change: fn(&mut GivenParticles)| {
            let mut given = GivenParticles::at(&[[0.0, 1.0], [2.0, 3.0]]);
            change(&mut given);
            given.check::<2>(2).expect_err("refused").to_string()
        };
        let text = wrong(|given| given.positions = Some(vec![0.0, 1.0, 2.0, f64::NAN]));
        assert_eq!(text, "start positions: particle 1 has NaN, must be finite");
        let text = wrong(|given| given.masses = Some(vec![0.5, -0.5]));
        assert_eq!(text, "masses: particle 1 has -0.5, must be positive and finite");
        let text = wrong(|given| given.reference_volumes = Some(vec![0.0, 0.5]));
        assert_eq!(text, "reference volumes: particle 0 has 0, must be positive and finite");
        assert_eq!(
            wrong(|given| given.velocities = Some(vec![0.0; 2])),
            "velocities: the length is 2, where the number of particles is 2 and each needs 2"
        );
        assert!(good.check_taken("svgd", true).is_ok());
        let refused = good.check_taken("iid", false).expect_err("refused").to_string();
        assert_eq!(refused, "method `iid` does not take start positions");
    }
}
