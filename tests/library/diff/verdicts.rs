//! Verdicts on edited drawings: a table of edits to a small SVG with the expected findings in both
//! directions.

use ligne::diff::{self, Change, Diff, DiffOptions, Picture, Stage, Tolerances, Verdict};

/// Small drawing as ligne writes it. The tests edit its text.
const BASE: &str = r##"<svg xmlns="http://www.w3.org/2000/svg" xmlns:inkscape="http://www.inkscape.org/namespaces/inkscape" width="200" height="100" viewBox="0 0 200 100">
<title>plate</title>
<g id="paper" inkscape:groupmode="layer" inkscape:label="paper">
<rect width="200" height="100" fill="#fff"/>
</g>
<g id="fills" inkscape:groupmode="layer" inkscape:label="fills">
<path class="tone-1" data-part="plate" data-material="steel" data-tone="1" fill="#c7c9cf" d="M10 10h80v80h-80zm30 30v20h20v-20z"/>
<path class="tone-0" data-part="bolt" data-material="zinc" data-tone="0" fill="#9ea3a8" d="M120 30h30v30h-30z"/>
</g>
<g id="lines" inkscape:groupmode="layer" inkscape:label="lines" fill="none" stroke="#1a1a1a" stroke-linecap="round" stroke-linejoin="round">
<path class="crease" data-part="plate" d="M20.25 20.5l60 1.25"/>
<path class="crease" data-part="bolt" d="M125 35c5 5 10 5 20 0"/>
<path class="contour silhouette" data-part="plate" stroke-width="2.2" d="M10 10h80v80h-80z"/>
<path class="contour" data-part="bolt" stroke-width="1.6" stroke-dasharray="4 2" d="M170 10v80"/>
</g>
</svg>
"##;

fn compare_with(before: &str, after: &str, options: &DiffOptions) -> Diff {
    let read = |svg: &str| Picture::from_svg(svg).unwrap_or_else(|error| panic!("{error}\n{svg}"));
    diff::compare(&read(before), &read(after), options)
}

fn compare(before: &str, after: &str) -> Diff {
    compare_with(before, after, &DiffOptions::default())
}

/// `BASE` with one piece of text replaced.
fn edited(from: &str, to: &str) -> String {
    assert!(BASE.contains(from), "{from} is not in the drawing");
    BASE.replacen(from, to, 1)
}

/// All findings in one line, sorted, such as `moved crease of plate`.
fn findings_text(diff: &Diff) -> String {
    let mut words: Vec<String> = diff
        .findings
        .iter()
        .map(|f| format!("{} {} of {}", f.verdict.name(), f.label.kind(), f.label.part_name()))
        .collect();
    words.sort();
    words.join(", ")
}

const CREASE: &str = r#"d="M20.25 20.5l60 1.25""#;
const CURVE: &str = r#"d="M125 35c5 5 10 5 20 0""#;
const FRAME: &str = r#"stroke-width="2.2" d="M10 10h80v80h-80z""#;

