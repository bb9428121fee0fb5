//! Checks that the canonical form of an SVG file shows the same picture.

use ligne::diff::{DiffOptions, Finding, Picture, PixelDiff, canonical_svg, compare};

/// The canonical form of an SVG text.
pub(crate) fn canonical_form(svg: &str) -> String {
    canonical_svg(svg, None).unwrap_or_else(|error| panic!("{error}\n{svg}"))
}

/// The first pair of lines that differ, for messages.
pub(crate) fn first_difference(a: &str, b: &str) -> String {
    let differ = a.lines().zip(b.lines()).enumerate().find(|(_, (a, b))| a != b);
    differ.map_or("lengths differ".to_owned(), |(at, (a, b))| format!("line {}:\n{a}\n{b}", at + 1))
}

/// Fails with the first pair of lines that differ.
#[track_caller]
pub(crate) fn assert_same_text(found: &str, wanted: &str, name: &str) {
    assert!(found == wanted, "{name}: {}", first_difference(found, wanted));
}

/// Fails if two SVG texts show different pictures.
#[track_caller]
pub(crate) fn assert_same_picture(a: &str, b: &str, name: &str) {
    let [a, b] = [a, b].map(|svg| Picture::from_svg(svg).unwrap_or_else(|error| panic!("{name}: {error}")));
    let diff = compare(&a, &b, &DiffOptions::default().with_pixels());
    // If outlines of several rings start at different points, the diff may report widths that only look
    // different. The pixels decide.
    let wide = |finding: &Finding| finding.changes.iter().all(|change| change.what == "width along the line");
    let finding = diff.findings.iter().find(|finding| finding.changes.is_empty() || !wide(finding));
    assert!(finding.is_none(), "{name}: {finding:?}");
    // Renderers blend reversed lines slightly differently. The same holds for caps of curves that begin with
    // a control point at their end.
    let few =
        |pixels: PixelDiff| pixels.differing * 2000 <= u64::from(pixels.width) * u64::from(pixels.height);
    assert!(diff.pixels.is_none_or(few), "{name}: {:?}", diff.pixels);
}
