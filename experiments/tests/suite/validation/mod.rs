//! The validation problems of mechanics: the committed scenes, shortened where they are long, against their references and against the
//! figures that they gave before (`figures.json`).

mod cantilever;
mod convergence;
mod flows;
mod problem;
mod references;
mod solids;
mod umls;
