//! The report of the study `scenes`.

use super::configuration::Scenes;
use super::family::Family;
use super::history;
use crate::plots::judgement::{Judgement, MeasuredSeries, orders};
use crate::plots::page::{escaped, number_beside, telling_digits};
use crate::study::prelude::*;

/// Judgements, then each family with its figure and its numbers.
pub fn report(study: &Scenes, rows: &Rows<'_>, directory: &StudyDirectory) -> Result<Page, CommandError> {
    let families = study.resolved()?;
    let of = |family: &Family| MeasuredSeries::of(&rows.with("family", family.name.as_str()));
    let all: Vec<Vec<MeasuredSeries>> = families.iter().map(of).collect();
    let mut page = directory.page(include_str!("report.md"), &[("title", &study.title)]);
    let mut lines: Vec<Line<'_>> = Vec::new();
    let mut passed = 0;
    for (family, series) in families.iter().zip(&all) {
        let verdicts = family.asked().verdicts(series);
        passed += verdicts.iter().filter(|verdict| verdict.pass).count();
        let line = |verdict| Line::from(verdict).with("family", family.title.as_str());
        lines.extend(verdicts.into_iter().map(line));
    }
    let judged = lines.len();
    page.section("Judgements", &[], lines);
    let seconds = format!("{:.0}", rows.values(SECONDS).iter().sum::<f64>());
    page.part(
        "kept",
        &[("passed", &passed), ("judged", &judged), ("seconds", &seconds)],
    );
    for (family, series) in families.iter().zip(&all) {
        section(&mut page, family, series, rows, directory)?;
    }
    let failed = rows.count(|row| row.number("value").is_none());
    let verdict = match judged {
        0 => "none",
        _ if passed == judged => "pass",
        _ => "fail",
    };
    let page = page.with("cases", rows.len()).with("failed", failed);
    let page = page.with("judged", judged).with("passed", passed);
    Ok(page.with("verdict", verdict))
}

/// Figure and tables of one family.
fn section(
    page: &mut Page,
    family: &Family,
    series: &[MeasuredSeries],
    rows: &Rows<'_>,
    directory: &StudyDirectory,
) -> Result<(), CommandError> {
    page.heading(&family.title);
    if let Some(note) = &family.note {
        page.paragraph(note);
    }
    let name = format!("{}.svg", family.name);
    let caption = format!("{}: {}.", family.title, family.y_label);
    let labels = [family.x_label.as_deref().unwrap_or_default(), &family.y_label];
    let plot = family.asked().plot(series, &family.title, labels);
    page.figure(&name, &caption, multiples(&plot));
    if let Some(plot) = history::plot(family, rows, directory)? {
        let name = format!("{}_history.svg", family.name);
        let caption = format!("{}: over time.", family.title);
        page.figure(&name, &caption, multiples(&plot));
    }
    let order = |judgement: &Judgement| matches!(judgement, Judgement::Order { .. });
    if family.judgements.iter().any(order) {
        page.lines("orders", series.iter().map(order_line));
    }
    let own = rows.with("family", family.name.as_str());
    let significant = telling_digits(&own.values("value"));
    page.lines("runs", own.iter().map(|row| line(row, significant)));
    Ok(())
}

fn order_line(series: &MeasuredSeries) -> Line<'static> {
    let (between, overall) = orders(series);
    let between: Vec<String> = between.iter().map(|order| format!("{order:.2}")).collect();
    let line = Line::default().with("series", escaped(&series.label));
    let line = line.with("between", between.join(", "));
    line.with("overall", overall.map(|order| format!("{order:.2}")))
}

/// A run, its value with as many digits as it takes to tell it from others.
fn line(row: &Row, significant: usize) -> Line<'_> {
    let value = row.number("value");
    let value = value.map(|value| number_beside(value, row.number("reference"), significant));
    let ended = value.as_ref().map_or(row.text("reason"), |_| "at the end");
    let x = row.number("x").unwrap_or(f64::NAN).to_string();
    Line::from(row).with("x", x).with("digits", value).with("ended", ended)
}
