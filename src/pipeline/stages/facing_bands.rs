//! n·v on the front faces: bands of colour, warm where the surface faces the camera and cool where it is
//! averted. The zero set between them is a dark line.

use kurbo::{BezPath, Point, Vec2};

use super::stage_marks::{PolylineRuns, fill, line};
use super::{StageInputs, layers};
use crate::colour::srgb::Colour;
use crate::drawing::{Layer, LayerKind, Mark, Paint};
use crate::light::{SurfaceCut, cut};
use crate::lines;
use crate::view::raster::painter_order::back_to_front;
use crate::view::raster::{FaceBuffer, PixelGrid};

/// Borders between bands.
const LEVELS: [f64; 9] = [-0.8, -0.6, -0.4, -0.2, 0.0, 0.2, 0.4, 0.6, 0.8];
/// Index of the zero level.
const ZERO_LEVEL: u16 = 4;

/// Colours of the bands, most averted first.
const BAND_COLOURS: [Colour; 10] = [
    Colour::rgb(0x1d, 0x3c, 0x6e),
    Colour::rgb(0x2c, 0x5a, 0x96),
    Colour::rgb(0x45, 0x7f, 0xb8),
    Colour::rgb(0x72, 0xa6, 0xd2),
    Colour::rgb(0xa6, 0xcb, 0xe6),
    Colour::rgb(0xd9, 0x6c, 0x2c),
    Colour::rgb(0xe8, 0x93, 0x4c),
    Colour::rgb(0xf2, 0xb5, 0x77),
    Colour::rgb(0xf8, 0xd3, 0xa6),
    Colour::rgb(0xfd, 0xee, 0xd9),
];

/// Colours of flat faces, which have no smooth field: greys by their angle to the camera, and a bluish grey
/// for averted ones.
const FACING_FLAT_COLOURS: [Colour; 4] = [
    Colour::rgb(0xb4, 0xb4, 0xb0),
    Colour::rgb(0xcc, 0xcc, 0xc8),
    Colour::rgb(0xde, 0xde, 0xda),
    Colour::rgb(0xee, 0xee, 0xea),
];
const AVERTED_FLAT_COLOUR: Colour = Colour::rgb(0x86, 0x94, 0xa6);

/// Widening of pieces, px. Neighbours overlap slightly, so that no paper shows between them.
const WIDEN_PX: f64 = 0.4;

/// Cosine of the turn above which a widened corner is bevelled, 120 degrees.
const SHARP_COSINE: f64 = -0.5;

/// Draws the front faces from back to front, with the zero set over them.
pub(crate) fn draw(inputs: &StageInputs) -> Vec<Layer> {
    let (mesh, view) = (&inputs.surface.mesh, inputs.view);
    let cut = cut(mesh, &inputs.surface.smooth, &lines::facing(inputs.surface, view), &LEVELS);
    let screen = PixelGrid::new(mesh, view);
    let buffer = FaceBuffer::new(&screen);
    let order = back_to_front(&screen, &buffer);
    let mut fills: Vec<Mark> = Vec::new();
    for face in &order {
        let pieces = cut.of_face(*face);
        if pieces.is_empty() {
            let colour = flat_colour(inputs, *face);
            let corners = &mesh.triangles[*face as usize];
            paint(&mut fills, inputs, &cut, corners, colour, &["field", "flat"], "a flat face");
        }
        for piece in pieces {
            let band = usize::from(piece.band);
            let side = if piece.band > ZERO_LEVEL { "facing" } else { "averted" };
            let note = format!("n·v {:.1} to {:.1}", band as f64 / 5.0 - 1.0, (band + 1) as f64 / 5.0 - 1.0);
            paint(&mut fills, inputs, &cut, cut.corners(piece), BAND_COLOURS[band], &["field", side], &note);
        }
    }
    let dark = Colour::rgb(0x1a, 0x1a, 0x1a);
    let zero = zero_set(inputs, &cut, &buffer)
        .map(|path| line(path, dark, inputs.px(1.2), &["zero-set"], Some("the zero set of n·v")));
    layers([(LayerKind::Fills, fills), (LayerKind::Lines, zero.into_iter().collect())])
}

