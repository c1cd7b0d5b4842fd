//! Quadrature at material points.

use super::instant::Instant;
use super::neighbours::{NeighbourList, Search};
use super::nodes::Nodes;
use super::quadrature::QuadraturePoints;
use super::{OnlineError, ReducedBody};
use crate::deformation_map::{DeformationMap, MaterialPoints};
use crate::manifold::{Evaluation, Wanted};

/// Every material point that touches ℐ, with its own mass; 𝒫 is among them.
pub(super) struct Lagrangian<const D: usize> {
    search: Search,
    /// All material points.
    all: MaterialPoints<D>,
    list: NeighbourList<D>,
    /// Where all points were when the list was made, if sample points are drawn anew.
    seen: Vec<[f64; D]>,
    seen_samples: Vec<[f64; D]>,
    candidates: MaterialPoints<D>,
    /// Numbers of the points that touch ℐ.
    touching: Vec<u32>,
    chosen: MaterialPoints<D>,
    evaluation: Evaluation<D>,
    /// How often the list has been made.
    pub refreshes: u64,
}

impl<const D: usize> Lagrangian<D> {
    pub fn new(search: Search, all: MaterialPoints<D>) -> Self {
        Self {
            search,
            all,
            list: NeighbourList::default(),
            seen: Vec::new(),
            seen_samples: Vec::new(),
            candidates: MaterialPoints::default(),
            touching: Vec::new(),
            chosen: MaterialPoints::default(),
            evaluation: Evaluation::default(),
            refreshes: 0,
        }
    }

    /// What the map needs of these of all material points.
    pub fn select(&self, numbers: &[u32], out: &mut MaterialPoints<D>) {
        out.select(&self.all, numbers);
    }

    /// The quadrature points of this instant.
    pub fn place(
        &mut self,
        body: &ReducedBody<D>,
        map: &DeformationMap<'_, D>,
        nodes: &Nodes<D>,
        now: &Instant<D>,
        out: &mut QuadraturePoints<D>,
    ) -> Result<(), OnlineError> {
        self.find(map, nodes, now);
        self.chosen.select(&self.all, &self.touching);
        map.evaluate_moving(&self.chosen, now.latent, now.rates, &mut self.evaluation);
        out.clear();
        let there = &self.evaluation;
        let moving = there.positions.iter().zip(&there.velocities).zip(&there.gradients);
        let numbered = self.touching.iter().zip(&self.chosen.reference);
        for (((x, v), gradient), (&p, reference)) in moving.zip(numbered) {
            let (gradient, _) = out.admit(gradient, reference, now)?;
            if let Some(&volume) = body.volumes.get(p as usize) {
                out.push(*x, *v, gradient, volume);
            }
        }
        Ok(())
    }

    /// The numbers of the points that touch ℐ, ascending.
    fn find(&mut self, map: &DeformationMap<'_, D>, nodes: &Nodes<D>, now: &Instant<D>) {
        self.touching.clear();
        if let Search::Lists { skin } = self.search
            && self.listed(map, nodes, now, skin)
        {
            let listed = self.evaluation.positions.iter().zip(&self.list.points);
            let touching = listed.filter(|(x, _)| nodes.touched_by(x));
            self.touching.extend(touching.map(|(_, &point)| point));
            return;
        }
        map.evaluate(&self.all, now.latent, Wanted::default(), &mut self.evaluation);
        let positions = &self.evaluation.positions;
        if let Search::Lists { skin } = self.search {
            if now.redrawn.is_some() {
                self.seen.clone_from(positions);
            }
            self.list
                .rebuild(positions, &now.samples.positions, nodes.grid.spacing(), skin);
            self.candidates.select(&self.all, &self.list.points);
            self.refreshes += 1;
        }
        let touching = positions.iter().zip(0..).filter(|(x, _)| nodes.touched_by(x));
        self.touching.extend(touching.map(|(_, point)| point));
    }

    /// The list of other sample points: it is that which would have been made for them when all points were seen last.
    fn relist(&mut self, numbers: &[u32], spacing: f64, skin: f64) {
        let seen = numbers.iter().filter_map(|&p| self.seen.get(p as usize));
        self.seen_samples.clear();
        self.seen_samples.extend(seen);
        self.list.relist(&self.seen, &self.seen_samples, spacing, skin);
        self.candidates.select(&self.all, &self.list.points);
    }

    /// Whether there is a list that holds; the evaluation is then that of its points.
    fn listed(&mut self, map: &DeformationMap<'_, D>, nodes: &Nodes<D>, now: &Instant<D>, skin: f64) -> bool {
        if self.list.points.is_empty() {
            return false;
        }
        if let Some(numbers) = now.redrawn {
            self.relist(numbers, nodes.grid.spacing(), skin);
        }
        map.evaluate(&self.candidates, now.latent, Wanted::default(), &mut self.evaluation);
        let positions = &self.evaluation.positions;
        self.list
            .holds(positions, &now.samples.positions, nodes.grid.spacing(), skin)
    }
}
