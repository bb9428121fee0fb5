//! Comparison results as a drawing: unchanged marks in grey, removed ones in red, added ones in green.

use std::sync::Arc;

use kurbo::{Affine, BezPath, PathEl, Point, Rect, Shape as _, Size};

use super::legend;
use crate::colour::srgb::Colour;
use crate::diff::curves::chain;
use crate::diff::curves::segment::nearest_on;
use crate::diff::findings::finding::{Diff, Finding, Verdict};
use crate::diff::shapes::ink::ShapePaint as Ink;
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};
use crate::drawing::{
    Cap, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, Provenance, StrokePaint, Unit,
};
use crate::geometry::plane::polyline_path::subpaths;

/// Unchanged lines.
const KEPT_LINE_COLOUR: Colour = Colour::rgb(0xb4, 0xb4, 0xb4);
/// Darkest unchanged fill.
const KEPT_DARK_COLOUR: Colour = Colour::rgb(0xdc, 0xdc, 0xdc);
/// Lightest unchanged fill.
const KEPT_LIGHT_COLOUR: Colour = Colour::rgb(0xfa, 0xfa, 0xfa);
/// Removed marks.
const GONE_COLOUR: Colour = Colour::rgb(0xd1, 0x24, 0x2f);
/// Added marks.
const NEW_COLOUR: Colour = Colour::rgb(0x1a, 0x7f, 0x37);
/// Lines from old to new places.
const MOVED_COLOUR: Colour = Colour::rgb(0x09, 0x69, 0xda);
/// Repainted marks.
const RESTYLED_COLOUR: Colour = Colour::rgb(0xc4, 0x7f, 0x00);
/// Relabelled marks.
const RELABELLED_COLOUR: Colour = Colour::rgb(0x82, 0x50, 0xdf);
/// Opacity of removed and added fills, 0 to 255.
const VEIL_ALPHA: u8 = 70;
/// Width factor of removed lines that added lines nearly cover.
const COVERED_WIDTH_FACTOR: f64 = 2.5;
/// Gap between two pages side by side, as a share of their width.
const PAGE_GAP_SHARE: f64 = 0.03;
/// Number of lines per path that lead from old to new points.
const SHIFT_LINES_PER_PATH: usize = 3;

/// Arrangement of a comparison as a drawing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum View {
    /// The new drawing in grey, under removed marks in red and added marks in green. Lines lead from the old
    /// to the new place of moved marks.
    #[default]
    Over,
    /// Both drawings in their own colours, under red and green marks.
    SideBySide,
}

impl Diff {
    /// The comparison as a drawing in px. Each mark has its finding as a title.
    #[must_use]
    pub fn picture(&self, view: View) -> Drawing {
        let (before, after) = (&self.before, &self.after);
        let (width, height) = (before.width.max(after.width), before.height.max(after.height));
        // A line width that is visible when the whole page is displayed.
        let width_of_line = (width.max(height) / 500.0).max(0.5);
        let notes: Vec<Arc<str>> = self.all_lines().into_iter().map(Arc::from).collect();
        let mut layers = OverlayMarks::default();
        let mut page = Page { width, height, unit: Unit::Px, background: Some(Colour::WHITE) };
        match view {
            View::Over => {
                layers.picture(after, Affine::IDENTITY, grey);
                for (finding, note) in self.findings.iter().zip(&notes) {
                    layers.taken(finding, Affine::IDENTITY, width_of_line, note);
                }
                for (finding, note) in self.findings.iter().zip(&notes) {
                    layers.brought(finding, Affine::IDENTITY, width_of_line, note);
                    layers.way(finding, width_of_line * 0.6, note);
                }
            }
            View::SideBySide => {
                let gap = width * PAGE_GAP_SHARE;
                let beside = Affine::translate((width + gap, 0.0));
                page.width = 2.0 * width + gap;
                layers.picture(before, Affine::IDENTITY, own);
                layers.picture(after, beside, own);
                for (finding, note) in self.findings.iter().zip(&notes) {
                    layers.taken(finding, Affine::IDENTITY, width_of_line, note);
                    layers.brought(finding, beside, width_of_line, note);
                }
            }
        }
        let marks = self.legend(view);
        page.height += legend::height(width_of_line);
        layers.findings.extend(
            legend::marks(&marks, Size::new(page.width, height), width_of_line)
                .into_iter()
                .map(|(path, colour, width)| mark(path, stroke(colour, width, Vec::new()), None)),
        );
        Drawing::new("difference", page, layers.into_list())
    }
}

