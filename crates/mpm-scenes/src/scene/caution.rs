//! What a scene asks for that runs, and is seldom what is wanted.

use super::{BasisName, FacetCondition, FillKind, GradientName, KernelName, Scene};

impl Scene {
    /// Known limits of the discretisation that this scene has chosen, a sentence each, with what to do about them; none where there are none. They are no errors: the scene runs.
    ///
    /// The measurements behind them are in `docs/scenes.md`, Meshes and Named facets.
    pub fn cautions(&self) -> Vec<String> {
        let of_grid = self.grid.as_ref().filter(|grid| grid.basis == BasisName::Linear);
        let of_hats = self.mesh.as_ref().filter(|mesh| mesh.kernel == KernelName::Hat);
        let grid = of_grid.map(|_| {
            "grid.basis = \"linear\": gradients jump where particles go from cell to cell, which takes their volume, up to inversion; \"quadratic\" has none of it"
        });
        let hats = of_hats.map(|_| {
            "mesh.kernel = \"hat\": gradients jump where particles go from cell to cell, which may invert them at strains of 1e-3 on irregular meshes; the default kernel has none of it"
        });
        let tractions = self.loaded_facets().map(|index| {
            format!("facets[{index}]: stresses of single particles beside a traction are off by many times its size with mesh.outer_layer = true, unless kernel = \"smooth\", gradient = \"exact\" and fill = \"cells\"; outer_layer = false is another way")
        });
        let sentences = grid.into_iter().chain(hats).map(str::to_owned);
        sentences.chain(tractions).collect()
    }

    /// The first facets with a traction that nodes of the outer layer share, if particles do not integrate what these carry.
    fn loaded_facets(&self) -> Option<usize> {
        let mesh = self.mesh.as_ref()?;
        let integrates =
            mesh.gradient == GradientName::Exact && self.bodies.iter().all(|body| body.fill == FillKind::Cells);
        if !mesh.outer_layer || mesh.kernel == KernelName::Hat || integrates {
            return None;
        }
        let mut tables = self.facets.iter();
        tables.position(|table| table.condition == FacetCondition::Traction)
    }
}