/// Edits that do not change the picture.
#[test]
fn edits_that_keep_the_picture_compare_as_equal() {
    let flat: String = (0..=64)
        .map(|i| {
            let t = f64::from(i) / 64.0;
            let u = 1.0 - t;
            // Cubic from (125, 35) with control points (130, 40) and (135, 40) to (145, 35).
            let at = |a: f64, b: f64, c: f64, d: f64| {
                a * u * u * u + 3.0 * b * u * u * t + 3.0 * c * u * t * t + d * t * t * t
            };
            let command = if i == 0 { 'M' } else { 'L' };
            format!("{command}{:.3} {:.3}", at(125.0, 130.0, 135.0, 145.0), at(35.0, 40.0, 40.0, 35.0))
        })
        .collect();
    let in_mm = BASE.replace(
        r#"width="200" height="100" viewBox"#,
        r#"width="52.916667mm" height="26.458333mm" viewBox"#,
    );
    let wrapped = BASE
        .replacen(
            "<title>",
            "<g transform=\"translate(5 -3) scale(2)\"><g transform=\"scale(.5) translate(-5 3)\"><g><title>",
            1,
        )
        .replace("</svg>", "</g></g></g></svg>");
    let wrapped = wrapped
        .replace("translate(5 -3) scale(2)", "translate(5 -3)")
        .replace("scale(.5) translate(-5 3)", "translate(-5 3)");
    let by_part = r##"<svg xmlns="http://www.w3.org/2000/svg" width="200" height="100"><rect width="200" height="100" fill="#fff"/>
<g id="part-plate"><title>plate</title><path class="tone-1" data-part="plate" fill="#c7c9cf" d="M10 10h80v80h-80zm30 30v20h20v-20z"/>
<path class="crease" data-part="plate" fill="none" stroke="#1a1a1a" stroke-linecap="round" stroke-linejoin="round" d="M20.25 20.5l60 1.25"/>
<path class="contour silhouette" data-part="plate" fill="none" stroke="#1a1a1a" stroke-linecap="round" stroke-linejoin="round" stroke-width="2.2" d="M10 10h80v80h-80z"/></g>
<g id="part-bolt"><title>bolt</title><path class="tone-0" data-part="bolt" fill="#9ea3a8" d="M120 30h30v30h-30z"/>
<g fill="none" stroke="#1a1a1a" stroke-linecap="round" stroke-linejoin="round"><path class="crease" data-part="bolt" d="M125 35c5 5 10 5 20 0"/>
<path class="contour" data-part="bolt" stroke-width="1.6" stroke-dasharray="4 2" d="M170 10v80"/></g></g></svg>"##;
    let line = "<path class=\"crease\" data-part=\"plate\" d=\"M20.25 20.5l60 1.25\"/>\n";
    let edits = [
        ("the same bytes", BASE.to_owned(), Stage::Bytes),
        ("a comment", edited("<title>", "<!-- by hand --><title>"), Stage::Structure),
        ("another title", edited("<title>plate<", "<title>sheet<"), Stage::Structure),
        ("indented", BASE.replace("\n<path", "\n\t\t<path"), Stage::Structure),
        ("numbers written out", edited(CREASE, r#"d="M20.250 20.50 L 80.25,21.750""#), Stage::Structure),
        (
            "attributes in another order",
            edited(r#"class="crease" data-part="plate" "#, r#"data-part="plate" class="crease" "#),
            Stage::Structure,
        ),
        ("classes in another order", edited("contour silhouette", "silhouette contour"), Stage::Structure),
        (
            "a line last instead of first",
            edited(line, "").replace("</g>\n</svg>", &format!("{line}</g>\n</svg>")),
            Stage::Structure,
        ),
        (
            "an attribute moved to its mark",
            edited(FRAME, r#"style="stroke-width:2.2px" d="M10 10h80v80h-80z""#),
            Stage::Structure,
        ),
        (
            "a style sheet",
            edited("<title>", "<style>.crease{stroke:#1a1a1a;fill:none}</style><title>"),
            Stage::Structure,
        ),
        ("a colour by another name", edited("#fff", "white"), Stage::Structure),
        ("a group more", edited(line, &format!("<g>{line}</g>")), Stage::Structure),
        ("no layers", by_part.to_owned(), Stage::Structure),
        ("path reversed", edited(CREASE, r#"d="M80.25 21.75l-60-1.25""#), Stage::Geometry),
        ("path split", edited(CREASE, r#"d="M20.25 20.5l30 .625m0 0 30 .625""#), Stage::Geometry),
        (
            "path split in two marks",
            edited(
                line,
                &[
                    line.replace("l60 1.25", "l30 .625"),
                    line.replace("M20.25 20.5l60 1.25", "M50.25 21.125l30 .625"),
                ]
                .concat(),
            ),
            Stage::Geometry,
        ),
        ("a point more", edited(CREASE, r#"d="M20.25 20.5l12 .25 48 1""#), Stage::Geometry),
        ("curve flattened", edited(CURVE, &format!("d=\"{flat}\"")), Stage::Geometry),
        (
            "curve as two",
            edited(CURVE, r#"d="M125 35c2.5 2.5 5 3.75 8.125 3.75s6.875-1.25 11.875-3.75""#),
            Stage::Geometry,
        ),
        (
            "another start point",
            edited(FRAME, r#"stroke-width="2.2" d="M90 90h-80v-80h80z""#),
            Stage::Geometry,
        ),
        ("turned round", edited(FRAME, r#"stroke-width="2.2" d="M10 10v80h80v-80z""#), Stage::Geometry),
        (
            "a rectangle instead of a path",
            edited("d=\"M120 30h30v30h-30z\"/>", "d=\"M120 30V60H150V30Z\"/>"),
            Stage::Geometry,
        ),
        ("moved by less than the tolerance", edited(CREASE, r#"d="M20.26 20.51l60 1.25""#), Stage::Geometry),
        ("three decimals to two", edited(CREASE, r#"d="M20.254 20.496l60 1.25""#), Stage::Geometry),
        (
            "hole before frame",
            edited("M10 10h80v80h-80zm30 30v20h20v-20z", "M40 40v20h20v-20zM10 10h80v80h-80z"),
            Stage::Geometry,
        ),
        ("px as mm", in_mm, Stage::Geometry),
        ("wrapped in transforms that cancel", wrapped, Stage::Geometry),
        (
            "reused",
            edited(
                line,
                &format!(
                    "<defs>{}</defs><use href=\"#l\" class=\"crease\" data-part=\"plate\"/>",
                    line.replace("<path", "<path id=\"l\"")
                ),
            ),
            Stage::Geometry,
        ),
    ];
    for (what, after, stage) in edits {
        for (from, to) in [(BASE, after.as_str()), (after.as_str(), BASE)] {
            let diff = compare(from, to);
            assert!(diff.is_same(), "{what}: {:#?}", diff.lines());
            // Rounding may separate or merge points, so any stage from `Structure` on is accepted.
            let wanted = if stage == Stage::Bytes { Stage::Bytes } else { Stage::Structure };
            assert!(diff.same_at.is_some_and(|at| at >= wanted), "{what}: {:?}", diff.same_at);
        }
    }
}

/// Edits that change the picture, with the expected findings forwards and backwards.
#[test]
fn visible_edits_have_the_expected_findings() {
    let line = "<path class=\"crease\" data-part=\"plate\" d=\"M20.25 20.5l60 1.25\"/>\n";
    let bolt = "<path class=\"contour\" data-part=\"bolt\" stroke-width=\"1.6\" stroke-dasharray=\"4 2\" d=\"M170 10v80\"/>\n";
    let edits: Vec<(&str, String, &str, &str)> = vec![
        ("moved by 0.05", edited(CREASE, r#"d="M20.25 20.55l60 1.25""#), "moved crease of plate", "moved crease of plate"),
        ("moved by 0.5", edited(CREASE, r#"d="M20.25 21l60 1.25""#), "moved crease of plate", "moved crease of plate"),
        ("moved by 5", edited(CREASE, r#"d="M20.25 25.5l60 1.25""#), "moved crease of plate", "moved crease of plate"),
        ("slid along itself", edited(CREASE, r#"d="M26.25 20.625l60 1.25""#), "moved crease of plate", "moved crease of plate"),
        ("turned a little", edited(CREASE, r#"d="M20.25 20l60 2.5""#), "moved crease of plate", "moved crease of plate"),
        ("shortened", edited(CREASE, r#"d="M20.25 20.5l48 1""#), "reshaped crease of plate", "reshaped crease of plate"),
        ("a gap in it", edited(CREASE, r#"d="M20.25 20.5l24 .5m12 .25 24 .5""#), "reshaped crease of plate", "reshaped crease of plate"),
        ("bent", edited(CREASE, r#"d="M20.25 20.5l30 6 30-4.75""#), "reshaped crease of plate", "reshaped crease of plate"),
        ("a corner dragged", edited(FRAME, r#"stroke-width="2.2" d="M10 10h80l4 84-84-4z""#), "reshaped contour of plate", "reshaped contour of plate"),
        ("removed", edited(line, ""), "removed crease of plate", "added crease of plate"),
        ("drawn twice", edited(line, &line.repeat(2)), "added crease of plate", "removed crease of plate"),
        ("far away", edited(CREASE, r#"d="M20.25 95.5l60 1.25""#), "added crease of plate, removed crease of plate", "added crease of plate, removed crease of plate"),
        ("other colour", edited(line, &line.replace(" d=", " stroke=\"#c00\" d=")), "restyled crease of plate", "restyled crease of plate"),
        ("thicker", edited("stroke-width=\"2.2\"", "stroke-width=\"2.6\""), "restyled contour of plate", "restyled contour of plate"),
        ("no dashes", edited(" stroke-dasharray=\"4 2\"", ""), "restyled contour of bolt", "restyled contour of bolt"),
        ("longer dashes", edited("stroke-dasharray=\"4 2\"", "stroke-dasharray=\"6 2\""), "restyled contour of bolt", "restyled contour of bolt"),
        ("butt ends", edited(line, &line.replace(" d=", " stroke-linecap=\"butt\" d=")), "restyled crease of plate", "restyled crease of plate"),
        ("half seen through", edited(line, &line.replace(" d=", " opacity=\".5\" d=")), "restyled crease of plate", "restyled crease of plate"),
        ("a fill's colour", edited("#9ea3a8", "#aea3a8"), "restyled fills of bolt", "restyled fills of bolt"),
        ("a fill's tone", BASE.replace("class=\"tone-0\"", "class=\"tone-1\"").replace("data-tone=\"0\"", "data-tone=\"1\""), "restyled fills of bolt", "restyled fills of bolt"),
        ("the paper's colour", edited("#fff", "#ffe"), "restyled paper of no part", "restyled paper of no part"),
        ("a hole lost", edited("h-80zm30 30v20h20v-20z", "h-80z"), "reshaped fills of plate", "reshaped fills of plate"),
        ("a hole moved", edited("zm30 30v20h20v-20z", "zm33 30v20h20v-20z"), "reshaped fills of plate", "reshaped fills of plate"),
        ("a fill moved", edited("M120 30h30v30h-30z", "M121 30h30v30h-30z"), "moved fills of bolt", "moved fills of bolt"),
        ("a fill larger", edited("M120 30h30v30h-30z", "M120 30h34v30h-34z"), "reshaped fills of bolt", "reshaped fills of bolt"),
        ("a fill removed", edited(r##"<path class="tone-0" data-part="bolt" data-material="zinc" data-tone="0" fill="#9ea3a8" d="M120 30h30v30h-30z"/>"##, ""), "removed fills of bolt", "added fills of bolt"),
        ("a part renamed", BASE.replace("data-part=\"bolt\"", "data-part=\"screw\""), "relabelled mark of bolt", "relabelled mark of screw"),
        ("another class", edited(line, &line.replace("crease", "intersection")), "relabelled crease of plate", "relabelled intersection of plate"),
        ("another layer", edited(bolt, "").replace("</svg>", &format!("<g id=\"hidden-lines\" inkscape:groupmode=\"layer\" inkscape:label=\"hidden-lines\" fill=\"none\" stroke=\"#1a1a1a\" stroke-linecap=\"round\" stroke-linejoin=\"round\">{bolt}</g></svg>")), "relabelled contour of bolt", "relabelled contour of bolt"),
        ("hidden by one more", edited(line, &line.replace(" d=", " data-invisibility=\"1\" d=")), "restyled crease of plate", "restyled crease of plate"),
        ("an outline", edited(line, &line.replace(CREASE, r##"data-axis="M20.25 20.5l60 1.25" data-width="1" fill="#1a1a1a" stroke="none" d="M20.24 21l60 1.25.02-1-60-1.25z""##)), "restyled crease of plate", "restyled crease of plate"),
        ("page wider", BASE.replace("width=\"200\" height=\"100\" viewBox=\"0 0 200 100\"", "width=\"220\" height=\"100\" viewBox=\"0 0 220 100\""), "page mark of no part", "page mark of no part"),
        ("a text more", edited("</svg>", "<text x=\"20\" y=\"50\">M6</text></svg>"), "added mark of no part", "removed mark of no part"),
    ];
    for (what, after, forth, back) in &edits {
        let diff = compare(BASE, after);
        assert_eq!(&findings_text(&diff), forth, "{what}: {:#?}", diff.lines());
        assert!(!diff.is_same() && diff.same_at.is_none(), "{what}");
        assert_eq!(&findings_text(&compare(after, BASE)), back, "{what}, backwards");
    }
}

/// Details of findings: distances, growth and changed properties.
#[test]
fn findings_report_distances_growth_and_changes() {
    for d in [0.05, 0.5, 5.0] {
        let after = edited(CREASE, &format!("d=\"M20.25 {}l60 1.25\"", 20.5 + d));
        let diff = compare(BASE, &after);
        let finding = &diff.findings[0];
        assert!((finding.largest - d).abs() < 0.01 * d && (finding.p95 - d).abs() < 0.01 * d, "{finding:?}");
        let [x, y] = finding.shift.unwrap();
        assert!(x.abs() < 0.01 * d && (y - d).abs() < 0.01 * d, "{x} {y}");
    }
    let lost = compare(BASE, &edited("h-80zm30 30v20h20v-20z", "h-80z"));
    assert!((lost.findings[0].growth - 400.0).abs() < 0.5, "{:?}", lost.findings[0]);
    let shorter = compare(BASE, &edited(CREASE, r#"d="M20.25 20.5l48 1""#));
    assert!((shorter.findings[0].growth + 12.0).abs() < 0.1, "{:?}", shorter.findings[0]);
    let dashed = compare(BASE, &edited("stroke-dasharray=\"4 2\"", "stroke-dasharray=\"6 2\""));
    let change = Change { what: "dash".into(), old: "4 2".into(), new: "6 2".into() };
    assert_eq!(dashed.findings[0].changes, [change]);
    let page = compare(
        BASE,
        &BASE.replace(
            "width=\"200\" height=\"100\" viewBox=\"0 0 200 100\"",
            "width=\"220\" height=\"100\" viewBox=\"0 0 220 100\"",
        ),
    );
    assert_eq!(page.lines(), ["page       of the drawing at (110, 50): size 200 x 100 px → 220 x 100 px"]);
    let totals = compare(BASE, BASE).totals;
    assert_eq!(totals.parts["bolt"].marks, [3, 3]);
    assert!((totals.layers["fills"].area[0] - (6000.0 + 900.0)).abs() < 1e-6, "{:?}", totals.layers);
}

#[test]
fn a_shifted_page_is_reported_as_moved() {
    let after = BASE.replace("viewBox=\"0 0 200 100\"", "viewBox=\"-3 -4 200 100\"");
    let diff = compare(BASE, &after);
    assert!(diff.findings.iter().all(|finding| finding.verdict == Verdict::Moved), "{:#?}", diff.lines());
    for finding in &diff.findings {
        let [x, y] = finding.shift.unwrap();
        assert!((x - 3.0).abs() < 0.03 && (y - 4.0).abs() < 0.04, "{finding:?}");
    }
}

#[test]
fn tolerances_apply_by_class_and_layer() {
    let after = BASE
        .replace(CREASE, r#"d="M20.25 20.6l60 1.25""#)
        .replace("M120 30h30v30h-30z", "M120.1 30h30v30h-30z");
    let with = |text: &str| {
        let options = DiffOptions::default().within(Tolerances::parse(text).unwrap());
        findings_text(&compare_with(BASE, &after, &options))
    };
    assert_eq!(with("0.2px"), "");
    assert_eq!(with("lines=0.05mm"), "moved fills of bolt");
    assert_eq!(with("fills=0.2px"), "moved crease of plate");
    assert_eq!(with("crease=0.2px"), "moved fills of bolt");
    assert_eq!(with("tone-0=0.2px, crease=0.2px"), "");
    let options = DiffOptions::default().within(Tolerances::parse("ceases=1px").unwrap());
    assert_eq!(compare_with(BASE, &after, &options).unused_tolerances, ["ceases"]);
}

/// `BASE` with the bolt's fill over the plate's fill, and the same with the two fills swapped.
fn stacked() -> (String, String) {
    let over = BASE.replace("M120 30h30v30h-30z", "M60 30h60v30h-60z");
    let start = over.find("<path class=\"tone-1\"").unwrap();
    let middle = over.find("<path class=\"tone-0\"").unwrap();
    let end = over[middle..].find("</g>").unwrap() + middle;
    let swapped = [&over[..start], &over[middle..end], &over[start..middle], &over[end..]].concat();
    (over, swapped)
}

#[test]
fn changed_stacking_order_is_reported() {
    let (over, swapped) = stacked();
    assert!(
        findings_text(&compare(&over, &swapped)).starts_with("restacked fills of "),
        "{}",
        findings_text(&compare(&over, &swapped))
    );
    // The whole line layer under the fills.
    let lines = BASE.find("<g id=\"lines\"").unwrap();
    let fills = BASE.find("<g id=\"fills\"").unwrap();
    let under = [&BASE[..fills], &BASE[lines..BASE.len() - 7], &BASE[fills..lines], "</svg>\n"].concat();
    assert!(
        findings_text(&compare(BASE, &under)).contains("restacked"),
        "{}",
        findings_text(&compare(BASE, &under))
    );
}

#[test]
fn pixels_are_compared_on_demand() {
    let (over, swapped) = stacked();
    let options = DiffOptions::default().with_pixels();
    let diff = compare_with(&over, &swapped, &options);
    assert!(!diff.is_same() && diff.pixels.unwrap().differing > 500, "{:?}", diff.pixels);
    assert!(compare_with(&over, &format!("{over} "), &options).is_same());
}

#[test]
fn removed_parts_are_not_matched_with_their_neighbours() {
    let bolt = "<path class=\"crease\" data-part=\"bolt\" d=\"M125 35c5 5 10 5 20 0\"/>";
    let washer = "<path class=\"crease\" data-part=\"washer\" d=\"M125 37c5 5 10 5 20 0\"/>";
    assert_eq!(
        findings_text(&compare(BASE, &edited(bolt, washer))),
        "added crease of washer, removed crease of bolt"
    );
    let gone = edited(bolt, "")
        .replace("<path class=\"contour\" data-part=\"bolt\" stroke-width=\"1.6\" stroke-dasharray=\"4 2\" d=\"M170 10v80\"/>", "")
        .replace(r##"<path class="tone-0" data-part="bolt" data-material="zinc" data-tone="0" fill="#9ea3a8" d="M120 30h30v30h-30z"/>"##, "");
    let lines = compare(BASE, &gone).lines();
    assert!(lines.len() == 1 && lines[0].contains("part `bolt`: all its 3 marks"), "{lines:#?}");
}
