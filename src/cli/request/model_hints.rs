//! Hints about common problems of models, each with the option that fixes it.
//!
//! Two rules use the bounding boxes of the parts:
//! - A y-up model *lies on its back* if it stands on the plane z = 0 and the plane y = 0 cuts through it.
//!   Programs with z up place models on the plane z = 0 and centre them there. OBJ and PLY files do not store
//!   the up axis, so ligne assumes y.
//! - A flat *ground* shrinks the rest if it is many times larger than all other parts together.
//!
//! A hint is a note. It does not change the drawing, and `--strict` accepts it.

use glam::DVec3;

use super::draw_request::DrawRequest;
use super::viewpoint::ViewRequest;
use crate::geometry::names::glob::Glob;
use crate::scene::extent::coordinate_limits::bounds;
use crate::scene::{Scene, UpAxis};

/// Maximum distance from z = 0 of a model that stands on it, as a share of its extent along z.
const MAX_BASE_GAP_RATIO: f64 = 0.005;

/// Minimum reach to each side of y = 0, as a share of the extent along y.
const MIN_REACH_RATIO: f64 = 0.05;

/// Minimum extent along z of a model that can lie on its back, as a share of its largest extent. Thinner
/// models are sheets.
const MIN_HEIGHT_RATIO: f64 = 0.05;

/// Maximum thickness of a ground, as a share of its largest extent.
const MAX_GROUND_THICKNESS_RATIO: f64 = 0.05;

/// Maximum diagonal of all parts except the ground, as a share of the whole diagonal.
const MAX_REST_RATIO: f64 = 0.1;

/// Hints for a drawing of a scene. A camera record was chosen for the model, so it gives no hints.
pub(crate) fn of_drawing(request: &DrawRequest, scene: &Scene) -> Vec<String> {
    if matches!(request.view, ViewRequest::Recorded(_) | ViewRequest::Fixed(..)) {
        return Vec::new();
    }
    let up = request.how.up;
    of_scene(scene)
        .into_iter()
        .filter(|hint| up.is_none() || !hint.is_about_up)
        .map(|hint| hint.text)
        .collect()
}

/// Hint about a model.
pub(crate) struct ModelHint {
    pub(crate) text: String,
    is_about_up: bool,
}

/// Hints about a scene.
pub(crate) fn of_scene(scene: &Scene) -> Vec<ModelHint> {
    let boxes: Vec<Option<PartBox>> = (0..scene.parts.len()).map(|part| box_of(scene, part)).collect();
    let back = lies_on_its_back(scene, &boxes).then(|| ModelHint {
        text: "the model seems to have z up and to lie on its back; --up z makes it stand".to_owned(),
        is_about_up: true,
    });
    let ground = ground(scene, &boxes).map(|text| ModelHint { text, is_about_up: false });
    back.into_iter().chain(ground).collect()
}

/// Lowest and highest corner, world space.
type PartBox = (DVec3, DVec3);

/// World-space box of a part, from the corners of the box of its geometry.
fn box_of(scene: &Scene, part: usize) -> Option<PartBox> {
    let part = scene.parts.get(part)?;
    let (low, high) = bounds(&scene.geometry_of(part)?.positions)?;
    let corner = |i: u8| {
        let side = |axis: u8, low: f64, high: f64| if i >> axis & 1 == 0 { low } else { high };
        part.world_from_part.transform_point3(DVec3::new(
            side(0, low.x, high.x),
            side(1, low.y, high.y),
            side(2, low.z, high.z),
        ))
    };
    bounds(&std::array::from_fn::<DVec3, 8, _>(|i| corner(i as u8)))
}

fn union(boxes: impl Iterator<Item = PartBox>) -> Option<PartBox> {
    boxes.reduce(|(low, high), (l, h)| (low.min(l), high.max(h)))
}

fn lies_on_its_back(scene: &Scene, boxes: &[Option<PartBox>]) -> bool {
    let Some((low, high)) = union(boxes.iter().flatten().copied()) else { return false };
    let size = high - low;
    let has_height = size.z > MIN_HEIGHT_RATIO * size.max_element();
    let stands_on_z = low.z.abs() <= MAX_BASE_GAP_RATIO * size.z;
    let straddles_y = low.y < -MIN_REACH_RATIO * size.y && high.y > MIN_REACH_RATIO * size.y;
    matches!(scene.format, "OBJ" | "PLY") && scene.up == UpAxis::Y && has_height && stands_on_z && straddles_y
}

