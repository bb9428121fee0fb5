//! DXF entities: one for each stroke or fill.

use std::f64::consts::TAU;

use kurbo::Point;

use super::arc_fitting::{FittedCurve, FittedPiece, circle_of, fit_curves};
use super::dxf_source::{DxfSource, DxfVersion};
use super::group_codes::GroupCodes;
use super::layer_table::{DxfLayer, DxfLayers, LayerPen, pen_of};
use super::objects::MODEL_SPACE;
use super::tables::APPLICATION;
use crate::drawing::{Mark, Paint};
use crate::geometry::numbers::portable_math::atan2;

/// Longest text of one pair in release 12.
const MAX_TEXT_BYTES: usize = 250;

/// All entities of a drawing as group codes.
pub(crate) struct DxfEntities {
    pub(crate) tags: GroupCodes,
    /// The first unused handle.
    pub(crate) next_handle: u32,
}

impl DxfEntities {
    pub(crate) fn of(sheet: &DxfSource, layers: &DxfLayers) -> Self {
        let next_handle = super::objects::FIRST_ENTITY_HANDLE;
        let mut writer = EntityWriter { sheet, own: Self { tags: GroupCodes::default(), next_handle } };
        for (kind, mark) in &sheet.marks {
            if let Some(layer) = layers.layer(*kind, mark) {
                writer.mark(mark, layer);
            }
        }
        writer.own
    }
}

/// Writer of entities.
struct EntityWriter<'a> {
    sheet: &'a DxfSource<'a>,
    own: DxfEntities,
}

/// Properties shared by all entities of a mark.
struct EntityCommon<'a> {
    layer: &'a DxfLayer,
    pen: LayerPen,
    part: Option<&'a str>,
}

