//! Study `time-error`: error against wall time and evaluations, all methods on all targets.
//!
//! The yardstick is a set of independent exact draws of the same size M; where a target has none, they are drawn
//! from its reference draws. A run that diverges is a row with its reason.

mod report;

use super::prelude::*;

/// All methods on all targets.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct TimeError {
    /// One run per seed.
    seeds: Vec<u64>,
    /// M.
    particles: ParticleCount,
    /// Numbers of steps for methods that take steps, unless their own options fix them; absent: each takes its own default.
    steps: Option<Vec<StepCount>>,
    /// Quasi-random points that stand for a target; a power of two keeps their balance.
    reference_points: Bounded<1000, 1_000_000>,
    /// Seed of the reference points.
    reference_seed: u64,
    /// Directions of the sliced Wasserstein distance.
    directions: Bounded<1, 100_000>,
    /// Targets.
    targets: Vec<TargetSpecification>,
    /// Methods.
    methods: Vec<MethodSpecification>,
}

impl TimeError {
    /// Levels of independent draws are taken from the runs of `iid`.
    fn yardstick(&self) -> YardstickOptions {
        let (points, seed) = (self.reference_points.get(), self.reference_seed);
        YardstickOptions::of_energy(points, seed, Coordinates::Own).over(self.directions.get())
    }

    /// The numbers of steps of one method; `None`: its own, or draws.
    fn sweep(&self, method: &MethodSpecification) -> Vec<Option<usize>> {
        let own = method.options.steps.map(|steps| vec![steps]);
        let steps = own.or(self.steps.clone()).filter(|_| method.name.iterates());
        let told = |steps: Vec<StepCount>| steps.iter().map(|steps| Some(steps.get())).collect();
        steps.map_or(vec![None], told)
    }
}

impl Study for TimeError {
    type Work = Sampled;

    const KIND: &'static str = "time-error";
    const COLUMNS: &'static str = "case status note target dim method particles steps seed score_evaluations density_evaluations \
         wall_seconds energy_distance_squared energy_level sliced_wasserstein mean_error deviation_error mass_error residual outcome \
         reference_size reference_mean_error reference_deviation_error";
    const REPORT: Report<Self> = report::report;

    /// The cases, target by target, so that a target's reference is made once.
    fn cases(&self) -> Result<Vec<Case<Sampled>>, CommandError> {
        not_empty("seeds", &self.seeds)?;
        self.steps.as_ref().map_or(Ok(()), |steps| not_empty("steps", steps))?;
        let mut cases = Vec::new();
        for target in &self.targets {
            for method in &self.methods {
                // Milliseconds, roughly: a distance to the reference, and M² pairs or M · 3ᵈ nodes per step.
                let nodes = stencil(target.dimension()?);
                let is_pairwise = method.name == MethodName::Svgd;
                let per_step = if is_pairwise { 10.0 } else { 0.03 * nodes };
                for steps in self.sweep(method) {
                    let of_steps = steps.map_or(String::new(), |steps| format!("-t{steps}"));
                    let name = format!("{}-{}-m{}{of_steps}", target.label(), method.label(), self.particles);
                    let cost = 100.0 + per_step * steps.unwrap_or(0) as f64;
                    let (size, seeds) = ((self.particles.get(), steps), &self.seeds);
                    let here = Sampled::of_seeds((target, method), size, (&name, seeds))?.into_iter();
                    cases.extend(here.map(|case| case.with("steps", steps).costing(cost)));
                }
            }
        }
        distinct("targets, methods, steps or seeds", cases)
    }

    fn run(&self, case: &Case<Sampled>, row: &mut Row, tools: Tools<'_>) -> Result<(), CommandError> {
        let yardstick = tools.yardstick.of(&case.work.target, &self.yardstick(), row)?;
        case.work.run(row, yardstick, tools.observer)?;
        if case.work.draws_from(yardstick) && row.finished() {
            row.set("note", "drawn from the importance sample");
        }
        // Diverged runs keep the steps they were asked for, as finished ones do.
        row.set("steps", case.row.count("steps"));
        Ok(())
    }
}
