//! Named ways to draw a subject: the bare lines of the view map, or a style with overrides.

use ligne::lines::{Contours, LineOptions};
use ligne::pipeline::render;
use ligne::style::Style;

use super::picture::Picture;
use super::subject::Subject;
use crate::support::pipeline::stages;

/// A way to draw.
#[derive(Debug, Clone, Copy)]
pub struct OptionSet {
    pub name: &'static str,
    from: From,
}

#[derive(Debug, Clone, Copy)]
enum From {
    /// The visible edges of the view map, with unmerged creases.
    Lines(Contours),
    /// A style and its overrides.
    Sheet(&'static str, &'static [&'static str]),
}

const fn sheet(name: &'static str) -> OptionSet {
    OptionSet { name, from: From::Sheet(name, &[]) }
}

const fn changed(name: &'static str, style: &'static str, sets: &'static [&'static str]) -> OptionSet {
    OptionSet { name, from: From::Sheet(style, sets) }
}

/// The exact lines of a polyhedron.
pub const EXACT: OptionSet = OptionSet { name: "lines of the mesh", from: From::Lines(Contours::Mesh) };
pub const SMOOTH_LINES: OptionSet = OptionSet { name: "smooth lines", from: From::Lines(Contours::Smooth) };

pub const INK: OptionSet = sheet("ink");
pub const INK_MESH: OptionSet = changed("ink, contours along the mesh", "ink", &["lines.contours=mesh"]);
pub const INK_SMOOTH: OptionSet = changed("ink, smooth contours", "ink", &["lines.contours=smooth"]);
pub const IMAGE: OptionSet = changed("ink found in the image", "ink", &["lines.source=both"]);
pub const TECHNICAL: OptionSet = sheet("technical");
pub const TOON: OptionSet = sheet("toon");
pub const GOOCH: OptionSet = sheet("gooch");
pub const COMIC: OptionSet = sheet("comic");
pub const PENCIL: OptionSet = sheet("pencil");
pub const PENCIL_OBJECT: OptionSet = sheet("pencil-object");
pub const PEN: OptionSet = sheet("pen");
pub const SUGGESTIVE: OptionSet = sheet("suggestive");
pub const ENGRAVING: OptionSet = sheet("engraving");
pub const STIPPLE: OptionSet = sheet("stipple");

pub const RIDGES: OptionSet = changed(
    "ridges and valleys",
    "ink",
    &["lines.kinds=[\"contour\", \"crease\", \"ridge\", \"valley\", \"suggestive\"]"],
);
pub const APPARENT: OptionSet = changed(
    "apparent ridges",
    "ink",
    &["lines.kinds=[\"contour\", \"ridge\", \"valley\"]", "lines.inside.apparent=true"],
);

/// All built-in styles.
pub const BUILT_IN: [OptionSet; 24] = [
    sheet("blueprint"),
    sheet("comic-flats"),
    COMIC,
    ENGRAVING,
    sheet("flat"),
    GOOCH,
    sheet("gradient"),
    INK,
    sheet("noir"),
    sheet("patent"),
    PEN,
    PENCIL_OBJECT,
    sheet("pencil-plain"),
    PENCIL,
    sheet("plotter"),
    sheet("rim"),
    sheet("sketch"),
    STIPPLE,
    SUGGESTIVE,
    TECHNICAL,
    sheet("toon-highlight"),
    sheet("toon-three"),
    TOON,
    sheet("woodcut"),
];

/// Overrides for all hand-drawn effects at once, plus varying widths, halos and fills.
pub const HAND_SETS: [&str; 15] = [
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
pub const HAND: OptionSet = changed("ink by a hand", "ink", &HAND_SETS);

impl OptionSet {
    pub fn draw(&self, subject: &Subject) -> Picture {
        let Subject { scene, camera, .. } = subject;
        match self.from {
            From::Lines(contours) => {
                let options = LineOptions { contours, ..LineOptions::default() };
                Picture::of_stages(&stages(scene, camera, &options))
            }
            From::Sheet(name, sets) => {
                let sets: Vec<String> = sets.iter().map(|set| (*set).to_owned()).collect();
                let style = Style::load(name, &sets).unwrap_or_else(|error| panic!("{error}"));
                Picture::of_drawing(render(scene, camera, &style).unwrap())
            }
        }
    }
}
