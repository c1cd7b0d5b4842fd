//! Pages from paragraphs and from a Markdown text.

use parvi_plot::page::{Line, Page, counted, each, number_beside, number_of, telling_digits};
use parvi_plot::results::{Row, Rows};

#[test]
fn a_page_is_markdown() {
    let mut page = Page::new("Title");
    page.heading("Part");
    page.paragraph("Text.");
    assert_eq!(page.text, "# Title\n\n## Part\n\nText.\n");
}

#[test]
fn prose_is_a_text_with_places() {
    let prose = "# Of {dim}\n\nM = {particles},\nexact.\n\n## To {end}\n\nFirst.\n\nSecond, {end}.\n\n![Error, d = {dim}.](a.svg)\n\n### aside\n\nThird.\n";
    let mut page = Page::of(prose, &[("dim", &2), ("particles", &64)]);
    page.part("aside", &[]);
    page.part("To {end}", &[("end", &"Z")]);
    page.drawing("a.svg", Ok(String::new()));
    let figure = "![Error, d = 2.](figures/a.svg)\n\n*Error, d = 2.*";
    assert_eq!(
        page.text,
        format!("# Of 2\n\nM = 64, exact.\n\nThird.\n\n## To Z\n\nFirst.\n\nSecond, Z.\n\n{figure}\n")
    );
}

#[test]
fn what_the_prose_lacks_is_said() {
    let mut page = Page::of("# A\n\n### b\n", &[]);
    page.part("b", &[]);
    assert_eq!(page.text, "# A\n");
    page.part("c", &[]);
    page.lines("b", [Line::default()]);
    page.drawing("d.svg", Ok(String::new()));
    assert_eq!(page.text.matches("The prose has no `").count(), 4, "{}", page.text);
}

#[test]
fn a_table_of_the_prose_says_what_stands_in_every_line() {
    let prose = "# A\n\n## Errors\n\nOf all.\n\n\
         | method | runs | n = {n} | worst, n = {n} | seen |\n\
         | --- | --- | --- | --- | --- |\n\
         | {method} | {rows where error}/{rows} | {median error where n = {n}} ({largest error where n = {n}}) | {worst error where n = {n}} | {seen} of {error where n = 3} |\n";
    let row = |method: &str, n: usize, error: Option<f64>| {
        Row::of("a").with("method", method).with("n", n).with("error", error)
    };
    let rows = [row("b", 1, Some(0.5)), row("b", 2, None), row("c", 1, Some(2.0))];
    let rows: Rows<'_> = rows.iter().collect();
    let mut page = Page::of(prose, &[("method", &"x"), ("n", &"y")]);
    page.part("Errors", &[]);
    let lines = rows.lines("method", ["b", "d"]);
    let lines = lines.into_iter().map(|line| {
        if line.rows.is_empty() {
            line
        } else {
            line.with("seen", 1_usize)
        }
    });
    page.lines_over("Errors", &[("n", vec!["1".to_owned(), "2".to_owned()])], lines);
    assert_eq!(
        page.text,
        "# A\n\n## Errors\n\nOf all.\n\n\
         | method | runs | n = 1 | worst, n = 1 | n = 2 | worst, n = 2 | seen |\n\
         | --- | ---: | ---: | --- | ---: | ---: | ---: |\n\
         | b | 1/2 | 0.500 (0.500) | `a` | – | – | 1 of – |\n\
         | d | 0/0 | – | – | – | – | – |\n"
    );
}

#[test]
fn a_table_of_the_prose_may_have_several_lines() {
    let prose =
        "# A\n\n### b\n\n| quantity | {n} |\n| --- | --- |\n| error | {error where n = {n}} |\n| asked | < {n} |\n";
    let rows = [1_usize, 2].map(|n| Row::default().with("n", n).with("error", 0.5 * n as f64));
    let rows: Rows<'_> = rows.iter().collect();
    let mut page = Page::of(prose, &[]);
    page.lines_over("b", &[each("n", [1, 2])], [rows]);
    let expected = "| quantity | 1 | 2 |\n| --- | ---: | ---: |\n| error | 0.500 | 1.00 |\n| asked | < 1 | < 2 |\n";
    assert!(page.text.ends_with(expected), "{}", page.text);
}

#[test]
fn bounds_are_numbers_in_tables() {
    let prose = "# A\n\n### b\n\n| more | less |\n| --- | --- |\n| {first more} | {first less} |\n";
    let mut page = Page::of(prose, &[]);
    let row = Row::of("a").with("more", "> 4").with("less", "< 4");
    let rows: Rows<'_> = [&row].into_iter().collect();
    page.lines_over("b", &[], [rows]);
    assert!(
        page.text.ends_with("| ---: | ---: |\n| > 4 | &lt; 4 |\n"),
        "{}",
        page.text
    );
}

#[test]
fn prose_says_statistics_of_rows_as_tables_do() {
    let prose = "# A\n\n## Errors\n\nAt most {farthest error} by {method}, of size {median size} ({bound} asked).\n";
    let rows = [-2.0, 0.5].map(|error| Row::of("a").with("error", error));
    let rows: Rows<'_> = rows.iter().collect();
    let mut page = Page::of(prose, &[("bound", &3)]);
    page.part_of("Errors", Line::from(rows).with("method", "b"));
    page.part_of("Others", Line::default());
    assert_eq!(
        page.text,
        "# A\n\n## Errors\n\nAt most 2.00 by b, of size – (3 asked).\n\nThe prose has no `Others`.\n"
    );
}

