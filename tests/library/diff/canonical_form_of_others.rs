//! Canonical form of SVG files by other programs and of random paths: expected texts, idempotence and equal
//! pictures.

use crate::library::support::measures::canonical_checks::{assert_same_picture, canonical_form};
use ligne::diff::canonical_svg;

fn svg(inside: &str) -> String {
    format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" xmlns:xlink=\"http://www.w3.org/1999/xlink\" width=\"40\" height=\"40\">{inside}</svg>"
    )
}

/// Two lines that the canonical form reorders and reverses.
const TWO: &str = "<path d=\"M9 20L1 20\"/><path d=\"M9 10L1 10\"/>";
/// `TWO` with canonical numbers only. `FORM` is its full canonical form.
const ROUNDED: &str = "<path d=\"M9 20h-8\"/><path d=\"M9 10h-8\"/>";
const FORM: &str = "<path d=\"M1 10h8\"/><path d=\"M1 20h8\"/>";

#[test]
fn canonical_form_keeps_everything_that_may_change_the_picture() {
    let line = "fill=\"none\" stroke=\"#000\"";
    let lines = |paths: &str| format!("<g {line}>{paths}</g>");
    let as_it_is = |text: &str| (text.to_owned(), text.to_owned());
    let marked = "<marker id=\"m\"><path d=\"M0 0L1 0\"/></marker>";
    let cases: Vec<(String, String)> = vec![
        (lines(TWO), lines(FORM)),
        // Layout, comments, other attributes and quotes stay.
        (
            lines("\r\n  <path d='M9 20L1 20' id='a' class=\"x\"/>\n\t<path\n d='M9 10L1 10'></path>\n"),
            lines("\r\n  <path\n d='M1 10h8'></path>\n\t<path d='M1 20h8' id='a' class=\"x\"/>\n"),
        ),
        (
            lines("<path d=\"M9 20L1 20\"/><!-- a --><path d=\"M9 10L1 10\"/>"),
            lines("<path d=\"M1 20h8\"/><!-- a --><path d=\"M1 10h8\"/>"),
        ),
        // Lines with different paint, or with another element between them, keep their order.
        (
            lines("<path stroke=\"red\" d=\"M9 20L1 20\"/><path d=\"M9 10L1 10\"/>"),
            lines("<path stroke=\"red\" d=\"M1 20h8\"/><path d=\"M1 10h8\"/>"),
        ),
        (
            lines("<path d=\"M9 20L1 20\"/><rect width=\"2\" height=\"3\"/><path d=\"M9 10L1 10\"/>"),
            lines("<path d=\"M1 20h8\"/><rect width=\"2\" height=\"3\"/><path d=\"M1 10h8\"/>"),
        ),
        // Styles become attributes. With scripts, media rules or other unknown CSS, paths keep their order
        // and direction.
        (format!("<g style=\"fill : none; stroke:#123\">{TWO}</g>"), format!("<g fill=\"none\" stroke=\"#123\">{FORM}</g>")),
        (
            format!("<style>path {{ stroke-dasharray: 3 }}</style>{}", lines(TWO)),
            // Dashed lines keep their direction and may be reordered.
            lines("<path d=\"M9 10h-8\"/><path d=\"M9 20h-8\"/>").replace("<path", "<path stroke-dasharray=\"3\""),
        ),
        (
            format!("<style>g &gt; .a {{ stroke:red; fill:none !important }} path {{ stroke: blue }}</style><g><path class=\"a\" fill=\"#000\" stroke=\"#000\" style='stroke-width:2;fill:green' d=\"M1 1h2\"/>{TWO}</g>"),
            format!("<g><path stroke=\"red\" fill=\"none\" stroke-width=\"2\" class=\"a\" d=\"M1 1h2\"/>{}</g>", ROUNDED.replace("<path", "<path stroke=\"blue\"")),
        ),
        (
            format!("<style>@media print {{ path {{ stroke: red }} }}</style><g style=\"fill:none\">{TWO}</g>"),
            format!("<style>@media print {{ path {{ stroke: red }} }}</style><g style=\"fill:none\">{ROUNDED}</g>"),
        ),
        (
            format!("<style>path:hover {{ stroke: red }}</style><g style=\"fill:none\">{TWO}</g>"),
            format!("<style>path:hover {{ stroke: red }}</style><g style=\"fill:none\">{ROUNDED}</g>"),
        ),
        (
            format!("<g style=\"fill:none;stroke:#000;-inkscape-stroke:none\">{TWO}</g>"),
            format!("<g fill=\"none\" stroke=\"#000\" style=\"-inkscape-stroke:none\">{FORM}</g>"),
        ),
        (format!("<script>x</script>{}", lines(TWO)), format!("<script>x</script>{}", lines(ROUNDED))),
        (
            format!("<g style=\"fill:none;stroke:var(--ink)\">{TWO}</g>"),
            format!("<g style=\"fill:none;stroke:var(--ink)\">{ROUNDED}</g>"),
        ),
        // Marks with fill and stroke, gradients or blend modes keep their order.
        (
            "<path fill=\"red\" stroke=\"#000\" d=\"M5 5H9V9Z\"/><path fill=\"red\" stroke=\"#000\" d=\"M3 1H7V7Z\"/>".into(),
            "<path fill=\"red\" stroke=\"#000\" d=\"M5 5h4v4z\"/><path fill=\"red\" stroke=\"#000\" d=\"M3 1h4v6z\"/>".into(),
        ),
        (
            "<linearGradient id=\"g\"/><path fill=\"url(#g)\" d=\"M5 5H9V9Z\"/><path fill=\"url(#g)\" d=\"M3 1H7V7Z\"/>".into(),
            "<linearGradient id=\"g\"/><path fill=\"url(#g)\" d=\"M5 5h4v4z\"/><path fill=\"url(#g)\" d=\"M3 1h4v6z\"/>".into(),
        ),
        (
            "<path style=\"mix-blend-mode:difference\" d=\"M5 5H9V9Z\"/><path style=\"mix-blend-mode:difference\" d=\"M3 1H7V7Z\"/>".into(),
            "<path style=\"mix-blend-mode:difference\" d=\"M5 5h4v4z\"/><path style=\"mix-blend-mode:difference\" d=\"M3 1h4v6z\"/>".into(),
        ),
        // Holes stay holes. Regions start at their smallest point.
        ("<path d=\"M9 9V1H1V9ZM3 3V5H5V3Z\"/>".into(), "<path d=\"M1 1v8h8v-8zm2 2v2h2v-2z\"/>".into()),
        ("<path fill=\"red\" stroke=\"#000\" d=\"M9 9L1 1L9 1\"/>".into(), "<path fill=\"red\" stroke=\"#000\" d=\"M9 9l-8-8h8\"/>".into()),
        // A dashed path keeps its start.
        (
            lines("<path stroke-dasharray=\"2 1\" d=\"M9 20L1 20\"/>"),
            lines("<path stroke-dasharray=\"2 1\" d=\"M9 20h-8\"/>"),
        ),
        (
            format!("<g stroke-dasharray=\"2 1\">{}</g>", lines("<path stroke-dasharray=\"none\" d=\"M9 20L1 20\"/>")),
            format!("<g stroke-dasharray=\"2 1\">{}</g>", lines("<path stroke-dasharray=\"none\" d=\"M1 20h8\"/>")),
        ),
        // Paths that are reused, have markers or are animated keep their order and direction.
        (
            format!("<g id=\"a\">{}</g><use xlink:href=\"#a\" stroke-dasharray=\"2\"/>", lines(TWO)),
            format!("<g id=\"a\">{}</g><use xlink:href=\"#a\" stroke-dasharray=\"2\"/>", lines(ROUNDED)),
        ),
        (
            format!("{marked}<g marker-start=\"url(#m)\">{}</g>", lines(TWO)),
            format!("{}<g marker-start=\"url(#m)\">{}</g>", marked.replace("L1 0", "h1"), lines(ROUNDED)),
        ),
        as_it_is(&format!("{}<path marker-mid=\"url(#m)\" d=\"M9 20L1 20L1 20.0Z\"/>", marked.replace("L1 0", "h1"))),
        as_it_is(&format!("{}<path marker-mid=\"url(#m)\" d=\"M9 20L1 20L3 5L9 20Z\"/>", marked.replace("L1 0", "h1"))),
        (
            lines("<path d=\"M9 20L1 20\"><animate attributeName=\"d\" values=\"M9 20L1 20;M1 1L2 2\"/></path>"),
            lines("<path d=\"M9 20h-8\"><animate attributeName=\"d\" values=\"M9 20L1 20;M1 1L2 2\"/></path>"),
        ),
        (
            "<defs><path id=\"t\" d=\"M9 20L1 20\"/></defs><text><textPath href=\"#t\">x</textPath></text>".into(),
            "<defs><path id=\"t\" d=\"M9 20h-8\"/></defs><text><textPath href=\"#t\">x</textPath></text>".into(),
        ),
        (
            "<clipPath id=\"c\"><path fill=\"none\" stroke=\"#000\" d=\"M9 9V1H1V9ZM3 3V5H5V3Z\"/></clipPath>".into(),
            "<clipPath id=\"c\"><path fill=\"none\" stroke=\"#000\" d=\"M9 9v-8h-8v8zm-6-6v2h2v-2z\"/></clipPath>".into(),
        ),
        (
            format!("<switch {line}><path d=\"M9 20L1 20\"/><path d=\"M9 10L1 10\"/></switch>"),
            format!("<switch {line}><path d=\"M1 20h8\"/><path d=\"M1 10h8\"/></switch>"),
        ),
        // Plotter order is kept.
        (format!("<g data-order=\"travel\">{}</g>", lines(TWO)), format!("<g data-order=\"travel\">{}</g>", lines(ROUNDED))),
        // Arcs and invalid path data stay unchanged. Other paths still get their canonical form.
        (
            lines("<path d=\"M9 20A4 4 0 0 1 1 20\"/><path d=\"M9 10L1 10\"/>"),
            lines("<path d=\"M1 10h8\"/><path d=\"M9 20A4 4 0 0 1 1 20\"/>"),
        ),
        as_it_is("<path d=\"\"/><path/><path d=\"M1 1 L 5 5 6\"/><path d=\"M9 20L 1\"/><path d=\"none\"/>"),
        as_it_is("<path d=\"M99999999.12345678 1L 5 5.12345678\"/>"),
        // A move without a line draws nothing. A line of zero length draws a dot.
        as_it_is(&lines("<path d=\"M3 3M9 20L1 20M5 5\"/>")),
        (lines("<path d=\"M3 3L3 3\"/>"), lines("<path d=\"M3 3h0\"/>")),
    ];
    for (before, after) in cases {
        let (before, after) = (svg(&before), svg(&after));
        let found = canonical_form(&before);
        assert_eq!(found, after, "of {before}");
        assert_eq!(canonical_form(&found), found);
        if !before.contains("99999999") {
            assert_same_picture(&before, &after, &before);
        }
    }
}

