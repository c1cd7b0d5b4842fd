//! What a scene asks for that runs, and is seldom what is wanted.

use super::{BasisName, KernelName, Scene};

impl Scene {
    /// Known limits of the discretisation that this scene has chosen, a sentence each, with what to do about them; none where there are none. They are no errors: the scene runs.
    ///
    /// The measurements behind them are in `docs/scenes.md`, Meshes.
    pub fn cautions(&self) -> Vec<String> {
        let of_grid = self.grid.as_ref().filter(|grid| grid.basis == BasisName::Linear);
        let of_hats = self.mesh.as_ref().filter(|mesh| mesh.kernel == KernelName::Hat);
        let grid = of_grid.map(|_| {
            "grid.basis = \"linear\": gradients jump where particles go from cell to cell, which takes their volume, up to inversion; \"quadratic\" has none of it"
        });
        let hats = of_hats.map(|_| {
            "mesh.kernel = \"hat\": gradients jump where particles go from cell to cell, which may invert them at strains of 1e-3 on irregular meshes; the default kernel has none of it"
        });
        grid.into_iter().chain(hats).map(str::to_owned).collect()
    }
}