/// Hint about a flat part that shrinks all others.
fn ground(scene: &Scene, boxes: &[Option<PartBox>]) -> Option<String> {
    let diagonal = |(low, high): &PartBox| (*high - *low).length();
    let drawn_boxes = || boxes.iter().enumerate().filter_map(|(part, part_box)| Some((part, (*part_box)?)));
    let (largest, _) = drawn_boxes().max_by(|(_, a), (_, b)| diagonal(a).total_cmp(&diagonal(b)))?;
    let name = scene.parts.get(largest).map(|part| part.name.as_str()).filter(|name| !name.is_empty())?;
    let glob = Glob::new(name);
    let is_hidden = |part: usize| scene.parts.get(part).is_some_and(|part| glob.matches(&part.name));
    let ground = union(drawn_boxes().filter(|(part, _)| is_hidden(*part)).map(|(_, part_box)| part_box))?;
    let rest = union(drawn_boxes().filter(|(part, _)| !is_hidden(*part)).map(|(_, part_box)| part_box))?;
    let size = ground.1 - ground.0;
    let is_flat = size.min_element() <= MAX_GROUND_THICKNESS_RATIO * size.max_element();
    let size_ratio = diagonal(&rest) / diagonal(&union([ground, rest].into_iter())?);
    (is_flat && size_ratio <= MAX_REST_RATIO).then(|| {
        let percent = (100.0 * size_ratio).ceil().max(1.0);
        let name = name.replace(char::is_control, " ");
        format!("the part `{name}` shrinks everything else to {percent} % of the drawing; --hide '{name}' leaves it out")
    })
}

#[cfg(test)]
mod tests {
    use glam::DAffine3;

    use super::*;
    use crate::scene::{Geometry, Part};

    /// Scene with one part per box, given by name and two corners.
    fn scene(format: &'static str, boxes: &[(&str, [f64; 3], [f64; 3])]) -> Scene {
        let geometry = |(_, low, high): &(&str, [f64; 3], [f64; 3])| Geometry {
            positions: vec![DVec3::from_array(*low), DVec3::from_array(*high)],
            ..Geometry::default()
        };
        let part = |(geometry, own): (usize, &(&str, [f64; 3], [f64; 3]))| Part {
            name: own.0.to_owned(),
            geometry,
            world_from_part: DAffine3::IDENTITY,
        };
        Scene {
            format,
            geometries: boxes.iter().map(geometry).collect(),
            parts: boxes.iter().enumerate().map(part).collect(),
            ..Scene::default()
        }
    }

    fn hints(format: &'static str, boxes: &[(&str, [f64; 3], [f64; 3])]) -> Vec<String> {
        of_scene(&scene(format, boxes)).into_iter().map(|hint| hint.text).collect()
    }

    #[test]
    fn hint_reports_models_that_lie_on_their_back() {
        let lies = |format, low, high| !hints(format, &[("lid", low, high)]).is_empty();
        assert!(lies("OBJ", [-3.0, -2.0, 0.0], [3.0, 2.0, 5.0]));
        assert!(lies("PLY", [-3.0, -2.0, 0.01], [3.0, 2.0, 5.0]));
        // The format defines the up axis; the model stands on y = 0; it floats; it is a sheet; it lies on one
        // side of y = 0.
        assert!(!lies("glTF", [-3.0, -2.0, 0.0], [3.0, 2.0, 5.0]));
        assert!(!lies("OBJ", [-3.0, 0.0, 0.0], [3.0, 4.0, 5.0]));
        assert!(!lies("OBJ", [-3.0, -2.0, -2.5], [3.0, 2.0, 2.5]));
        assert!(!lies("OBJ", [-3.0, -2.0, 0.0], [3.0, 2.0, 0.1]));
        assert!(!lies("OBJ", [-3.0, 2.0, 0.0], [3.0, 4.0, 5.0]));
    }

    #[test]
    fn hint_names_a_ground_that_shrinks_the_other_parts() {
        let house = ("house", [0.0, 0.0, 0.0], [10.0, 8.0, 10.0]);
        let found = hints("glTF", &[house, ("ground", [-1000.0, -1.0, -1000.0], [1000.0, 0.0, 1000.0])]);
        assert!(found[0].contains("`ground`") && found[0].contains("to 1 %"), "{found:?}");
        assert!(found[0].contains("--hide 'ground'"), "{found:?}");
        // A small lawn, a dome, and a ground without other parts.
        assert_eq!(hints("glTF", &[house, ("lawn", [-20.0, -1.0, -20.0], [20.0, 0.0, 20.0])]).len(), 0);
        assert_eq!(hints("glTF", &[house, ("sky", [-1e3; 3], [1e3; 3])]).len(), 0);
        assert_eq!(hints("glTF", &[("ground", [-1e3, -1.0, -1e3], [1e3, 0.0, 1e3])]).len(), 0);
    }
}
