//! Warnings about options without effect, patterns without matches, and drawings that show almost nothing.

use std::ffi::OsString;

use kurbo::{Rect, Shape};

use super::draw_request::DrawRequest;
use crate::cli::output::number_text::plain;
use crate::cli::output::output_files::Format;
use crate::drawing::{Drawing, Unit};
use crate::geometry::names::glob::glob_matches;
use crate::scene::{Camera, Projection, Scene};
use crate::style::unitless_length_warning as bare_lengths_of;

/// Maximum size of a drawing that counts as tiny, as a share of the shorter side of the page.
const MAX_SPECK_RATIO: f64 = 0.02;

/// Maximum number of part names in a warning.
const MAX_SHOWN_NAMES: usize = 8;

/// Patterns of `--only` and `--hide` that match no part.
pub(crate) fn unmatched_patterns(scene: &Scene, only: &[String], hide: &[String]) -> Vec<String> {
    let fits = |glob: &str| scene.parts.iter().any(|part| glob_matches(glob, &part.name));
    let given = only.iter().map(|glob| ("--only", glob)).chain(hide.iter().map(|glob| ("--hide", glob)));
    given
        .filter(|(_, glob)| !fits(glob))
        .map(|(option, glob)| match scene.parts.iter().find(|part| part.name.eq_ignore_ascii_case(glob)) {
            Some(part) => {
                format!("{option} '{glob}' fits no part: case counts, and there is `{}`", part.name)
            }
            None => format!("{option} '{glob}' fits no part; `ligne info` lists them"),
        })
        .collect()
}

/// Typed options that do not change the drawings of a request.
pub(crate) fn unused_options(request: &DrawRequest, words: impl Iterator<Item = OsString>) -> Vec<String> {
    let words: Vec<String> = words.map(|word| word.to_string_lossy().into_owned()).collect();
    let typed = |option: &str| {
        let with_value = format!("{option}=");
        words
            .iter()
            .take_while(|word| *word != "--")
            .any(|word| word == option || word.starts_with(&with_value))
    };
    let has = |wanted: &[Format]| request.outputs.iter().any(|output| wanted.contains(&output.format));
    let svg = has(&[Format::Svg, Format::SvgToStdout]);
    let draws_all =
        request.how.only.is_empty() && request.how.hide.is_empty() && request.how.section.section.is_none();
    let rules = [
        ("--dpi", !has(&[Format::Png]), "no PNG is written"),
        ("--precision", !svg, "no SVG is written"),
        ("--id-prefix", !svg, "no SVG is written"),
        ("--group", !svg, "no SVG is written"),
        ("--repeat", request.is_at_rest(), "no animation plays"),
        ("--frame", draws_all, "all of the model is drawn"),
    ];
    let idle = rules.into_iter().filter(|(option, does_nothing, _)| *does_nothing && typed(option));
    idle.map(|(option, _, why)| format!("{option} changes nothing: {why}")).collect()
}

/// Warning about style lengths without a unit on a page in mm.
pub(crate) fn bare_lengths(request: &DrawRequest) -> Option<String> {
    match request.sheet.extent {
        Some((_, Unit::Mm)) => bare_lengths_of(&request.how.style, &request.sets),
        _ => None,
    }
}

/// Warning if the camera is inside a part.
pub(crate) fn camera_inside_part(scene: &Scene, camera: &Camera) -> Option<String> {
    // The distance of an orthographic camera has no meaning.
    let Projection::Perspective { .. } = camera.projection else { return None };
    let part = scene.enclosing_part(camera.eye)?;
    Some(format!("the eye is inside `{}`: what is drawn is seen from within", part.name))
}

/// Warning that lists the visible parts, if `--only` or `--hide` is given.
pub(crate) fn remaining_parts(request: &DrawRequest, scene: &Scene) -> Option<String> {
    if request.how.only.is_empty() && request.how.hide.is_empty() {
        return None;
    }
    let mut names: Vec<&str> =
        scene.parts.iter().map(|part| part.name.as_str()).take(MAX_SHOWN_NAMES).collect();
    names.dedup();
    let more = if scene.parts.len() > MAX_SHOWN_NAMES { " and others" } else { "" };
    Some(format!("--only and --hide leave nothing else to draw than {}{more}", names.join(", ")))
}

/// Warning if the drawing is tiny.
pub(crate) fn tiny_drawing(drawing: &Drawing) -> Option<String> {
    let marks = drawing.layers.iter().flat_map(|layer| &layer.marks);
    let boxes = marks.map(|mark| mark.path.bounding_box()).filter(|mark_box| mark_box.is_finite());
    let page = &drawing.page;
    let max_size = MAX_SPECK_RATIO * page.width.min(page.height);
    let mut all: Option<Rect> = None;
    for mark_box in boxes {
        let union = all.map_or(mark_box, |all| all.union(mark_box));
        // Most drawings are large enough after their first path.
        if union.width().max(union.height()) >= max_size {
            return None;
        }
        all = Some(union);
    }
    let all = all?;
    let (width, height) = (plain(all.width(), 1), plain(all.height(), 1));
    Some(format!("all that is drawn is {width} x {height} {} large", page.unit.name()))
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::options::draw_args::DrawArgs;

    #[derive(Parser)]
    struct DrawCommand {
        #[command(flatten)]
        args: DrawArgs,
    }

    fn unused_option_warnings(line: &str) -> Vec<String> {
        let words = || std::iter::once("draw").chain(line.split_whitespace());
        let request = DrawRequest::new(DrawCommand::try_parse_from(words()).unwrap().args).unwrap();
        unused_options(&request, words().map(OsString::from))
    }

    #[test]
    fn unused_options_lists_options_without_effect() {
        for (line, options) in [
            ("m.obj", 0),
            ("m.obj --dpi 300", 1),
            ("m.obj m.png --dpi=300", 0),
            ("m.obj m.png --precision 3 --group part --id-prefix a-", 3),
            ("m.obj m.png -o m.svg --dpi 300 --precision 3", 0),
            ("m.obj --repeat --frame all", 2),
            ("m.glb --repeat --time 3 --frame all --hide bolt", 0),
        ] {
            assert_eq!(
                unused_option_warnings(line).len(),
                options,
                "{line}: {:?}",
                unused_option_warnings(line)
            );
        }
    }
}