fn flat_colour(inputs: &StageInputs, face: u32) -> Colour {
    if !inputs.view.facing[face as usize] {
        return AVERTED_FLAT_COLOUR;
    }
    // The view axis is used instead of the eye direction, so that triangles of one plane are alike.
    let normal = glam::Vec3::from_array(inputs.surface.mesh.face_normals[face as usize]).as_dvec3();
    let cosine = -normal.dot(inputs.view.frame.forward);
    FACING_FLAT_COLOURS
        [((cosine.max(0.0) * FACING_FLAT_COLOURS.len() as f64) as usize).min(FACING_FLAT_COLOURS.len() - 1)]
}

/// Paints a polygon. Consecutive polygons of one colour share a mark.
fn paint(
    marks: &mut Vec<Mark>,
    inputs: &StageInputs,
    cut: &SurfaceCut,
    corners: &[u32],
    colour: Colour,
    classes: &[&'static str],
    note: &str,
) {
    let Some(points) = corners.iter().map(|c| on_page(inputs, cut, *c)).collect::<Option<Vec<_>>>() else {
        return;
    };
    let points = widened(&points, inputs.px(WIDEN_PX));
    let like = |mark: &&mut Mark| mark.paint == Paint::Fill(colour);
    let add = |path: &mut BezPath| {
        super::stage_marks::add(path, &points);
        path.close_path();
    };
    match marks.last_mut().filter(like) {
        Some(last) => add(&mut last.path),
        None => {
            let mut path = BezPath::new();
            add(&mut path);
            marks.push(fill(path, colour, classes, Some(note)));
        }
    }
}

/// A corner of a piece on the page; `None` if the near plane cuts it off.
fn on_page(inputs: &StageInputs, cut: &SurfaceCut, corner: u32) -> Option<Point> {
    let point = match inputs.view.points.get(corner as usize) {
        Some(point) => *point,
        None => inputs.view.frame.image_from_local(cut.position(&inputs.surface.mesh, corner)),
    };
    (!point.z.is_nan()).then(|| Point::new(point.x, point.y) + inputs.margin())
}

/// A polygon with its sides moved outwards, always in the same orientation, so that overlapping polygons in
/// one path fill together.
fn widened(points: &[Point], by: f64) -> Vec<Point> {
    let n = points.len();
    let twice_area: f64 = (0..n).map(|k| points[k].to_vec2().cross(points[(k + 1) % n].to_vec2())).sum();
    let points: Vec<Point> =
        if twice_area < 0.0 { points.iter().rev().copied().collect() } else { points.to_vec() };
    let outward = |k: usize| {
        let side = points[(k + 1) % n] - points[k];
        let length = side.hypot2().sqrt();
        if length > 0.0 { Vec2::new(side.y, -side.x) / length } else { Vec2::ZERO }
    };
    let mut out = Vec::with_capacity(2 * n);
    for (k, point) in points.iter().enumerate() {
        let (before, after) = (outward((k + n - 1) % n), outward(k));
        let cosine = before.dot(after);
        if cosine > SHARP_COSINE {
            out.push(*point + (before + after) * (by / (1.0 + cosine)));
        } else {
            out.extend([*point + before * by, *point + after * by]);
        }
    }
    out
}

/// The zero set where its face is in front, or no face is.
fn zero_set(inputs: &StageInputs, surface_cut: &SurfaceCut, buffer: &FaceBuffer) -> Option<BezPath> {
    let mesh = &inputs.surface.mesh;
    let per_unit = buffer.columns as f64 / inputs.view.frame.width;
    let in_front = |face: u32, middle: Point| {
        let corners = mesh.triangles[face as usize];
        let (column, row) = ((middle.x * per_unit).floor() as isize, (middle.y * per_unit).floor() as isize);
        let mut pixels_around = (-1..=1).flat_map(|dy| (-1..=1).map(move |dx| (column + dx, row + dy)));
        pixels_around.any(|(x, y)| {
            if x < 0 || y < 0 || x as usize >= buffer.columns || y as usize >= buffer.rows {
                return false;
            }
            let front = buffer.front(y as usize * buffer.columns + x as usize);
            front.is_none_or(|front| mesh.triangles[front as usize].iter().any(|v| corners.contains(v)))
        })
    };
    let mut runs = PolylineRuns::default();
    for (face, side) in surface_cut.border(ZERO_LEVEL) {
        let [Some(a), Some(b)] = side.map(|corner| on_page(inputs, surface_cut, corner)) else { continue };
        if in_front(face, a.midpoint(b) - inputs.margin()) {
            runs.push([a, b]);
        }
    }
    runs.finish()
}
