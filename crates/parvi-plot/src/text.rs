//! Text in figures: superscripts and subscripts, width estimates, escaping and numbers.

use super::style::TEXT_SIZE;

/// Where a text sits relative to its anchor point, horizontally.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Anchor {
    /// The text starts at the point.
    Start,
    /// The text is centred on the point.
    Middle,
    /// The text ends at the point.
    End,
}

/// How a text is set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextStyle {
    /// The font size in points.
    pub size: f64,
    /// The horizontal alignment.
    pub anchor: Anchor,
    /// Whether the text is bold.
    pub bold: bool,
    /// Whether the text runs upwards.
    pub upwards: bool,
}

impl TextStyle {
    /// Plain text of the size of tick labels.
    pub const fn plain(anchor: Anchor) -> TextStyle {
        TextStyle::sized(TEXT_SIZE, anchor)
    }

    /// Plain text of the given size.
    pub const fn sized(size: f64, anchor: Anchor) -> TextStyle {
        TextStyle {
            size,
            anchor,
            bold: false,
            upwards: false,
        }
    }
}

/// The size of superscripts and subscripts relative to the text.
const SCRIPT: f64 = 0.78;
/// How far a superscript is raised, relative to the text size.
const RAISE: f64 = 0.38;
/// How far a subscript is lowered.
const LOWER: f64 = 0.2;

/// A stretch of text on one level.
#[derive(Debug, Clone, PartialEq)]
struct Run {
    text: String,
    /// The shift of the baseline in text sizes, upwards positive.
    shift: f64,
}

/// Splits `label` at `^{…}` and `_{…}`; an unclosed brace is ordinary text. Superscripts that Unicode has characters for are text on the baseline: converters of SVG misplace what is shifted.
fn runs(label: &str) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let mut push = |text: String, shift: f64| match runs.last_mut() {
        _ if text.is_empty() => {}
        Some(last) if last.shift == shift => last.text.push_str(&text),
        _ => runs.push(Run { text, shift }),
    };
    let mut rest = label;
    loop {
        let opening = ["^{", "_{"]
            .iter()
            .filter_map(|mark| rest.find(mark))
            .min()
            .and_then(|start| Some((start, start + 2 + rest[start + 2..].find('}')?)));
        let Some((start, end)) = opening else {
            push(rest.to_owned(), 0.0);
            return runs;
        };
        push(rest[..start].to_owned(), 0.0);
        let inner = &rest[start + 2..end];
        let raised = rest[start..].starts_with('^');
        match inner.chars().map(superscript).collect::<Option<String>>() {
            Some(text) if raised => push(text, 0.0),
            _ => push(inner.to_owned(), if raised { RAISE } else { -LOWER }),
        }
        rest = &rest[end + 1..];
    }
}

/// The character that is this one as a superscript, for those of whole numbers.
fn superscript(character: char) -> Option<char> {
    let place = "0123456789-−+".chars().position(|known| known == character)?;
    "⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁻⁺".chars().nth(place)
}

/// The label without its markup, e.g. for a document's title.
pub fn plain_text(label: &str) -> String {
    runs(label).into_iter().map(|run| run.text).collect()
}

/// The content of a `<text>` element for `label`, in which `^{…}` and `_{…}` mark superscripts and subscripts.
pub fn markup(label: &str, size: f64) -> String {
    let mut level = 0.0;
    let mut content = String::new();
    for run in runs(label) {
        if run.shift == level && run.shift == 0.0 {
            content.push_str(&escape(&run.text));
            continue;
        }
        // Some viewers drop a space at the start of a stretch, so it becomes a shift.
        let text = run.text.trim_start_matches([' ', '\u{a0}']);
        let spaces = run.text.chars().count() - text.chars().count();
        let gap = match spaces {
            0 => String::new(),
            _ => format!(" dx=\"{}\"", number(0.32 * size * spaces as f64)),
        };
        let step = number((level - run.shift) * size);
        level = run.shift;
        let small = match run.shift {
            0.0 => String::new(),
            _ => format!(" font-size=\"{}\"", number(SCRIPT * size)),
        };
        let text = escape(text);
        content.push_str(&format!("<tspan{gap} dy=\"{step}\"{small}>{text}</tspan>"));
    }
    content
}

/// An estimate of the label's width in points, from the advance widths of DejaVu Sans, the widest of the font families.
pub fn width(label: &str, size: f64) -> f64 {
    runs(label)
        .iter()
        .map(|run| {
            let scale = if run.shift == 0.0 { size } else { SCRIPT * size };
            run.text.chars().map(advance).sum::<f64>() * scale
        })
        .sum()
}

/// The beginning of a label with `…` behind it that is no wider than `room`; the label itself where it fits.
pub fn cut(label: &str, room: f64, size: f64) -> String {
    if width(label, size) <= room {
        return label.to_owned();
    }
    let start = |end: usize| format!("{}…", label[..end].trim_end());
    let ends: Vec<usize> = label.char_indices().map(|(end, _)| end).collect();
    let fitting = ends.partition_point(|&end| width(&start(end), size) <= room);
    let end = fitting.checked_sub(1).map_or(0, |last| ends[last]);
    // Within a superscript or subscript nothing is cut.
    let opening = ["^{", "_{"].iter().filter_map(|mark| label[..end].rfind(mark)).max();
    let open = opening.filter(|&opening| !label[opening..end].contains('}'));
    start(open.unwrap_or(end))
}

