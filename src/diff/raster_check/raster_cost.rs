//! What it takes to rasterise a drawing, and the scale that keeps it within bounds.

use usvg::filter::Kind;
use usvg::tiny_skia_path::Rect;
use usvg::{Group, Node, Paint};

use crate::diff::shapes::picture::Picture;

/// Pixels to a px, and pixels of the longer side of small drawings.
const SCALE: f64 = 1.0;
const MIN_SIDE: f64 = 600.0;
/// Pixels of a picture, and of one of its sides.
const MAX_PIXELS: f64 = 1.5e6;
const MAX_SIDE: f64 = 16_000.0;
/// Pixels that are painted for a picture, those of marks that lie on each other counted each; 1 to 3 ns each.
const MAX_WORK: f64 = 600e6;
/// Smaller pictures than this show nothing.
const LEAST_SIDE: f64 = 100.0;
/// Dashes of a drawing: each is drawn.
const MAX_DASHES: f64 = 400_000.0;
/// How often a group of its own, a mask and a step of a filter pass over their pixels.
const LAYER: f64 = 4.0;
const MASK: f64 = 8.0;
const FILTER: f64 = 16.0;

/// Pixels to a px for both drawings; `None` where one would take too long.
pub(crate) fn scale(pictures: [&Picture; 2], [width, height]: [f64; 2]) -> Option<f64> {
    let longer = width.max(height);
    let mut work = 0.0f64;
    for picture in pictures {
        let mut cost = Cost { page: [width, height], dashes: 0.0 };
        work = work.max(cost.group(picture.drawn.smooth().root(), None));
        if cost.dashes > MAX_DASHES {
            return None;
        }
    }
    let scale = SCALE
        .max(MIN_SIDE / longer)
        .min((MAX_PIXELS / (width * height)).sqrt())
        .min(MAX_SIDE / longer)
        .min((MAX_WORK / work.max(1.0)).sqrt());
    (scale.is_finite() && scale > 0.0 && scale * longer >= LEAST_SIDE).then_some(scale)
}

struct Cost {
    page: [f64; 2],
    dashes: f64,
}

impl Cost {
    /// Passes over px² for the nodes of a group; `of`: how large what they are painted on is, where that is no page.
    fn group(&mut self, group: &Group, of: Option<f64>) -> f64 {
        let area = of.unwrap_or_else(|| self.area(group.abs_layer_bounding_box().to_rect()));
        let mut sum = 0.0;
        if group.should_isolate() {
            sum += LAYER * area;
        }
        for filter in group.filters() {
            sum += filter.primitives().iter().map(|step| FILTER * area * times(step.kind())).sum::<f64>();
        }
        let mut clip = group.clip_path();
        while let Some(path) = clip {
            sum += LAYER * area + self.group(path.root(), Some(area));
            clip = path.clip_path();
        }
        let mut mask = group.mask();
        while let Some(content) = mask {
            sum += MASK * area + self.group(content.root(), Some(area));
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

    fn path(&mut self, path: &usvg::Path, of: Option<f64>) -> f64 {
        let area = of.unwrap_or_else(|| self.area(path.abs_stroke_bounding_box()));
        let mut sum = area + path.data().len() as f64;
        if let Some(dash) = path.stroke().and_then(|stroke| stroke.dasharray()) {
            let pattern: f64 = dash.iter().map(|length| f64::from(*length)).sum();
            self.dashes += length(path.data()) / pattern.max(1e-9) * dash.len() as f64;
        }
        for paint in [path.fill().map(usvg::Fill::paint), path.stroke().map(usvg::Stroke::paint)] {
            if let Some(Paint::Pattern(pattern)) = paint {
                sum += LAYER * area + self.group(pattern.root(), Some(area));
            }
        }
        sum
    }

    /// The part of a box that lies on the page, px².
    fn area(&self, bounds: Rect) -> f64 {
        let within =
            |from: f32, to: f32, size: f64| (f64::from(to).min(size) - f64::from(from).max(0.0)).max(0.0);
        within(bounds.left(), bounds.right(), self.page[0])
            * within(bounds.top(), bounds.bottom(), self.page[1])
    }
}

/// How often a step of a filter passes over each pixel.
fn times(kind: &Kind) -> f64 {
    match kind {
        Kind::Turbulence(noise) => 4.0 * f64::from(noise.num_octaves()).max(1.0),
        Kind::ConvolveMatrix(matrix) => {
            f64::from(matrix.matrix().columns()) * f64::from(matrix.matrix().rows())
        }
        Kind::Morphology(shape) => {
            // Pixels to a px are 2 in most pictures, and more where one looks closely.
            let radius = |value: f32| (8.0 * f64::from(value)).clamp(1.0, 1e4);
            radius(shape.radius_x().get()) * radius(shape.radius_y().get())
        }
        Kind::Merge(merge) => merge.inputs().len() as f64,
        _ => 1.0,
    }
}

/// At least the length of a path: that between the points that it names.
fn length(path: &usvg::tiny_skia_path::Path) -> f64 {
    let way = |pair: &[usvg::tiny_skia_path::Point]| f64::from((pair[1] - pair[0]).length());
    path.points().windows(2).map(way).sum()
}
