//! Work of rasterising a drawing, and the scale that limits it.

use usvg::filter::Kind;
use usvg::tiny_skia_path::Rect;
use usvg::{Group, Node, Paint};

use crate::diff::shapes::picture::Picture;
use crate::diff::tolerances;

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
/// Most dashes of a drawing, because each is drawn separately.
const MAX_DASHES: f64 = 400_000.0;
/// Passes over the pixels of an isolated group.
const LAYER_PASSES: f64 = 4.0;
/// Passes over the pixels of a mask.
const MASK_PASSES: f64 = 8.0;
/// Passes over the pixels of a filter primitive.
const FILTER_PASSES: f64 = 16.0;

/// Pixels per px for both drawings; `None` if one would take too long.
pub(crate) fn scale(pictures: [&Picture; 2], [width, height]: [f64; 2]) -> Option<f64> {
    let longer = width.max(height);
    let mut work = 0.0f64;
    for picture in pictures {
        let mut cost = RasterCost { page: [width, height], dashes: 0.0 };
        work = work.max(cost.group(picture.drawn.smooth().root(), None));
        if cost.dashes > MAX_DASHES {
            return None;
        }
    }
    let scale = MIN_PIXELS_PER_PX
        .max(MIN_SIDE_PIXELS / longer)
        .min((MAX_PIXELS / (width * height)).sqrt())
        .min(MAX_SIDE_PIXELS / longer)
        .min((MAX_PAINTED_PIXELS / work.max(1.0)).sqrt());
    (scale.is_finite() && scale > 0.0 && scale * longer >= MIN_USEFUL_SIDE_PIXELS).then_some(scale)
}

/// Accumulated work of a drawing.
struct RasterCost {
    page: [f64; 2],
    dashes: f64,
}

impl RasterCost {
    /// Passes in px² for the children of a group. `of`: area of the surface they are painted on, if it is not
    /// the page.
    fn group(&mut self, group: &Group, of: Option<f64>) -> f64 {
        let area = of.unwrap_or_else(|| self.area(group.abs_layer_bounding_box().to_rect()));
        let mut sum = 0.0;
        if group.should_isolate() {
            sum += LAYER_PASSES * area;
        }
        for filter in group.filters() {
            sum += filter
                .primitives()
                .iter()
                .map(|step| FILTER_PASSES * area * filter_passes(step.kind()))
                .sum::<f64>();
        }
        let mut clip = group.clip_path();
        while let Some(path) = clip {
            sum += LAYER_PASSES * area + self.group(path.root(), Some(area));
            clip = path.clip_path();
        }
        let mut mask = group.mask();
        while let Some(content) = mask {
            sum += MASK_PASSES * area + self.group(content.root(), Some(area));
            mask = content.mask();
        }
        for node in group.children() {
            sum += match node {
                Node::Group(inner) => self.group(inner, of),
                Node::Path(path) => self.path(path, of),
                Node::Image(_) | Node::Text(_) => 0.0,
            };
        }
        sum
    }

    /// Passes in px² for a path; also counts its dashes.
    fn path(&mut self, path: &usvg::Path, of: Option<f64>) -> f64 {
        let area = of.unwrap_or_else(|| self.area(path.abs_stroke_bounding_box()));
        let mut sum = area + path.data().len() as f64;
        if let Some(dash) = path.stroke().and_then(|stroke| stroke.dasharray()) {
            let pattern: f64 = dash.iter().map(|length| f64::from(*length)).sum();
            self.dashes += length(path.data()) / pattern.max(tolerances::MIN_DIVISOR_PX) * dash.len() as f64;
        }
        for paint in [path.fill().map(usvg::Fill::paint), path.stroke().map(usvg::Stroke::paint)] {
            if let Some(Paint::Pattern(pattern)) = paint {
                sum += LAYER_PASSES * area + self.group(pattern.root(), Some(area));
            }
        }
        sum
    }

    /// Area of the part of a box on the page, in px².
    fn area(&self, bounds: Rect) -> f64 {
        let within =
            |from: f32, to: f32, size: f64| (f64::from(to).min(size) - f64::from(from).max(0.0)).max(0.0);
        within(bounds.left(), bounds.right(), self.page[0])
            * within(bounds.top(), bounds.bottom(), self.page[1])
    }
}

/// Passes of a filter primitive over each pixel.
fn filter_passes(kind: &Kind) -> f64 {
    match kind {
        Kind::Turbulence(noise) => 4.0 * f64::from(noise.num_octaves()).max(1.0),
        Kind::ConvolveMatrix(matrix) => {
            f64::from(matrix.matrix().columns()) * f64::from(matrix.matrix().rows())
        }
        Kind::Morphology(shape) => {
            // An upper bound for the scale: most rasters have 2 pixels per px.
            let radius = |value: f32| (8.0 * f64::from(value)).clamp(1.0, 1e4);
            radius(shape.radius_x().get()) * radius(shape.radius_y().get())
        }
        Kind::Merge(merge) => merge.inputs().len() as f64,
        _ => 1.0,
    }
}

/// Lower bound of the length of a path: the distances between its points.
fn length(path: &usvg::tiny_skia_path::Path) -> f64 {
    let way = |pair: &[usvg::tiny_skia_path::Point]| f64::from((pair[1] - pair[0]).length());
    path.points().windows(2).map(way).sum()
}
