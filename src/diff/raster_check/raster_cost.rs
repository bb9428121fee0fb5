//! Number of pixels that a raster of a drawing paints, and the scale that limits it.

use usvg::filter::Kind;
use usvg::tiny_skia_path::Rect;
use usvg::{Group, Node};

use crate::diff::shapes::picture::Picture;

/// Least pixels per px, unless another limit requires less.
const MIN_PIXELS_PER_PX: f64 = 1.0;
/// Least pixels of the longer side of small drawings.
const MIN_SIDE_PIXELS: f64 = 600.0;
/// Most pixels of a raster.
const MAX_PIXELS: f64 = 1.5e6;
/// Most pixels of the longer side.
const MAX_SIDE_PIXELS: f64 = 16_000.0;
/// Most pixels painted for a raster, with overlapping marks counted each. A pixel takes 1 to 3 ns.
const MAX_PAINTED_PIXELS: f64 = 600e6;
/// Smaller rasters are not useful.
const MIN_USEFUL_SIDE_PIXELS: f64 = 100.0;
/// Passes over the pixels of a group on a separate layer, and for each step of a filter.
const LAYER_PASSES: f64 = 8.0;

/// Pixels per px for both drawings; `None` if one would take too long.
pub(crate) fn scale(pictures: [&Picture; 2], [width, height]: [f64; 2]) -> Option<f64> {
    if pictures.iter().any(|picture| picture.has_too_many_dashes()) {
        return None;
    }
    let longer = width.max(height);
    let work = pictures.map(|picture| painted(picture.drawn.smooth().root(), [width, height]));
    let scale = MIN_PIXELS_PER_PX
        .max(MIN_SIDE_PIXELS / longer)
        .min((MAX_PIXELS / (width * height)).sqrt())
        .min(MAX_SIDE_PIXELS / longer)
        .min((MAX_PAINTED_PIXELS / work[0].max(work[1]).max(1.0)).sqrt());
    (scale.is_finite() && scale > 0.0 && scale * longer >= MIN_USEFUL_SIDE_PIXELS).then_some(scale)
}

/// Area painted for the children of a group, in px². Each mark counts its box on the page, and so does each
/// mark of a clip path, a mask or a pattern.
fn painted(group: &Group, page: [f64; 2]) -> f64 {
    let area = |bounds: Rect| {
        let within =
            |from: f32, to: f32, size: f64| (f64::from(to).min(size) - f64::from(from).max(0.0)).max(0.0);
        within(bounds.left(), bounds.right(), page[0]) * within(bounds.top(), bounds.bottom(), page[1])
    };
    let mut sum = 0.0;
    for node in group.children() {
        sum += match node {
            Node::Group(inner) => {
                let steps = inner.filters().iter().flat_map(|filter| filter.primitives());
                let layers = f64::from(u8::from(inner.should_isolate()))
                    + steps.map(|step| kernel_pixels(step.kind())).sum::<f64>();
                painted(inner, page) + LAYER_PASSES * layers * area(inner.abs_layer_bounding_box().to_rect())
            }
            Node::Path(path) => area(path.abs_stroke_bounding_box()) + path.data().len() as f64,
            Node::Image(_) | Node::Text(_) => 0.0,
        };
        node.subroots(|root| sum += painted(root, page));
    }
    sum
}

/// Pixels that a step of a filter reads for each pixel that it writes.
fn kernel_pixels(kind: &Kind) -> f64 {
    match kind {
        Kind::Turbulence(noise) => f64::from(noise.num_octaves()).max(1.0),
        Kind::ConvolveMatrix(matrix) => matrix.matrix().data().len() as f64,
        Kind::Morphology(shape) => {
            // An upper bound for the scale: most rasters have 2 pixels per px.
            let radius = |value: f32| (8.0 * f64::from(value)).clamp(1.0, 1e4);
            radius(shape.radius_x().get()) * radius(shape.radius_y().get())
        }
        Kind::Merge(merge) => merge.inputs().len() as f64,
        _ => 1.0,
    }
}
