//! What the flags give of the particles at the start.

use std::path::Path;

use mpm_tensor::Matrix;
use parvi::{GivenParticles, Run, SampleError, independent_draws, sobol_points};
use parvi_files::{FileError, NumberTable};
use parvi_options::{Dimension, MethodOptions, OptionError, TargetSpecification};
use parvi_targets::{CatalogueTarget, Gaussian};

use super::Arguments;
use crate::CommandError;
use crate::dispatch::{in_dimension, on_target};
use crate::plots::page::counted;

/// Reads the files, and draws from the start's law where it has a name or a covariance; `names` are those of the target's coordinates, one for each dimension.
///
/// # Errors
/// A file that does not fit the target or the number of particles, or a law that cannot be drawn from.
pub fn given(arguments: &Arguments, names: &[String], run: &Run) -> Result<GivenParticles, CommandError> {
    let dimension = names.len();
    let (options, particles) = (&arguments.options, run.particles);
    let read = |flag: &'static str, path: Option<&Path>, columns: usize| {
        path.map(|path| read(flag, path, particles, columns, names)).transpose()
    };
    let mut given = GivenParticles {
        positions: read("start", options.start_file(), dimension)?,
        velocities: read("velocities", options.velocities_file(), dimension)?,
        masses: read("masses", options.masses_file(), 1)?,
        reference_volumes: read("volumes", options.volumes_file(), 1)?,
    };
    let volumes = options.volumes_of_start();
    let drawn = if let Some(name) = &options.start_law {
        let law = TargetSpecification::plain(name, Dimension::new(dimension as i64));
        law.dimension().map_err(|error| of_law(error.to_string()))?;
        Some(on_target!(&law, law, D => drawn::<D>(law.as_ref(), run, volumes))?)
    } else if let Some(centre) = &options.start_centre {
        let covariance = options.start_covariance.as_deref();
        Some(in_dimension!("gaussian", dimension, D => drawn::<D>(&normal(centre, covariance)?, run, volumes))?)
    } else {
        None
    };
    if let Some((positions, densities)) = drawn {
        given.positions = Some(positions);
        if let Some(densities) = densities {
            let mass = |p: usize| given.masses.as_ref().map_or(1.0 / particles as f64, |masses| masses[p]);
            let volumes = densities.iter().enumerate().map(|(p, density)| mass(p) / density);
            given.reference_volumes = Some(volumes.collect());
        }
    }
    Ok(given)
}

/// The numbers of a file: so many rows and columns, all finite. Columns count by their place, so that a header of the coordinates' `names` in another order is refused.
fn read(
    flag: &'static str,
    path: &Path,
    rows: usize,
    columns: usize,
    names: &[String],
) -> Result<Vec<f64>, CommandError> {
    let table = NumberTable::read(flag, path)?;
    let refused = |reason: String| OptionError::new(flag, format!("{}{reason}", path.display())).into();
    for (found, wanted, what) in [(table.columns, columns, "columns"), (table.rows(), rows, "rows")] {
        if found != wanted {
            let found = counted(found, what);
            return Err(refused(format!(" has {found}, must have {wanted}")));
        }
    }
    if table.header != names && sorted(&table.header) == sorted(names) {
        let [found, wanted] = [&table.header, names].map(|names| names.join(", "));
        return Err(refused(format!(": the columns are {found}, must be {wanted}")));
    }
    let Some(index) = table.numbers.iter().position(|number| !number.is_finite()) else {
        return Ok(table.numbers);
    };
    let (row, column, number) = (index / columns + 1, index % columns + 1, table.numbers[index]);
    Err(FileError::NoTable {
        flag,
        path: path.to_owned(),
        reason: format!("row {row}, column {column} is not finite: {number}"),
    }
    .into())
}

fn sorted(names: &[String]) -> Vec<&String> {
    let mut sorted: Vec<&String> = names.iter().collect();
    sorted.sort_unstable();
    sorted
}

fn of_law(reason: String) -> CommandError {
    OptionError::new("start-law", reason).into()
}

/// N(centre, covariance) in the target's own coordinates, the covariance row by row; without one the identity.
fn normal<const D: usize>(centre: &str, covariance: Option<&str>) -> Result<Gaussian<D>, CommandError> {
    const FLAG: &str = "start-covariance";
    let centre = numbers("start-centre", centre, D)?;
    let mut matrix = Matrix::IDENTITY;
    if let Some(text) = covariance {
        let rows: Vec<&str> = text.split(';').collect();
        if rows.len() != D {
            let reason = format!("the number of rows is {}, the target has dimension {D}", rows.len());
            return Err(OptionError::new(FLAG, reason).into());
        }
        for (entries, row) in matrix.0.iter_mut().zip(rows) {
            entries.copy_from_slice(&numbers(FLAG, row, D)?);
        }
    }
    let law = Gaussian::new(std::array::from_fn(|axis| centre[axis]), matrix);
    law.map_err(|error| OptionError::new(FLAG, error.to_string()).into())
}

/// As many finite numbers as there are dimensions, with commas between.
fn numbers(flag: &str, text: &str, dimension: usize) -> Result<Vec<f64>, OptionError> {
    let number = |cell: &str| {
        let number = cell.trim().parse::<f64>().ok().filter(|number| number.is_finite());
        number.ok_or_else(|| OptionError::new(flag, format!("'{cell}' is not a finite number")))
    };
    let numbers: Vec<f64> = text.split(',').map(number).collect::<Result<_, _>>()?;
    if numbers.len() == dimension {
        return Ok(numbers);
    }
    let count = numbers.len();
    let reason = format!("the number of entries of '{text}' is {count}, the target has dimension {dimension}");
    Err(OptionError::new(flag, reason))
}

/// What was drawn: positions, M × D, row by row, and normalised densities there, where they are asked for.
type Drawn = (Vec<f64>, Option<Vec<f64>>);

/// Quasi-random points of the law where it has them and nothing else is asked for, else independent draws.
fn drawn<const D: usize>(law: &dyn CatalogueTarget<D>, run: &Run, volumes: bool) -> Result<Drawn, CommandError> {
    let samples = match run.start.draws == parvi::StartDraws::QuasiRandom && law.unit_cube_transport().is_some() {
        true => sobol_points(law, run),
        false => independent_draws(law, run),
    };
    let positions = samples.map_err(|error| of_law(error.to_string()))?.positions;
    let name = law.name();
    let unknown = || format!("the density of {name} is not known, which --volumes start-density needs");
    let mut densities = None;
    if volumes {
        let evidence = law.log_evidence().ok_or_else(|| of_law(unknown()))?;
        let density = |x: &[f64; D]| (law.log_density(x) - evidence).exp();
        densities = Some(positions.iter().map(density).collect());
    }
    Ok((positions.as_flattened().to_vec(), densities))
}

/// The flag behind what a sampler refuses of given particles, or of the size of a pool.
pub fn flag_of(error: &SampleError, options: &MethodOptions) -> Option<OptionError> {
    let field = match error {
        SampleError::GivenValue { field, .. }
        | SampleError::GivenLength { field, .. }
        | SampleError::NotTaken { field, .. } => *field,
        SampleError::StartWithoutSpread => "start positions",
        SampleError::InvalidOption { field: "pool size", .. } => "pool size",
        _ => return None,
    };
    let name = match field {
        "start positions" if options.start_law.is_some() => "start-law",
        "start positions" if options.start_centre.is_some() => "start-centre",
        "start positions" => "start",
        "velocities" => "velocities",
        "masses" => "masses",
        "pool size" => "pool-size",
        _ => "volumes",
    };
    Some(OptionError::new(name, error.to_string()))
}
