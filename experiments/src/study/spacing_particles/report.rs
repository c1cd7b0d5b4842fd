//! The report of the study `spacing-particles`.

use super::{Series, SpacingParticles};
use crate::statistics::fit_power_law;
use crate::study::prelude::*;

/// More particles help if they lower ED² at least by this factor.
const HELP: f64 = 0.9;

/// Tables and figure.
pub fn report(study: &SpacingParticles, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let mut page = directory.page(include_str!("report.md"), &[]);
    page.heading("Figure");
    let drawing = multiples(&plot(study, rows));
    page.drawing("spacing-particles.svg", drawing);
    best_spacings(study, rows, &mut page);
    let part = "Where the error stops being the particles' and becomes the spacing's";
    page.part(part, &[]);
    for series in &study.series {
        page.paragraph(format!("**d = {}**: ED² × 10³ by number of particles.", series.dim));
        saturations(study, &rows.with("dim", series.dim), series, &mut page);
    }
    Ok(rows.close(page))
}

fn best_spacings(study: &SpacingParticles, rows: &Rows<'_>, page: &mut Page) {
    let mut table = Vec::new();
    let mut fits = Vec::new();
    for series in &study.series {
        let here = rows.with("dim", series.dim);
        let (mut counts, mut spacings) = (Vec::new(), Vec::new());
        let ends = series.sorted();
        for particles in ascending(&study.particles) {
            let here = here.with("particles", particles);
            let best = here.best("requested_spacing", ends.clone(), |runs| runs.median(ENERGY));
            let Some((spacing, runs)) = best else { continue };
            let at_the_edge = ends.first() == Some(&spacing) || ends.last() == Some(&spacing);
            if !at_the_edge {
                counts.push(particles as f64);
                spacings.push(spacing);
            }
            let best = format!("{spacing}{}", if at_the_edge { "*" } else { "" });
            table.push(Line::from(runs).with("best", best));
        }
        let law = fit_power_law(&counts, &spacings).ok();
        let exponent = law.as_ref().map(|law| exponent_text(law, 0));
        let at_512 = law.map(|law| law.value(&[512.0]));
        let fit = Line::default().with("dim", series.dim.get()).with("exponent", exponent);
        fits.push(fit.with("at 512", at_512).with("points", counts.len()));
    }
    page.section("Best spacings", &[], table);
    page.section("fits", &[], fits);
}

/// One line per spacing: ED² by number of particles, and where it stops falling; of runs in one dimension.
fn saturations(study: &SpacingParticles, here: &Rows<'_>, series: &Series, page: &mut Page) {
    let counts = ascending(&study.particles);
    let lines = here.lines("requested_spacing", series.sorted());
    let lines = lines.into_iter().map(|line| {
        let energy = |&particles: &usize| {
            let here = line.rows.with("particles", particles);
            Some((particles, here.median("energy_thousandths")?))
        };
        let known: Vec<(usize, f64)> = counts.iter().filter_map(energy).collect();
        let (gain, end) = end_of_help(&known).unzip();
        let gain = gain.filter(|gain: &f64| gain.is_finite());
        let gain = gain.map(|gain| number(gain).replace('-', "−"));
        line.with("gain", gain).with("end", end)
    });
    page.lines_over("by number of particles", &[each("M", &counts)], lines);
}

/// Of pairs (M, ED²), few particles first: the exponent b of ED² ∝ M^b between the last two, and the first number beyond which more do not help, in words.
fn end_of_help(errors: &[(usize, f64)]) -> Option<(f64, String)> {
    let [.., (fewer, before), (more, after)] = errors else {
        return None;
    };
    let stopped = errors.windows(2).find(|pair| pair[1].1 > HELP * pair[0].1);
    let end = stopped.map_or(format!("they do up to {more}"), |pair| format!("beyond {}", pair[0].0));
    Some(((after / before).ln() / (*more as f64 / *fewer as f64).ln(), end))
}

/// One panel per dimension, one line per number of particles.
fn plot(study: &SpacingParticles, rows: &Rows<'_>) -> MultiplesPlot {
    let panel = |here: &Rows<'_>| {
        let (sizes, x) = (("M = ", "particles"), "requested_spacing");
        MultiplesPanel::new("", here.curves(sizes, ascending(&study.particles), x, "energy_root"))
    };
    let dims = study.series.iter().map(|series| series.dim);
    let y_label = "energy distance ED (standard deviations^{½})";
    MultiplesPlot::logarithmic("spacing h (standard deviations)", y_label)
        .with_panels(rows.panels(("d = ", "dim"), dims, panel))
        .with_note("Medians over the seeds; bars from the smallest to the largest.")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_particles_influence_ends_where_the_error_stays() {
        let (gain, end) = end_of_help(&[(128, 8.0), (512, 2.0), (2048, 0.5)]).unwrap();
        assert!((gain + 1.0).abs() < 1e-12 && end == "they do up to 2048");
        let (_, end) = end_of_help(&[(128, 8.0), (512, 2.0), (2048, 1.9), (8192, 1.0)]).unwrap();
        assert_eq!(end, "beyond 512");
        assert_eq!(end_of_help(&[(128, 8.0)]), None);
    }
}