impl Diff {
    /// Rows of the legend for the colours that occur.
    fn legend(&self, view: View) -> Vec<(&'static str, Colour)> {
        let has = |is: &dyn Fn(&Finding) -> bool| self.findings.iter().any(is);
        let ink = |path: &BezPath| !path.elements().is_empty();
        let same_place =
            |f: &Finding| matches!(f.verdict, Verdict::Restyled | Verdict::Restacked | Verdict::Picture);
        let elsewhere =
            |f: &Finding| !same_place(f) && !matches!(f.verdict, Verdict::Relabelled | Verdict::Page);
        let rows: [(&str, Colour, bool); 5] = [
            ("gone", GONE_COLOUR, has(&|f| elsewhere(f) && ink(&f.removed_path))),
            ("new", NEW_COLOUR, has(&|f| elsewhere(f) && ink(&f.added_path))),
            ("moved", MOVED_COLOUR, view == View::Over && has(&|f| f.verdict == Verdict::Moved)),
            ("repainted", RESTYLED_COLOUR, has(&same_place)),
            ("relabelled", RELABELLED_COLOUR, has(&|f| f.verdict == Verdict::Relabelled)),
        ];
        rows.into_iter().filter(|(.., there)| *there).map(|(word, colour, _)| (word, colour)).collect()
    }
}

/// Grey of a shape that is shown for orientation.
fn grey(shape: &Shape) -> Colour {
    match (shape.kind, &shape.ink.paint) {
        (ShapeKind::Line, _) => KEPT_LINE_COLOUR,
        (_, Ink::Colour(colour)) => KEPT_DARK_COLOUR.mix(KEPT_LIGHT_COLOUR, colour.luma()),
        (_, Ink::Other(_)) => KEPT_DARK_COLOUR.mix(KEPT_LIGHT_COLOUR, 0.5),
    }
}

/// The shape's own colour, or mid-grey for other paints.
fn own(shape: &Shape) -> Colour {
    match &shape.ink.paint {
        Ink::Colour(colour) => *colour,
        Ink::Other(_) => Colour::rgb(0x80, 0x80, 0x80),
    }
}

/// Marks of the overlay: the drawings themselves, and the findings on top.
#[derive(Default)]
struct OverlayMarks {
    drawings: Vec<Mark>,
    findings: Vec<Mark>,
}

impl OverlayMarks {
    fn into_list(self) -> Vec<Layer> {
        let layer = |kind, marks: Vec<Mark>| Layer { kind, pen: None, ordered: false, marks };
        let all = [layer(LayerKind::Fills, self.drawings), layer(LayerKind::Callouts, self.findings)];
        all.into_iter().filter(|layer| !layer.marks.is_empty()).collect()
    }

    /// Adds a whole picture.
    fn picture(&mut self, picture: &Picture, to: Affine, colour: impl Fn(&Shape) -> Colour) {
        for shape in picture.shapes.iter() {
            let colour = colour(shape);
            let (path, paint) = match (shape.kind, &shape.outline) {
                (ShapeKind::Clip, _) => continue,
                (_, Some(outline)) => (outline, Paint::Fill(colour)),
                (ShapeKind::Region, None) => (&shape.path, Paint::Fill(colour)),
                (ShapeKind::Line, None) => {
                    (&shape.path, stroke(colour, shape.ink.width, shape.ink.dash.clone()))
                }
            };
            let path = if shape.even_odd { unwound(path) } else { path.clone() };
            self.drawings.push(mark(to * path, paint, None));
        }
    }

    /// Adds the removed part of a finding.
    fn taken(&mut self, finding: &Finding, to: Affine, width: f64, note: &Arc<str>) {
        match finding.verdict {
            Verdict::Page | Verdict::Restyled | Verdict::Restacked => {}
            Verdict::Relabelled | Verdict::Picture => {}
            // Added lines are painted later. If the distance is short, wider red lines show on both sides of
            // green ones.
            _ => {
                let hidden = finding.largest > 0.0 && finding.largest < 2.0 * width;
                let width = if hidden { width * COVERED_WIDTH_FACTOR } else { width };
                self.piece(finding, &finding.removed_path, GONE_COLOUR, to, width, note);
            }
        }
    }