/// Breaks a text at spaces into lines of at most `room` points where words allow.
pub fn wrap(text: &str, room: f64, size: f64) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split(' ').filter(|word| !word.is_empty()) {
        match lines.last_mut() {
            Some(line) if width(line, size) + width(word, size) + 0.32 * size <= room => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}

/// The advance width of a character in ems.
fn advance(character: char) -> f64 {
    match character {
        'i' | 'j' | 'l' | '\'' => 0.28,
        ' ' | '\u{a0}' | '.' | ',' | '·' => 0.32,
        ':' | ';' | '|' | '/' | '\\' | 'I' | 'J' => 0.34,
        'f' | 't' | 'r' | '(' | ')' | '[' | ']' | '-' => 0.4,
        's' | 'c' | 'z' | '*' => 0.53,
        'w' | '−' | '+' | '=' | '<' | '>' | '×' | '±' | '≤' | '≥' | '≈' | '∝' | '_' => 0.84,
        'm' | 'W' | '—' | '%' | '…' => 0.99,
        'M' | '@' => 0.9,
        '⁰' | '¹' | '²' | '³' | '⁴'..='⁹' => 0.4,
        '⁻' | '⁺' => 0.53,
        'A'..='H' | 'K' | 'L' | 'N'..='V' | 'X'..='Z' => 0.73,
        _ => 0.64,
    }
}

/// Escapes the characters that XML reserves and drops the control characters that it forbids.
pub fn escape(text: &str) -> String {
    let is_forbidden = |c: char| c.is_control() || c == '\u{fffe}' || c == '\u{ffff}';
    let allowed = text.replace(is_forbidden, " ").replace('&', "&amp;");
    allowed.replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// A coordinate with at most two decimals and no superfluous zeros. Not a number becomes 0: no drawing may contain it.
pub fn number(value: f64) -> String {
    if !value.is_finite() {
        return "0".to_string();
    }
    let text = format!("{:.2}", value.clamp(-1e6, 1e6));
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0".to_string(),
        shortest => shortest.to_string(),
    }
}

/// A number for a reader: a true minus sign, `decimals` decimals.
pub fn decimal(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(rest) if rest.chars().all(|c| c == '0' || c == '.') => rest.to_string(),
        Some(rest) => format!("−{rest}"),
        None => text,
    }
}

/// A power of ten for a reader, with markup.
pub fn power_of_ten(exponent: i32) -> String {
    format!("10^{{{}}}", decimal(f64::from(exponent), 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_are_short() {
        assert_eq!(number(1.0), "1");
        assert_eq!(number(-0.001), "0");
        assert_eq!(number(12.345), "12.35");
        assert_eq!(number(100.0), "100");
        assert_eq!(number(f64::NAN), "0");
        assert_eq!(decimal(-0.001, 2), "0.00");
        assert_eq!(decimal(-1.5, 1), "−1.5");
    }

    #[test]
    fn scripts_return_to_the_baseline() {
        assert_eq!(
            markup("a^{n} < b", 10.0),
            "a<tspan dy=\"-3.8\" font-size=\"7.8\">n</tspan><tspan dx=\"3.2\" dy=\"3.8\">&lt; b</tspan>"
        );
        assert_eq!(plain_text("x_{1} (10^{n} m)"), "x1 (10n m)");
        assert_eq!(markup("x_{1", 10.0), "x_{1");
        assert!(width("10^{n}", 10.0) < width("10n", 10.0));
    }

    #[test]
    fn what_is_too_wide_is_cut_at_its_end() {
        assert_eq!(cut("short", 100.0, 10.0), "short");
        let label = "a long label of ED^{mean square} in units of its own";
        for room in [0.0, 8.0, 50.0, 120.0, 160.0, 200.0] {
            let shown = cut(label, room, 10.0);
            assert!(
                width(&shown, 10.0) <= room.max(10.0) && shown.ends_with('…'),
                "{room}: {shown}"
            );
            assert_eq!(shown.matches('{').count(), shown.matches('}').count(), "{shown}");
        }
        assert_eq!(cut("öäü µm", 25.0, 10.0), "öä…");
    }

    #[test]
    fn whole_exponents_are_characters() {
        assert_eq!(markup("a^{2} < b", 10.0), "a² &lt; b");
        assert_eq!(markup(&power_of_ten(-14), 10.0), "10⁻¹⁴");
        assert_eq!(markup("10^{+567890}", 10.0), "10⁺⁵⁶⁷⁸⁹⁰");
        assert_eq!(plain_text("10^{3} m"), "10³ m");
        assert!(width("10^{2}", 10.0) < width("102", 10.0));
        assert!(markup("h^{1/2}", 10.0).contains("<tspan"));
    }
}