#[test]
fn canonical_form_keeps_declarations_and_entities() {
    let declared = "<?xml version=\"1.0\"?>\n<!DOCTYPE svg [<!ENTITY ns \"http://x\"><!ENTITY two '<path d=\"M9 9L1 9\"/><path d=\"M9 1L1 1\"/>'>]>\n";
    let body = |paths: &str| {
        format!(
            "{declared}{}",
            svg(&format!("<g fill=\"none\" stroke=\"#000\" data-x=\"&ns;\">{paths}</g>\n<!-- end -->"))
                + "\n<!-- after -->\n"
        )
    };
    let before = body("&two;<path d=\"M9 20L1 20\"/> &two; <path d=\"M9&#32;10L1&#10;10\"/>");
    let after = body("&two;<path d=\"M1 20h8\"/> &two; <path d=\"M1 10h8\"/>");
    assert_eq!(canonical_form(&before), after);
    let marked = format!("\u{feff}{}", svg(TWO));
    assert_eq!(
        canonical_form(&marked),
        format!("\u{feff}{}", svg("<path d=\"M9 10h-8\"/><path d=\"M9 20h-8\"/>"))
    );
}

/// Xorshift random numbers.
struct Random(u64);

impl Random {
    fn below(&mut self, n: u64) -> u64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        self.0 % n
    }

    /// A coordinate with few decimals, so that equal coordinates are common.
    fn number(&mut self) -> String {
        let digits = self.below(4) as usize;
        format!("{:.digits$}", self.below(40_000) as f64 / if self.below(3) == 0 { 1000.0 } else { 10_000.0 })
    }

    fn data(&mut self) -> String {
        let mut data = format!("M{} {}", self.number(), self.number());
        for _ in 0..self.below(7) {
            let letter = b"LLLHVCSQTZMlhvcsqtzm"[self.below(20) as usize];
            data.push(char::from(letter));
            let count = match letter.to_ascii_uppercase() {
                b'L' | b'T' | b'M' => 2,
                b'H' | b'V' => 1,
                b'C' => 6,
                b'S' | b'Q' => 4,
                _ => 0,
            };
            (0..count).for_each(|_| data += &format!("{} ", self.number()));
        }
        data
    }
}