    /// Adds the added part of a finding.
    fn brought(&mut self, finding: &Finding, to: Affine, width: f64, note: &Arc<str>) {
        let colour = match finding.verdict {
            Verdict::Page => return,
            Verdict::Restyled | Verdict::Restacked | Verdict::Picture => RESTYLED_COLOUR,
            Verdict::Relabelled => RELABELLED_COLOUR,
            _ => NEW_COLOUR,
        };
        self.piece(finding, &finding.added_path, colour, to, width, note);
    }

    /// Adds a part of a finding in a colour, with a transparent fill for whole regions.
    fn piece(
        &mut self,
        finding: &Finding,
        path: &BezPath,
        colour: Colour,
        to: Affine,
        width: f64,
        note: &Arc<str>,
    ) {
        if path.elements().is_empty() {
            return;
        }
        let whole = matches!(finding.verdict, Verdict::Removed | Verdict::Added | Verdict::Restyled);
        if finding.kind == ShapeKind::Region && whole {
            let veil = Paint::Fill(Colour { a: VEIL_ALPHA, ..colour });
            self.findings.push(mark(to * path.clone(), veil, None));
        }
        self.findings.push(mark(to * path.clone(), stroke(colour, width, Vec::new()), Some(note)));
    }

    /// Adds lines from the old to the new place of a mark.
    fn way(&mut self, finding: &Finding, width: f64, note: &Arc<str>) {
        if finding.verdict != Verdict::Moved {
            return;
        }
        let old = polylines(&finding.removed_path);
        let new = polylines(&finding.added_path);
        let mut path = BezPath::new();
        for points in &old {
            let step = (points.len().saturating_sub(1) / (SHIFT_LINES_PER_PATH - 1)).max(1);
            for from in points.iter().step_by(step) {
                let to = match finding.shift {
                    Some([x, y]) => Some(Point::new(from.x + x, from.y + y)),
                    None => nearest(&new, *from),
                };
                if let Some(to) = to {
                    path.move_to(*from);
                    path.line_to(to);
                }
            }
        }
        if !path.elements().is_empty() {
            self.findings.push(mark(path, stroke(MOVED_COLOUR, width, Vec::new()), Some(note)));
        }
    }
}

fn polylines(path: &BezPath) -> Vec<Vec<Point>> {
    chain::flatten(path, 0.1, false).into_iter().map(|(points, _)| points).collect()
}

/// The point of some lines nearest to a given point.
fn nearest(lines: &[Vec<Point>], p: Point) -> Option<Point> {
    let on = lines.iter().flat_map(|points| points.windows(2)).map(|pair| nearest_on(pair[0], pair[1], p));
    on.min_by(|a, b| a.distance_squared(p).total_cmp(&b.distance_squared(p)))
}

/// Converts an even-odd region to nonzero winding: rings inside an odd number of others are reversed.
fn unwound(path: &BezPath) -> BezPath {
    let rings = subpaths(path);
    if rings.len() < 2 || rings.len() > 200 {
        return path.clone();
    }
    let boxes: Vec<Rect> = rings.iter().map(BezPath::bounding_box).collect();
    let start = |ring: &BezPath| match ring.elements().first() {
        Some(PathEl::MoveTo(p)) => *p,
        _ => Point::ZERO,
    };
    let mut out = BezPath::new();
    for (index, ring) in rings.iter().enumerate() {
        let p = start(ring);
        let around =
            |other: &usize| *other != index && boxes[*other].contains(p) && rings[*other].contains(p);
        let hole = (0..rings.len()).filter(around).count() % 2 == 1;
        match hole == (ring.area() > 0.0) {
            true => out.extend(ring.reverse_subpaths()),
            false => out.extend(ring.iter()),
        }
    }
    out
}

fn stroke(colour: Colour, width: f64, dash: Vec<f64>) -> Paint {
    Paint::Stroke(StrokePaint { width, colour, cap: Cap::Round, join: Join::Round, dash, dash_offset: 0.0 })
}

fn mark(path: BezPath, paint: Paint, note: Option<&Arc<str>>) -> Mark {
    Mark { path, paint, provenance: Provenance { note: note.map(Arc::clone), ..Provenance::default() } }
}