#[test]
fn a_line_for_each_combination_that_there_is() {
    let row =
        |method: &str, n: usize, error: f64| Row::default().with("method", method).with("n", n).with("error", error);
    let rows = [row("b", 2, 1.0), row("c", 1, 3.0), row("b", 1, 2.0)];
    let rows: Rows<'_> = rows.iter().collect();
    let prose = "# A\n\n### b\n\n| of | other |\n| --- | --- |\n| {method}{n}: {error} | {better} to {worse} |\n";
    let mut page = Page::of(prose, &[]);
    let contest = |line: &Line<'_>| line.rows.against(&rows.with("n", 1_usize), ("error", &["method"]), 1.0);
    let lines = rows.lines_of(["method", "n"]).into_iter();
    page.lines("b", lines.map(|line| line.clone().with_contest(contest(&line))));
    for line in [
        "| b2: 1.00 | 1 to 0 |",
        "| b1: 2.00 | 0 to 0 |",
        "| c1: 3.00 | 0 to 0 |",
    ] {
        assert!(page.text.contains(line), "{line} is missing in {}", page.text);
    }
    assert!(!page.text.contains("c2"));
}

#[test]
fn lists_of_the_prose_say_what_stands_in_every_line() {
    let prose = "# A\n\n## Misses\n\nThese:\n\n- `{text case}`: {error}\n\n- `{text case}`: {text reason}\n\nNone.\n\n### bare\n\n- {case}\n";
    let rows = [
        Row::of("a[1]").with("error", 2.0),
        Row::of("b").with("reason", "out"),
        Row::of("c"),
    ];
    let mut page = Page::of(prose, &[]);
    page.list_of("Misses", &rows);
    page.list_of("Misses", Rows::default().iter());
    page.list_of("bare", Rows::default().iter());
    page.list_of("bare", &rows[1..2]);
    let lines = "- `a[1]`: 2.00\n- `b`: out\n- `c`: –\n";
    let expected = format!("# A\n\n## Misses\n\nThese:\n\n{lines}\n## Misses\n\nNone.\n\n- b\n");
    assert_eq!(page.text, expected);
}

#[test]
fn a_list_without_lines_says_so_or_nothing() {
    let mut page = Page::default();
    page.list("Misses", &[], None);
    page.list("Misses", &[], Some("None."));
    page.list("Misses", &["- a".to_owned(), "- b".to_owned()], None);
    page.items(&[]);
    assert_eq!(page.text, "\n## Misses\n\nNone.\n\n## Misses\n\n- a\n- b\n");
}

#[test]
fn names_that_markdown_would_read_stand_as_they_are() {
    let prose =
        "# A\n\n### b\n\n| method | {name} |\n| --- | --- |\n| {first method} | {first x where method = {name}} |\n";
    let mut page = Page::of(prose, &[]);
    let rows = [Row::of("a").with("method", "<b>*|&`").with("x", 3.0)];
    let rows: Rows<'_> = rows.iter().collect();
    page.lines_over("b", &[each("name", ["<b>*|&`"])], [rows]);
    let name = "&lt;b>\\*\\|&amp;\\`";
    assert!(page.text.contains(&format!("| method | {name} |\n")), "{}", page.text);
    assert!(page.text.contains(&format!("| {name} | 3.00 |\n")), "{}", page.text);
}

#[test]
fn numbers_keep_their_digits_when_they_round_up() {
    let cases = [
        (9.994, "9.99"),
        (9.9996, "10.0"),
        (-0.99999, "-1.00"),
        (99_999.6, "1.00e5"),
        (9.996e-4, "0.00100"),
    ];
    for (value, text) in cases
        .into_iter()
        .chain([(1e-4, "1.00e-4"), (12_345.0, "12345"), (0.0, "0")])
    {
        assert_eq!(number_of(value, 3), text);
    }
}

#[test]
fn one_is_counted_as_one_and_digits_tell_values_apart() {
    let page = Page::of("# A\n\n{seeds} seeds, {runs} runs.\n", &[("seeds", &1), ("runs", &12)]);
    assert_eq!(page.text, "# A\n\n1 seed, 12 runs.\n");
    assert_eq!(
        (counted(1, "meshes"), counted(2, "meshes")),
        ("1 mesh".to_owned(), "2 meshes".to_owned())
    );
    let several = ["particles", "sample points", "cases", "columns", "rows"];
    assert_eq!(
        several.map(|many| counted(1, many)),
        ["1 particle", "1 sample point", "1 case", "1 column", "1 row"]
    );
    let digits = telling_digits(&[12.5012, 12.5034, 12.5034]);
    assert_eq!((digits, number_of(12.5012, digits)), (5, "12.501".to_owned()));
    assert_eq!(telling_digits(&[1.0, 1.0 + 1e-12, 2.0]), 3);
    let beside = |value: f64, reference: Option<f64>| number_beside(value, reference, 3);
    assert_eq!(
        [
            beside(0.5, Some(1.0)),
            beside(0.5, Some(0.0)),
            beside(0.5, None),
            beside(5e3, Some(1.0))
        ],
        ["0.5000", "0.500", "0.500", "5000"]
    );
}