#[test]
fn canonical_form_is_idempotent() {
    let mut random = Random(88_172_645_463_325_252);
    let paints = [
        "fill=\"none\" stroke=\"#000\" stroke-width=\".3\"",
        "fill=\"none\" stroke=\"#000\" stroke-opacity=\".5\" stroke-width=\".3\"",
        "fill=\"#a00\" fill-opacity=\".5\"",
        "fill=\"#a00\" fill-rule=\"evenodd\"",
        "fill=\"#a00\" stroke=\"#00a\" stroke-width=\".2\"",
        "fill=\"none\" stroke=\"#000\" stroke-width=\".2\" stroke-dasharray=\"1 .5\"",
        "style=\"fill:none;stroke:#00a;stroke-linecap:round;stroke-width:0.4\"",
    ];
    for round in 0..400 {
        let paths: String = (0..1 + random.below(12))
            .map(|_| {
                format!(
                    "<path {} d=\"{}\"/>\n",
                    paints[random.below(3) as usize + (round % 5)],
                    random.data()
                )
            })
            .collect();
        let before = svg(&paths)
            .replace("width=\"40\" height=\"40\"", "width=\"200\" height=\"200\" viewBox=\"0 0 8 8\"");
        for precision in [None, Some(3), Some(1), Some(8)] {
            let once = canonical_svg(&before, precision).unwrap();
            let twice = canonical_svg(&once, precision).unwrap();
            assert_eq!(once, twice, "{precision:?} {before}");
        }
        if round % 4 == 0 {
            assert_same_picture(&before, &canonical_svg(&before, Some(8)).unwrap(), &before);
        }
    }
}
