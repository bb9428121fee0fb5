//! What a stage made, as a drawing: for looking into the pipeline.

use kurbo::{BezPath, Point};

use crate::chain::Chain;
use crate::drawing::{Cap, Join, Layer, LayerKind, Length, Mark, Page, Paint, Provenance, StrokePaint, Unit};
use crate::lines::{FeatureLines, LineKind};
use crate::math::colour::Colour;
use crate::mesh::Mesh;
use crate::view::View;
use crate::viewmap::ViewMap;

/// Hues that are easily told apart, for pieces that follow each other.
const HUES: [Colour; 8] = [
    Colour::rgb(0xd6, 0x27, 0x28),
    Colour::rgb(0x1f, 0x77, 0xb4),
    Colour::rgb(0x2c, 0xa0, 0x2c),
    Colour::rgb(0xff, 0x7f, 0x0e),
    Colour::rgb(0x94, 0x67, 0xbd),
    Colour::rgb(0x8c, 0x56, 0x4b),
    Colour::rgb(0xe3, 0x77, 0xc2),
    Colour::rgb(0x17, 0xbe, 0xcf),
];

/// One colour a kind of line.
fn kind_colour(kind: LineKind) -> Colour {
    HUES[kind as usize % HUES.len()]
}

fn mark(path: BezPath, colour: Colour, width: f64, kind: LineKind, invisibility: u16) -> Mark {
    let (cap, join) = (Cap::Butt, Join::Round);
    let stroke = StrokePaint { width, colour, cap, join, dash: Vec::new(), dash_offset: 0.0 };
    let provenance = Provenance { classes: vec![kind.name()], invisibility, ..Provenance::default() };
    Mark { path, paint: Paint::Stroke(stroke), provenance }
}

fn segment(a: Point, b: Point) -> BezPath {
    let mut path = BezPath::new();
    path.move_to(a);
    path.line_to(b);
    path
}

fn thin(unit: Unit) -> f64 {
    Length::px(0.8).in_unit(unit)
}

/// All feature lines, hidden or not, one colour a kind.
pub(super) fn of_lines(mesh: &Mesh, view: &View, lines: &FeatureLines, page: &Page) -> Vec<Layer> {
    let margin = kurbo::Vec2::new(page.width - view.frame.width, page.height - view.frame.height) / 2.0;
    let marks = lines.segments.iter().filter_map(|s| {
        let [a, b] = s.ends.map(|end| lines.position(mesh, end));
        let ([a, b], _) = view.frame.clip_segment(a, b)?;
        let (start, end) = view.frame.clip_to_page(a, b)?;
        let point = |t: f64| Point::new(a.x + (b.x - a.x) * t, a.y + (b.y - a.y) * t) + margin;
        Some(mark(segment(point(start), point(end)), kind_colour(s.kind), thin(page.unit), s.kind, 0))
    });
    vec![Layer { kind: LayerKind::Lines, pen: None, marks: marks.collect() }]
}

/// Every view edge by itself: visible ones in a colour of their kind, hidden ones pale, so that
/// the layers show what hides what.
pub(super) fn of_view_map(map: &ViewMap, unit: Unit) -> Vec<Layer> {
    let (mut hidden, mut visible) = (Vec::new(), Vec::new());
    for edge in &map.edges {
        let [a, b] = [edge.start, edge.end].map(|v| map.vertices[v.index()].position);
        let colour = if edge.silhouette { Colour::BLACK } else { kind_colour(edge.kind) };
        if edge.invisibility == 0 {
            visible.push(mark(segment(a, b), colour, thin(unit), edge.kind, 0));
        } else {
            let pale = Colour { a: 70, ..colour };
            hidden.push(mark(segment(a, b), pale, thin(unit) / 2.0, edge.kind, edge.invisibility));
        }
    }
    layers(hidden, visible)
}

/// Every chain in the next of eight colours.
pub(super) fn of_chains(chains: &[Chain], unit: Unit) -> Vec<Layer> {
    let (mut hidden, mut visible) = (Vec::new(), Vec::new());
    for (i, chain) in chains.iter().enumerate() {
        let colour = HUES[i % HUES.len()];
        if chain.invisibility == 0 {
            visible.push(mark(chain.path.clone(), colour, 1.5 * thin(unit), chain.kind, 0));
        } else {
            let pale = Colour { a: 70, ..colour };
            hidden.push(mark(chain.path.clone(), pale, thin(unit) / 2.0, chain.kind, chain.invisibility));
        }
    }
    layers(hidden, visible)
}

fn layers(hidden: Vec<Mark>, visible: Vec<Mark>) -> Vec<Layer> {
    [(LayerKind::HiddenLines, hidden), (LayerKind::Lines, visible)]
        .into_iter()
        .filter(|(_, marks)| !marks.is_empty())
        .map(|(kind, marks)| Layer { kind, pen: None, marks })
        .collect()
}
