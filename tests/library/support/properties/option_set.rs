//! Named ways to draw a subject: the bare lines of the view map, or a style with overrides.

use ligne::lines::{Contours, LineOptions};
use ligne::pipeline::render;
use ligne::style::Style;

use super::picture::Picture;
use super::subject::Subject;
use crate::library::support::pipeline::run_stages;

/// A way to draw.
#[derive(Debug, Clone, Copy)]
pub(crate) struct OptionSet {
    pub name: &'static str,
    from: DrawingSource,
}

#[derive(Debug, Clone, Copy)]
enum DrawingSource {
    /// The visible edges of the view map, with unmerged creases.
    Lines(Contours),
    /// A style and its overrides.
    BuiltInStyle(&'static str, &'static [&'static str]),
}

const fn built_in(name: &'static str) -> OptionSet {
    OptionSet { name, from: DrawingSource::BuiltInStyle(name, &[]) }
}

const fn with_overrides(name: &'static str, style: &'static str, sets: &'static [&'static str]) -> OptionSet {
    OptionSet { name, from: DrawingSource::BuiltInStyle(style, sets) }
}

/// The exact lines of a polyhedron.
pub(crate) const EXACT_LINES: OptionSet =
    OptionSet { name: "lines of the mesh", from: DrawingSource::Lines(Contours::Mesh) };
pub(crate) const SMOOTH_LINES: OptionSet =
    OptionSet { name: "smooth lines", from: DrawingSource::Lines(Contours::Smooth) };

pub(crate) const INK: OptionSet = built_in("ink");
pub(crate) const INK_MESH: OptionSet =
    with_overrides("ink, contours along the mesh", "ink", &["lines.contours=mesh"]);
pub(crate) const INK_SMOOTH: OptionSet =
    with_overrides("ink, smooth contours", "ink", &["lines.contours=smooth"]);
pub(crate) const INK_FROM_IMAGE: OptionSet =
    with_overrides("ink found in the image", "ink", &["lines.source=both"]);
pub(crate) const TECHNICAL: OptionSet = built_in("technical");
pub(crate) const TOON: OptionSet = built_in("toon");
pub(crate) const GOOCH: OptionSet = built_in("gooch");
pub(crate) const COMIC: OptionSet = built_in("comic");
pub(crate) const PENCIL: OptionSet = built_in("pencil");
pub(crate) const PENCIL_OBJECT: OptionSet = built_in("pencil-object");
pub(crate) const PEN: OptionSet = built_in("pen");
pub(crate) const SUGGESTIVE: OptionSet = built_in("suggestive");
pub(crate) const ENGRAVING: OptionSet = built_in("engraving");
pub(crate) const STIPPLE: OptionSet = built_in("stipple");

pub(crate) const RIDGES: OptionSet = with_overrides(
    "ridges and valleys",
    "ink",
    &["lines.kinds=[\"contour\", \"crease\", \"ridge\", \"valley\", \"suggestive\"]"],
);
pub(crate) const APPARENT: OptionSet = with_overrides(
    "apparent ridges",
    "ink",
    &["lines.kinds=[\"contour\", \"ridge\", \"valley\"]", "lines.inside.apparent=true"],
);

/// All built-in styles.
pub(crate) const BUILT_IN: [OptionSet; 24] = [
    built_in("blueprint"),
    built_in("comic-flats"),
    COMIC,
    ENGRAVING,
    built_in("flat"),
    GOOCH,
    built_in("gradient"),
    INK,
    built_in("noir"),
    built_in("patent"),
    PEN,
    PENCIL_OBJECT,
    built_in("pencil-plain"),
    PENCIL,
    built_in("plotter"),
    built_in("rim"),
    built_in("sketch"),
    STIPPLE,
    SUGGESTIVE,
    TECHNICAL,
    built_in("toon-highlight"),
    built_in("toon-three"),
    TOON,
    built_in("woodcut"),
];

/// Overrides for all hand-drawn effects at once, plus varying widths, halos and fills.
pub(crate) const HAND_DRAWN_OVERRIDES: [&str; 15] = [
    "pen.contour.width=4",
    "pen.silhouette.width=4",
    "pen.width=4",
    "pen.swell.taper=20",
    "pen.swell.bend=0.5",
    "pen.swell.lit=0.5",
    "pen.swell.near=0.3",
    "pen.swell.gap=0.3",
    "pen.hand.tremor=1",
    "pen.hand.overshoot=6",
    "pen.hand.breaks=120",
    "pen.hand.passes=2",
    "pen.halo=3",
    "fills.enabled=true",
    "lines.crease_deg=30",
];
pub(crate) const HAND_DRAWN_INK: OptionSet = with_overrides("ink by a hand", "ink", &HAND_DRAWN_OVERRIDES);

impl OptionSet {
    pub(crate) fn draw(&self, subject: &Subject) -> Picture {
        let Subject { scene, camera, .. } = subject;
        match self.from {
            DrawingSource::Lines(contours) => {
                let options = LineOptions { contours, ..LineOptions::default() };
                Picture::of_stages(&run_stages(scene, camera, &options))
            }
            DrawingSource::BuiltInStyle(name, sets) => {
                let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
                let style = Style::load_with(name, &sets).unwrap_or_else(|error| panic!("{error}"));
                Picture::of_drawing(render(scene, camera, &style).unwrap())
            }
        }
    }
}