impl EntityWriter<'_> {
    fn mark(&mut self, mark: &Mark, layer: &DxfLayer) {
        let DxfSource { place, tolerance, .. } = *self.sheet;
        let common =
            EntityCommon { layer, pen: pen_of(self.sheet, mark), part: mark.provenance.part.as_deref() };
        match &mark.paint {
            Paint::Stroke(_) => self.lines(&fit_curves(&mark.path, place, tolerance), &common),
            Paint::Outline(outline) => self.lines(&fit_curves(&outline.axis, place, tolerance), &common),
            Paint::Fill(_) | Paint::Gradient(_) => {
                self.hatch(&fit_curves(&mark.path, place, tolerance), &common)
            }
            Paint::Image(_) => {}
        }
    }

    fn lines(&mut self, curves: &[FittedCurve], common: &EntityCommon) {
        for curve in curves {
            match curve {
                FittedCurve::Circle { centre, radius } => {
                    self.begin("CIRCLE", "AcDbCircle", common);
                    self.own.tags.point_in_space(10, [centre.x, centre.y]);
                    self.own.tags.number(40, *radius);
                    self.end(common);
                }
                FittedCurve::Run { start, pieces, closed: false } if pieces.len() == 1 => {
                    self.single(*start, pieces[0], common);
                }
                FittedCurve::Run { start, pieces, closed } => self.polyline(*start, pieces, *closed, common),
            }
        }
    }

    /// A single straight line or arc.
    fn single(&mut self, start: Point, piece: FittedPiece, common: &EntityCommon) {
        if piece.bulge == 0.0 {
            self.begin("LINE", "AcDbLine", common);
            self.own.tags.point_in_space(10, [start.x, start.y]);
            self.own.tags.point_in_space(11, [piece.end.x, piece.end.y]);
        } else {
            let (centre, radius) = circle_of(start, piece);
            // Arcs run anticlockwise.
            let (from, to) = if piece.bulge > 0.0 { (start, piece.end) } else { (piece.end, start) };
            let degrees = |point: Point| {
                let angle = atan2(point.y - centre.y, point.x - centre.x);
                (if angle < 0.0 { angle + TAU } else { angle }).to_degrees()
            };
            self.begin("ARC", "AcDbCircle", common);
            self.own.tags.point_in_space(10, [centre.x, centre.y]);
            self.own.tags.number(40, radius);
            if self.sheet.version == DxfVersion::R2000 {
                self.own.tags.text(100, "AcDbArc");
            }
            self.own.tags.number(50, degrees(from));
            self.own.tags.number(51, degrees(to));
        }
        self.end(common);
    }

    /// Writes several lines and arcs as one polyline.
    fn polyline(&mut self, start: Point, pieces: &[FittedPiece], closed: bool, common: &EntityCommon) {
        let vertices = vertices(start, pieces, closed);
        if self.sheet.version == DxfVersion::R2000 {
            self.begin("LWPOLYLINE", "AcDbPolyline", common);
            self.own.tags.whole(90, vertices.len());
            self.own.tags.whole(70, usize::from(closed));
            for (point, bulge) in vertices {
                self.own.tags.point(10, [point.x, point.y]);
                self.bulge(bulge);
            }
            self.end(common);
            return;
        }
        self.begin("POLYLINE", "", common);
        self.own.tags.whole(66, 1);
        self.own.tags.point_in_space(10, [0.0, 0.0]);
        self.own.tags.whole(70, usize::from(closed));
        self.end(common);
        for (point, bulge) in vertices {
            self.own.tags.text(0, "VERTEX");
            self.own.tags.text(8, &common.layer.name);
            self.own.tags.point_in_space(10, [point.x, point.y]);
            self.bulge(bulge);
        }
        self.own.tags.text(0, "SEQEND");
        self.own.tags.text(8, &common.layer.name);
    }

    fn bulge(&mut self, bulge: f64) {
        if bulge != 0.0 {
            self.own.tags.number(42, bulge);
        }
    }

    /// A fill with all its rings; inner rings are holes.
    fn hatch(&mut self, curves: &[FittedCurve], common: &EntityCommon) {
        let rings: Vec<Vec<(Point, f64)>> = curves.iter().filter_map(ring).collect();
        if rings.is_empty() {
            return;
        }
        self.begin("HATCH", "AcDbHatch", common);
        let tags = &mut self.own.tags;
        tags.point_in_space(10, [0.0, 0.0]);
        tags.number(210, 0.0);
        tags.number(220, 0.0);
        tags.number(230, 1.0);
        tags.text(2, "SOLID");
        tags.whole(70, 1);
        tags.whole(71, 0);
        tags.whole(91, rings.len());
        for ring in &rings {
            // An external boundary that is a polyline.
            tags.whole(92, 3);
            tags.whole(72, 1);
            tags.whole(73, 1);
            tags.whole(93, ring.len());
            for (point, bulge) in ring {
                tags.point(10, [point.x, point.y]);
                tags.number(42, *bulge);
            }
            tags.whole(97, 0);
        }
        tags.whole(75, 0);
        tags.whole(76, 1);
        tags.whole(98, 0);
        self.end(common);
    }

    /// Writes the start of an entity: type, handle, layer, and properties that differ from the layer's.
    fn begin(&mut self, name: &str, class: &str, common: &EntityCommon) {
        let handle = self.own.next_handle;
        let tags = &mut self.own.tags;
        tags.text(0, name);
        let modern = self.sheet.version == DxfVersion::R2000;
        if modern {
            tags.handle(5, handle);
            self.own.next_handle += 1;
            tags.handle(330, MODEL_SPACE);
            tags.text(100, "AcDbEntity");
        }
        tags.text(8, &common.layer.name);
        let (pen, usual) = (&common.pen, &common.layer.pen);
        if pen.dash.is_empty() && !usual.dash.is_empty() {
            tags.text(6, super::layer_table::CONTINUOUS);
        }
        if pen.colour != usual.colour {
            tags.whole(62, usize::from(pen.colour));
        }
        if let Some(weight) = pen.weight.filter(|weight| modern && Some(*weight) != usual.weight) {
            tags.whole(370, usize::from(weight));
        }
        if modern && !class.is_empty() {
            tags.text(100, class);
        }
    }

    /// Writes the name of the part as extended data.
    fn end(&mut self, common: &EntityCommon) {
        if let Some(part) = common.part {
            self.own.tags.text(1001, APPLICATION);
            self.own.tags.text(1000, &plain(part));
        }
    }
}

/// Corners of a run, each with the bulge of the next piece.
fn vertices(start: Point, pieces: &[FittedPiece], closed: bool) -> Vec<(Point, f64)> {
    let starts = std::iter::once(start).chain(pieces.iter().map(|piece| piece.end));
    let bulges = pieces.iter().map(|piece| piece.bulge).chain(std::iter::once(0.0));
    let mut vertices: Vec<(Point, f64)> = starts.zip(bulges).collect();
    if closed {
        vertices.pop();
    }
    vertices
}

/// Corners of a closed curve; a circle becomes two arcs.
fn ring(curve: &FittedCurve) -> Option<Vec<(Point, f64)>> {
    match curve {
        FittedCurve::Circle { centre, radius } => {
            Some([1.0, -1.0].map(|side| (Point::new(centre.x + side * radius, centre.y), 1.0)).to_vec())
        }
        FittedCurve::Run { start, pieces, .. } => {
            let comes_back = pieces.last().is_some_and(|piece| piece.end == *start);
            let ring = vertices(*start, pieces, comes_back);
            (ring.len() > 1).then_some(ring)
        }
    }
}

/// A text in one line of ASCII. Other characters are written as `\U+XXXX`, as DXF requires.
fn plain(text: &str) -> String {
    let mut plain = String::new();
    for letter in text.chars() {
        let mut units = [0; 2];
        let told = match letter {
            ' '..='~' => letter.to_string(),
            _ => letter.encode_utf16(&mut units).iter().map(|unit| format!("\\U+{unit:04X}")).collect(),
        };
        if plain.len() + told.len() > MAX_TEXT_BYTES {
            break;
        }
        plain += &told;
    }
    plain
}
