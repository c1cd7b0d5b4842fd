//! The figures of the study `quickstart`, from its raw files.

use parvi::TracePoint;

use super::{PICTURE, POSTERIOR, Quickstart, REFERENCE, file};
use crate::dispatch::on_target;
use crate::output::{Particles, particles_csv, table_file};
use crate::pictures::density;
use crate::pictures::trace_panels::{KINETIC_ENERGY, POTENTIAL_ENERGY, RESIDUAL, panels};
use crate::plots::{DensityPlot, PairDensity, PointCloud, Reference, cloud, corner, histogram};
use crate::study::prelude::*;

/// Corner plot and marginals of the posterior over the reference draws.
pub fn posterior(
    study: &Quickstart,
    particles: &Particles,
    directory: &StudyDirectory,
    page: &mut Page,
) -> Result<(), CommandError> {
    let draws = particles_csv::read(&file(directory, REFERENCE, "particles"))?;
    let (points, draws) = (particles.to_rows(), draws.to_rows());
    let labels = study.posterior.target.coordinate_names();
    let particles = PointCloud::weighted(&points, particles.weights());
    let reference = Reference::Draws(PointCloud::equal(&draws));
    let plot = DensityPlot {
        reference_label: "reference",
        ..DensityPlot::new(particles, &labels, reference)
    };
    page.drawing("posterior-corner.svg", corner(&plot));
    page.drawing("posterior-marginals.svg", histogram(&plot));
    Ok(())
}

/// The particles for the eye over the contours of their target.
pub fn picture(study: &Quickstart, particles: &Particles, page: &mut Page) -> Result<(), CommandError> {
    let points = particles.to_rows();
    let grid = on_target!(&study.picture.target, target, D => {
        let domain = target.domain();
        let range = |axis: usize| domain.get(axis).map_or((-1.0, 1.0), |[low, high]| (*low, *high));
        Ok(density::<D>(target.as_ref(), [range(0), range(1)], (161, 161)))
    })?;
    let pairs = [PairDensity {
        horizontal: 0,
        vertical: 1,
        grid,
    }];
    let (marginals, pairs) = (&[], &pairs);
    let (known, labels) = (
        Reference::Exact { marginals, pairs },
        study.picture.target.coordinate_names(),
    );
    let shown = PointCloud::weighted(&points, particles.weights());
    let plot = DensityPlot::new(shown, &labels, known);
    let (method, target) = (study.picture.method.label(), study.picture.target.label());
    let what = format!("{} particles of `{method}` on the target `{target}`", particles.len());
    let caption = format!("{what}; lines enclose 50, 90 and 99 % of its mass.");
    page.figure("picture.svg", &caption, cloud(&plot));
    Ok(())
}

/// Residual and energies of the runs that took steps, against these.
pub fn traces(study: &Quickstart, directory: &StudyDirectory, page: &mut Page) -> Result<(), CommandError> {
    let mut labelled: Vec<(String, Vec<TracePoint>)> = Vec::new();
    for (piece, part) in [(POSTERIOR, &study.posterior), (PICTURE, &study.picture)] {
        let path = file(directory, piece, "trace");
        if path.exists() {
            labelled.push((part.target.label(), table_file::read(&path)?));
        }
    }
    labelled.retain(|(_, rows)| !rows.is_empty());
    if labelled.is_empty() {
        return Ok(());
    }
    let quantities = [RESIDUAL, KINETIC_ENERGY, POTENTIAL_ENERGY];
    let plot = MultiplesPlot::traces("", "step", panels(quantities, &labelled));
    page.drawing("traces.svg", multiples(&plot));
    Ok(())
}
