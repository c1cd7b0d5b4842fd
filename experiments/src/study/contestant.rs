//! A method and its rivals, each with the same task: what studies share that hold the one against the others.

use std::path::PathBuf;

use super::prelude::*;

/// The method that sets the task, or a rival.
#[derive(Clone, Debug)]
pub struct Contestant {
    /// What its file begins with, the same for all of one task.
    pub task: String,
    /// The target.
    pub target: TargetSpecification,
    /// M.
    pub particles: usize,
    /// 0 for the method that sets the task, then its rivals.
    pub index: usize,
    /// The method.
    pub method: MethodSpecification,
}

impl Contestant {
    /// The cases of one task, whose names begin with a word: the method first, then its rivals.
    ///
    /// # Errors
    /// A target that there is not.
    pub fn all(
        (name, task): (&str, &str),
        (target, particles): (&TargetSpecification, usize),
        methods: (&MethodSpecification, &[MethodSpecification]),
    ) -> Result<Vec<Case<Self>>, CommandError> {
        let dim = target.dimension()?;
        let case = |(index, method): (usize, &MethodSpecification)| {
            let contestant = Self {
                task: task.to_owned(),
                target: target.clone(),
                particles,
                index,
                method: method.clone(),
            };
            let case = Case::new(format!("{name}-m{particles}-{}", method.label()), contestant).by(method);
            let case = case.with("target", target.label()).with("dim", dim);
            case.with("particles", particles)
        };
        let methods = std::iter::once(methods.0).chain(methods.1);
        Ok(methods.enumerate().map(case).collect())
    }

    /// Its runs, as far as they have been made.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn trials(&self, directory: &StudyDirectory, columns: &str) -> Result<Vec<Row>, CommandError> {
        row_file::read(&self.file(directory), columns)
    }

    /// The method that sets its task.
    pub fn first(&self, method: &MethodSpecification) -> Self {
        Self {
            index: 0,
            method: method.clone(),
            ..self.clone()
        }
    }

    /// The file of its runs.
    pub fn file(&self, directory: &StudyDirectory) -> PathBuf {
        let Self {
            task, index, method, ..
        } = self;
        directory.raw(&format!("{task}-{index}-{}.csv", method.name))
    }
}
