//! Comparison by picture: changes that geometry misses, rewrites that no picture shows, and random pairs
//! checked with resvg and librsvg at four pixels per px.

use std::io::Write as _;
use std::process::{Command, Stdio};

use crate::library::support::scenes::random_dice::Dice;
use crate::library::support::scenes::random_svg::{SvgScene, changed_picture_pair, equal_picture_pair};
use ligne::diff::{self, Diff, DiffOptions, Ignore, Picture, Stage, Verdict};
use resvg::{tiny_skia, usvg};

fn compare(before: &str, after: &str) -> Diff {
    let read = |svg: &str| Picture::from_svg(svg).unwrap_or_else(|error| panic!("{error}\n{svg}"));
    diff::compare(&read(before), &read(after), &DiffOptions::default().with_pixels())
}

fn page(body: &str) -> String {
    format!(r#"<svg xmlns="http://www.w3.org/2000/svg" width="160" height="120">{body}</svg>"#)
}

/// Defines a test for each kind of change: its name, the expected result, and the two drawings.
macro_rules! kinds {
    ($($name:ident: $verdict:ident, $before:expr, $after:expr;)*) => {
        $(#[test]
        fn $name() {
            for (before, after) in [($before, $after), ($after, $before)] {
                let diff = compare(&page(before), &page(after));
                assert_eq!(diff.is_same(), stringify!($verdict) == "same", "{:#?}", diff.lines());
                assert_eq!(diff.findings.is_empty(), diff.is_same(), "{:#?}", diff.lines());
            }
        })*
    };
}

kinds! {
    a_gradient_that_runs_the_other_way: differs,
        r##"<linearGradient id="g"><stop stop-color="#046"/><stop offset="1" stop-color="#fc8"/></linearGradient><circle cx="60" cy="50" r="30" fill="url(#g)"/>"##,
        r##"<linearGradient id="g" x1="1" x2="0"><stop stop-color="#046"/><stop offset="1" stop-color="#fc8"/></linearGradient><circle cx="60" cy="50" r="30" fill="url(#g)"/>"##;
    a_pattern_with_wider_cells: differs,
        r##"<pattern id="p" width="8" height="8" patternUnits="userSpaceOnUse"><path d="M0 0h4v4h-4z" fill="#070"/></pattern><rect x="20" y="20" width="90" height="60" fill="url(#p)"/>"##,
        r##"<pattern id="p" width="9" height="8" patternUnits="userSpaceOnUse"><path d="M0 0h4v4h-4z" fill="#070"/></pattern><rect x="20" y="20" width="90" height="60" fill="url(#p)"/>"##;
    a_blur_with_another_number: differs,
        r##"<filter id="f"><feGaussianBlur stdDeviation="2"/></filter><rect x="40" y="30" width="50" height="40" fill="#639" filter="url(#f)"/>"##,
        r##"<filter id="f"><feGaussianBlur stdDeviation="3"/></filter><rect x="40" y="30" width="50" height="40" fill="#639" filter="url(#f)"/>"##;
    a_clip_on_another_mark: differs,
        r##"<clipPath id="c"><rect x="30" y="30" width="60" height="25"/></clipPath><circle cx="45" cy="50" r="22" fill="#b22" clip-path="url(#c)"/><circle cx="95" cy="50" r="22" fill="#22b"/>"##,
        r##"<clipPath id="c"><rect x="30" y="30" width="60" height="25"/></clipPath><circle cx="45" cy="50" r="22" fill="#b22"/><circle cx="95" cy="50" r="22" fill="#22b" clip-path="url(#c)"/>"##;
    a_clip_in_bounding_box_units: differs,
        r##"<clipPath id="c" clipPathUnits="objectBoundingBox"><path d="M0 0H.5V1H0z"/></clipPath><rect x="20" y="20" width="90" height="60" fill="#a50" clip-path="url(#c)"/>"##,
        r##"<clipPath id="c" clipPathUnits="objectBoundingBox"><path d="M0 0H.52V1H0z"/></clipPath><rect x="20" y="20" width="90" height="60" fill="#a50" clip-path="url(#c)"/>"##;
    an_alpha_mask_instead_of_a_luminance_mask: differs,
        r##"<mask id="m"><circle cx="60" cy="50" r="25" fill="#c00"/></mask><rect x="20" y="20" width="90" height="60" fill="#06c" mask="url(#m)"/>"##,
        r##"<mask id="m" mask-type="alpha"><circle cx="60" cy="50" r="25" fill="#c00"/></mask><rect x="20" y="20" width="90" height="60" fill="#06c" mask="url(#m)"/>"##;
    a_clip_with_another_clip_rule: differs,
        r##"<clipPath id="c"><path d="M20 20H110V90H20zM50 40H80V70H50z"/></clipPath><rect width="160" height="120" fill="#06c" clip-path="url(#c)"/>"##,
        r##"<clipPath id="c"><path clip-rule="evenodd" d="M20 20H110V90H20zM50 40H80V70H50z"/></clipPath><rect width="160" height="120" fill="#06c" clip-path="url(#c)"/>"##;
    the_paint_order_of_two_lines: differs,
        r##"<g fill="none" stroke-width="5"><path stroke="#c00" d="M20 20L120 90"/><path stroke="#06c" d="M20 90L120 20"/></g>"##,
        r##"<g fill="none" stroke-width="5"><path stroke="#06c" d="M20 90L120 20"/><path stroke="#c00" d="M20 20L120 90"/></g>"##;
    a_line_over_or_under_a_spot: differs,
        r##"<path d="M10 50H150" stroke="#111" stroke-width="3"/><circle cx="24" cy="50" r="6" fill="#fa0"/>"##,
        r##"<circle cx="24" cy="50" r="6" fill="#fa0"/><path d="M10 50H150" stroke="#111" stroke-width="3"/>"##;
    a_hole_closed_by_its_winding: differs,
        r##"<path fill="#383" d="M20 20H120V100H20zM50 40V80H90V40z"/>"##,
        r##"<path fill="#383" d="M20 20H120V100H20zM50 40H90V80H50z"/>"##;
    a_line_join_split_into_two_lines: differs,
        r##"<path fill="none" stroke="#a0a" stroke-width="12" d="M20 90L70 20 120 90"/>"##,
        r##"<path fill="none" stroke="#a0a" stroke-width="12" d="M20 90L70 20M70 20L120 90"/>"##;
    a_stroke_under_a_non_uniform_scale: differs,
        r##"<path fill="none" stroke="#a00" stroke-width="6" d="M20 20H120V90"/>"##,
        r##"<path fill="none" stroke="#a00" stroke-width="6" transform="scale(3 .3333333)" d="M6.6666667 60H40V270"/>"##;
    dashes_from_the_other_end: differs,
        r##"<path fill="none" stroke="#a00" stroke-width="3" stroke-dasharray="10 5" d="M20 20H117"/>"##,
        r##"<path fill="none" stroke="#a00" stroke-width="3" stroke-dasharray="10 5" d="M117 20H20"/>"##;
    translucent_fills_merged_into_one_path: differs,
        r##"<path fill="#a00" opacity=".5" d="M20 20H80V80H20z"/><path fill="#a00" opacity=".5" d="M50 40H120V90H50z"/>"##,
        r##"<path fill="#a00" opacity=".5" d="M20 20H80V80H20zM50 40H120V90H50z"/>"##;
    an_image_with_another_opacity: differs,
        r##"<image x="20" y="20" width="60" height="40" href="data:image/png;base64,AAAA"/>"##,
        r##"<image x="20" y="20" width="60" height="40" opacity=".4" href="data:image/png;base64,AAAA"/>"##;
    an_image_rotated_in_its_box: differs,
        r##"<image x="20" y="20" width="60" height="40" href="data:image/png;base64,AAAA"/>"##,
        r##"<image x="20" y="20" width="60" height="40" transform="rotate(180 50 40)" href="data:image/png;base64,AAAA"/>"##;
    an_image_with_another_aspect_ratio_rule: differs,
        r##"<image x="20" y="20" width="60" height="40" href="data:image/png;base64,AAAA"/>"##,
        r##"<image x="20" y="20" width="60" height="40" preserveAspectRatio="none" href="data:image/png;base64,AAAA"/>"##;
    another_letter_spacing: differs,
        r##"<text x="20" y="50" font-size="14">Valve</text>"##,
        r##"<text x="20" y="50" font-size="14" style="letter-spacing:2px">Valve</text>"##;
    italics_in_a_tspan: differs,
        r##"<text x="20" y="50">Valve <tspan>12</tspan></text>"##,
        r##"<text x="20" y="50">Valve <tspan font-style="italic">12</tspan></text>"##;
    a_group_that_is_isolated: differs,
        r##"<rect width="90" height="90" fill="#48c"/><g><rect x="40" y="40" width="90" height="60" fill="#ec6" style="mix-blend-mode:multiply"/></g>"##,
        r##"<rect width="90" height="90" fill="#48c"/><g style="isolation:isolate"><rect x="40" y="40" width="90" height="60" fill="#ec6" style="mix-blend-mode:multiply"/></g>"##;
    crisp_edges: differs,
        r##"<path fill="#060" d="M20 20L120 45 60 95z"/>"##,
        r##"<path fill="#060" shape-rendering="crispEdges" d="M20 20L120 45 60 95z"/>"##;
    a_blot_on_a_stroke_outline: differs,
        r##"<path data-axis="M20 50H120" data-width="2" fill="#333" d="M20 49H120V51H20z"/>"##,
        r##"<path data-axis="M20 50H120" data-width="2" fill="#333" d="M20 49H120V51H20zM60 20H90V50H60z"/>"##;
    a_colour_that_differs_by_one: differs,
        r##"<circle cx="60" cy="50" r="30" fill="#336699"/>"##,
        r##"<circle cx="60" cy="50" r="30" fill="#346699"/>"##;
    a_straight_line_with_a_fill: same,
        r##"<line x1="20" y1="30" x2="120" y2="90" stroke="#333" fill="#333"/>"##,
        r##"<line x1="20" y1="30" x2="120" y2="90" stroke="#333" fill="none"/>"##;
    an_equivalent_gradient: same,
        r##"<linearGradient id="g"><stop stop-color="#046" stop-opacity=".5"/><stop offset="1" stop-color="#fc8"/><stop offset="1" stop-color="#fc8"/></linearGradient><circle cx="60" cy="50" r="30" fill="url(#g)"/>"##,
        r##"<linearGradient id="g"><stop stop-color="rgba(0,68,102,.5)"/><stop offset="1" stop-color="#fc8"/></linearGradient><circle cx="60" cy="50" r="30" fill="url(#g)"/>"##;
    a_gradient_of_one_colour: same,
        r##"<linearGradient id="g"><stop stop-color="#046"/><stop offset="1" stop-color="#046"/></linearGradient><circle cx="60" cy="50" r="30" fill="url(#g)"/>"##,
        r##"<circle cx="60" cy="50" r="30" fill="#046"/>"##;
    an_equivalent_pattern: same,
        r##"<pattern id="p" width="8" height="8" patternUnits="userSpaceOnUse"><path d="M2 2h4v4h-4z" fill="#070"/></pattern><rect x="20" y="20" width="90" height="60" fill="url(#p)"/>"##,
        r##"<pattern id="p" width="8" height="8" patternUnits="userSpaceOnUse"><path d="M0 0h4v4h-4z" transform="translate(2 2)" fill="#070"/></pattern><rect x="20" y="20" width="90" height="60" fill="url(#p)"/>"##;
    a_clip_on_a_group_or_on_its_children: same,
        r##"<clipPath id="c"><circle cx="65" cy="55" r="30"/></clipPath><g clip-path="url(#c)"><rect x="20" y="20" width="40" height="60" fill="#a50"/><rect x="70" y="20" width="40" height="60" fill="#05a"/></g>"##,
        r##"<clipPath id="c"><circle cx="65" cy="55" r="30"/></clipPath><rect x="20" y="20" width="40" height="60" fill="#a50" clip-path="url(#c)"/><rect x="70" y="20" width="40" height="60" fill="#05a" clip-path="url(#c)"/>"##;
    a_repeated_dash_array: same,
        r##"<path fill="none" stroke="#a00" stroke-width="3" stroke-dasharray="9 4" d="M20 20H117V80"/>"##,
        r##"<path fill="none" stroke="#a00" stroke-width="3" stroke-dasharray="9 4 9 4" d="M20 20H117V80"/>"##;
    a_dash_longer_than_the_line: same,
        r##"<path fill="none" stroke="#a00" stroke-width="3" stroke-dasharray="500 4" d="M20 20H117"/>"##,
        r##"<path fill="none" stroke="#a00" stroke-width="3" d="M20 20H117"/>"##;
    dashes_drawn_one_by_one: same,
        r##"<path fill="none" stroke="#a00" stroke-width="3" stroke-dasharray="20 10" d="M20 20H100"/>"##,
        r##"<path fill="none" stroke="#a00" stroke-width="3" d="M20 20H40M50 20H70M80 20H100"/>"##;
    an_image_with_wrapped_base64: same,
        r##"<image x="20" y="20" width="60" height="40" href="data:image/png;base64,AAAABBBBCCCC"/>"##,
        "<image x=\"20\" y=\"20\" width=\"60\" height=\"40\" href=\"data:image/png;base64,AAAA\n  BBBB\n  CCCC\"/>";
    an_image_without_a_source: same,
        r##"<circle cx="60" cy="50" r="30" fill="#046"/>"##,
        r##"<circle cx="60" cy="50" r="30" fill="#046"/><image x="20" y="20" width="60" height="40"/>"##;
    a_title_in_a_text: same,
        r##"<text x="20" y="50">Valve</text>"##,
        r##"<text x="20" y="50"><title>a name</title>Valve</text>"##;
    a_fully_covered_mark: same,
        r##"<circle cx="60" cy="50" r="20" fill="#a00"/><rect x="10" y="10" width="120" height="90" fill="#eee"/>"##,
        r##"<rect x="10" y="10" width="120" height="90" fill="#eee"/>"##;
    a_stroke_as_its_outline: same,
        r##"<path fill="none" stroke="#a00" stroke-width="4" d="M20 50H120"/>"##,
        r##"<path fill="#a00" d="M20 48H120V52H20z"/>"##;
}

#[test]
fn unsupported_svg_features_are_named() {
    for (body, words) in [
        (
            r#"<foreignObject width="90" height="40"><p xmlns="http://www.w3.org/1999/xhtml">open</p></foreignObject>"#,
            "foreignObject",
        ),
        (r#"<path style="fill:var(--a)" d="M0 0H9V9z"/>"#, "var()"),
        (r#"<style>@media print{path{fill:red}}</style><path d="M0 0H9V9z"/>"#, "@media"),
        (r#"<style>path:not(.a){fill:red}</style><path d="M0 0H9V9z"/>"#, ":not()"),
        (r#"<style>@font-face{font-family:a;src:url(a.woff)}</style><path d="M0 0H9V9z"/>"#, "@font-face"),
        (r#"<use href="other.svg#a"/><path d="M0 0H9V9z"/>"#, "other files"),
        (r#"<path pathLength="10" stroke="red" d="M0 0H9V9z"/>"#, "pathLength"),
        (r#"<path d="M0 0H9V9z"><animate attributeName="d"/></path>"#, "animations"),
    ] {
        let diff = compare(&page(body), &page(&format!("{body} ")));
        let lines = diff.lines();
        assert!(diff.is_same(), "{lines:#?}");
        assert!(
            lines.iter().any(|line| line.contains("not read") && line.contains(words)),
            "{words}: {lines:#?}"
        );
        assert!(diff.to_json().contains("not_read"));
        assert!(compare(&page(body), &page(body)).lines().is_empty(), "the same bytes");
    }
}

#[test]
fn hidden_paint_order_is_a_label() {
    let marks = |first: &str, second: &str| {
        page(&format!(r##"{first}{second}<rect x="10" y="10" width="120" height="90" fill="#eee"/>"##))
    };
    let (a, b) = (
        r##"<circle cx="60" cy="50" r="20" fill="#a00"/>"##,
        r##"<circle cx="70" cy="50" r="20" fill="#00a"/>"##,
    );
    let (before, after) = (marks(a, b), marks(b, a));
    let diff = compare(&before, &after);
    assert_eq!(
        diff.findings.iter().map(|f| f.verdict).collect::<Vec<_>>(),
        [Verdict::Relabelled],
        "{:#?}",
        diff.lines()
    );
    let options = DiffOptions::default().ignoring(Ignore::parse("labels").unwrap());
    let read = |svg: &str| Picture::from_svg(svg).unwrap();
    let ignored = diff::compare(&read(&before), &read(&after), &options);
    assert_eq!(ignored.same_at, Some(Stage::Picture), "{:#?}", ignored.lines());
}

#[test]
fn findings_name_the_place_of_a_changed_blend_mode() {
    let diff = compare(
        &page(
            r##"<rect x="20" y="20" width="40" height="40" fill="#c33"/><rect x="20" y="20" width="40" height="40" fill="#36c" style="mix-blend-mode:multiply"/>"##,
        ),
        &page(
            r##"<rect x="20" y="20" width="40" height="40" fill="#c33"/><rect x="20" y="20" width="40" height="40" fill="#36c" style="mix-blend-mode:screen"/>"##,
        ),
    );
    assert!(!diff.is_same());
    assert!(diff.lines().iter().any(|line| line.contains("at (40, 40)")), "{:#?}", diff.lines());
}

/// With widths ignored, a corner drawn as two lines equals one bent line, because pens of other programs end
/// differently.
#[test]
fn split_corners_are_equal_when_widths_are_ignored() {
    let pen = r##"<g fill="none" stroke="#000" stroke-width="3">"##;
    let whole = page(&format!(r#"{pen}<path d="M20 20H90.5L40 97"/></g>"#));
    let cut = page(&format!(r#"{pen}<path d="M20 20H90.5"/><path d="M90.5 20L40 97"/></g>"#));
    assert!(!compare(&whole, &cut).is_same());
    let read = |svg: &str| Picture::from_svg(svg).unwrap();
    let options = DiffOptions::default().ignoring(Ignore::parse("widths").unwrap());
    let diff = diff::compare(&read(&whole), &read(&cut), &options);
    assert!(diff.is_same(), "{:#?}", diff.lines());
}

/// Picture by resvg at four pixels per px.
fn picture(svg: &str) -> tiny_skia::Pixmap {
    let tree = usvg::Tree::from_str(svg, &usvg::Options::default()).unwrap();
    let mut pixmap = tiny_skia::Pixmap::new(640, 480).unwrap();
    resvg::render(&tree, tiny_skia::Transform::from_scale(4.0, 4.0), &mut pixmap.as_mut());
    pixmap
}

/// Picture by librsvg at four pixels per px, or `None` if it is not installed.
fn picture_by_librsvg(svg: &str) -> Option<tiny_skia::Pixmap> {
    let (input, output) = (Stdio::piped(), Stdio::piped());
    let mut child =
        Command::new("rsvg-convert").args(["--zoom", "4"]).stdin(input).stdout(output).spawn().ok()?;
    child.stdin.take()?.write_all(svg.as_bytes()).ok()?;
    tiny_skia::Pixmap::decode_png(&child.wait_with_output().ok()?.stdout).ok()
}

/// Number of pixels that differ by more than a quarter of the range from black to white.
fn differing_pixels([a, b]: [tiny_skia::Pixmap; 2]) -> usize {
    let pairs = a.data().chunks_exact(4).zip(b.data().chunks_exact(4));
    pairs.filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 64)).count()
}

/// Asserts that verdicts on random pairs match their pictures. Pairs with odd seeds are changed.
fn assert_verdicts_match_pictures(seeds: std::ops::Range<u64>, picture: impl Fn(&str) -> tiny_skia::Pixmap) {
    let (mut changed, mut unchanged, mut loudest, mut faintest) = (0, 0, 0u8, 255u8);
    for seed in seeds {
        let mut dice = Dice::new(seed);
        let scene = SvgScene::random(&mut dice);
        if seed % 2 == 0 {
            let (before, after, way) = equal_picture_pair(&scene, &mut dice);
            let diff = compare(&before, &after);
            assert!(diff.is_same(), "seed {seed}, {way}: {:#?}\n{before}\n{after}", diff.lines());
            loudest = loudest.max(diff.pixels.map_or(0, |pixels| pixels.largest));
            unchanged += 1;
        } else {
            let (before, after, way) = changed_picture_pair(&scene, &mut dice);
            // Less than one px² of the page changes visibly.
            if differing_pixels([&before, &after].map(|svg| picture(svg))) < 16 {
                continue;
            }
            let diff = compare(&before, &after);
            assert!(!diff.is_same(), "seed {seed}, {way}: {:#?}\n{before}\n{after}", diff.lines());
            faintest = faintest.min(diff.pixels.map_or(255, |pixels| pixels.largest));
            changed += 1;
        }
    }
    assert!(changed > unchanged / 4, "{changed} of {unchanged} changes are seen");
    // The threshold of `likeness` lies between rounding differences and real ones.
    assert!(loudest <= 2 && faintest >= 16, "one picture: up to {loudest}; two: {faintest} and more");
}

#[test]
fn verdicts_on_random_pairs_match_their_pictures() {
    assert_verdicts_match_pictures(0..200, picture);
}

#[test]
#[ignore = "takes minutes: .ci/nightly"]
fn verdicts_on_ten_thousand_random_pairs_match_their_pictures() {
    assert_verdicts_match_pictures(1000..1000 + long_run_pairs(), picture);
}

/// Number of pairs in the long runs: `LIGNE_PAIRS`, by default 10,000.
fn long_run_pairs() -> u64 {
    std::env::var("LIGNE_PAIRS").map_or(10_000, |count| count.parse().expect("a number of pairs"))
}

#[test]
#[ignore = "takes minutes: .ci/nightly"]
fn verdicts_on_ten_thousand_random_pairs_match_librsvg() {
    if picture_by_librsvg(&page("")).is_none() {
        eprintln!("skipped: rsvg-convert is not installed");
        return;
    }
    let picture = |svg: &str| picture_by_librsvg(svg).expect("a picture by rsvg-convert");
    assert_verdicts_match_pictures(20_000..20_000 + long_run_pairs(), picture);
}
