//! [`empty_reason`]: why a drawing has no mark.
//!
//! The candidates are narrowed down in pipeline order:
//! 1. contents of the scene;
//! 2. those with an area or a length;
//! 3. those that the style draws;
//! 4. those in front of the camera;
//! 5. those in its frame;
//! 6. those not seen edge-on.
//!
//! The first step that leaves nothing is the reason.

use glam::DVec3;

use crate::drawing::{Layer, LayerKind};
use crate::mesh::Mesh;
use crate::scene::Scene;
use crate::style::Style;
use crate::view::{Frame, View};

/// Whether layers show nothing of a model: no mark except those of the paper.
pub(crate) fn shows_nothing(layers: &[Layer]) -> bool {
    let is_paper = |kind: LayerKind| matches!(kind, LayerKind::Paper | LayerKind::Tooth);
    layers.iter().all(|layer| is_paper(layer.kind) || layer.marks.is_empty())
}

/// The reason why a drawing is empty, as a sentence. `has_chains` says whether lines are visible.
pub(crate) fn empty_reason(
    scene: &Scene,
    (mesh, view): (&Mesh, &View),
    style: &Style,
    has_chains: bool,
) -> String {
    let why = of_scene(scene, mesh).or_else(|| of_style(style)).or_else(|| of_view(mesh, view)).unwrap_or(
        if has_chains {
            "the style draws none of the visible lines"
        } else {
            "no line of the model is visible"
        },
    );
    format!("the drawing is empty: {why}")
}

/// The reason in the scene, if it is there.
fn of_scene(scene: &Scene, mesh: &Mesh) -> Option<&'static str> {
    if scene.parts.is_empty() {
        return Some("the scene has no parts");
    }
    if scene.parts.iter().all(|part| scene.geometry_of(part).is_none()) {
        return Some("all parts are scaled to zero, or not finite");
    }
    let has_area = mesh.face_normals.iter().any(|normal| *normal != [0.0; 3]);
    if has_area || !mesh.wires.is_empty() {
        return None;
    }
    let left_out = mesh.cleaning.collapsed + mesh.cleaning.degenerate;
    Some(if left_out > 0 {
        "no face has an area"
    } else if mesh.cleaning.short_wires > 0 {
        "no line has a length"
    } else {
        "all materials are transparent"
    })
}

/// The reason in the style, if it is there.
fn of_style(style: &Style) -> Option<&'static str> {
    let has_lines = style.lines.enabled && !style.lines.kinds.is_empty();
    let draws = has_lines || style.region.enabled || style.hatch.enabled || style.motion.enabled;
    (!draws).then_some("the style draws neither lines nor surfaces")
}

/// The reason in the view, if it is there: the position of the model.
fn of_view(mesh: &Mesh, view: &View) -> Option<&'static str> {
    let frame = &view.frame;
    let faces = mesh.triangles.iter().zip(&mesh.face_normals).filter(|(_, normal)| **normal != [0.0; 3]);
    let faces: Vec<&[u32; 3]> = faces.map(|(corners, _)| corners).collect();
    let (mut before, mut inside, mut turned) = (false, false, false);
    let clipped = view.clipped.iter().map(|piece| (piece.face.index(), piece.points));
    let pieces = clipped.filter_map(|(face, points)| Some((mesh.triangles.get(face)?, points.to_vec())));
    let whole = faces.iter().map(|corners| (*corners, image(view, corners.as_slice())));
    for (corners, points) in whole.chain(pieces) {
        if points.iter().any(|p| p.z.is_nan()) {
            continue;
        }
        before = true;
        if is_in_frame(frame, &points) {
            inside = true;
            let [a, b, c] = corners.map(|v| mesh.positions.get(v as usize).copied().unwrap_or_default());
            turned |= frame.faces_eye(a, b, c) || frame.faces_eye(a, c, b);
        }
    }
    for wire in &mesh.wires {
        let points = image(view, &wire.vertices);
        // A wire cut by the near plane may continue in the frame.
        let cut = points.iter().filter(|p| p.z.is_nan()).count();
        before |= cut < points.len();
        let is_inside = cut < points.len() && (cut > 0 || is_in_frame(frame, &points));
        (inside, turned) = (inside || is_inside, turned || is_inside);
    }
    match (before, inside, turned) {
        (false, ..) => Some("all of the model is behind the camera"),
        (true, false, _) => Some("all of the model is outside the frame"),
        (true, true, false) => Some("all faces in the frame are seen edge-on"),
        (true, true, true) => None,
    }
}

/// Vertices in image space.
fn image(view: &View, vertices: &[u32]) -> Vec<DVec3> {
    vertices.iter().filter_map(|v| view.points.get(*v as usize).copied()).collect()
}

/// Whether the bounding box of image points overlaps the frame.
fn is_in_frame(frame: &Frame, points: &[DVec3]) -> bool {
    let low = points.iter().copied().fold(DVec3::INFINITY, DVec3::min);
    let high = points.iter().copied().fold(DVec3::NEG_INFINITY, DVec3::max);
    low.x <= frame.width && high.x >= 0.0 && low.y <= frame.height && high.y >= 0.0
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use crate::pipeline::render;
    use crate::scene::{Camera, NamedView, Scene, UpAxis, WarningKind};
    use crate::style::Style;

    fn scene(corners: [[f64; 3]; 3]) -> Scene {
        Scene::from_triangles(corners, [[0, 1, 2]]).unwrap()
    }

    fn empty_drawing_warning(scene: &Scene, camera: &Camera, sets: &[&str]) -> String {
        let sets: Vec<String> = sets.iter().map(|&set| set.to_owned()).collect();
        let style = Style::load_with("ink", &sets).unwrap();
        let drawing = render(scene, camera, &style).unwrap();
        let empty = drawing.warnings.iter().find(|warning| warning.kind == WarningKind::EmptyDrawing);
        empty.expect("a warning").to_string()
    }

    #[test]
    fn an_empty_drawing_warns_with_the_reason() {
        let flat = scene([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let camera = Camera::three_quarter().fit(&flat);
        let needle = scene([[0.0; 3], [1.0, 0.0, 0.0], [2.0, 0.0, 0.0]]);
        assert!(empty_drawing_warning(&needle, &camera, &[]).contains("no face has an area"));
        let point = scene([[0.0; 3], [0.0; 3], [2.0, 0.0, 0.0]]);
        assert!(empty_drawing_warning(&point, &camera, &[]).contains("no face has an area"));
        let nothing = Scene::default();
        assert!(empty_drawing_warning(&nothing, &camera, &[]).contains("no parts"));
        let mut shrunk = flat.clone();
        shrunk.parts[0].world_from_part.matrix3 *= 0.0;
        assert!(empty_drawing_warning(&shrunk, &camera, &[]).contains("scaled to zero"));
        let mut dot = flat.clone();
        dot.geometries[0].triangles.clear();
        dot.geometries[0].wires.push([1, 1]);
        assert!(empty_drawing_warning(&dot, &camera, &[]).contains("no line has a length"));

        let off = empty_drawing_warning(&flat, &camera, &["lines.enabled=false"]);
        assert!(off.contains("neither lines nor surfaces"), "{off}");
        let behind = Camera { target: camera.eye * 2.0 - camera.target, ..camera };
        assert!(empty_drawing_warning(&flat, &behind, &[]).contains("behind the camera"));
        let beside =
            Camera { eye: camera.eye + DVec3::X * 50.0, target: camera.target + DVec3::X * 50.0, ..camera };
        assert!(empty_drawing_warning(&flat, &beside, &[]).contains("outside the frame"));
        let side = Camera::named(NamedView::Right, UpAxis::Y).fit(&flat);
        let edge_on = empty_drawing_warning(&flat, &side, &["lines.enabled=false", "fills.enabled=true"]);
        assert!(edge_on.contains("edge-on"), "{edge_on}");
        let none = empty_drawing_warning(&flat, &camera, &["lines.kinds=[\"wire\"]"]);
        assert!(none.contains("no line of the model is visible"), "{none}");
    }

    #[test]
    fn a_drawing_with_marks_has_no_warning() {
        let flat = scene([[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        let drawing = render(&flat, &Camera::three_quarter().fit(&flat), &Style::default()).unwrap();
        assert!(drawing.warnings.is_empty(), "{:?}", drawing.warnings);
    }
}
