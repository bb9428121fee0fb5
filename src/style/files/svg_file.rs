//! Reads the paths of SVG files for brushes and tiles.

use kurbo::BezPath;

#[cfg(feature = "png")]
use crate::export::raster::tree_painter::bez_path;
use crate::hatching::WindingRule;

/// The paths of an SVG file.
#[derive(Debug, Clone, Default)]
pub(crate) struct SvgPaths {
    /// Width and height of the SVG picture.
    pub size: [f64; 2],
    /// All paths, painted or not.
    pub paths: Vec<BezPath>,
    /// The areas painted in dark colours: fills, and strokes as their outlines.
    pub painted: Vec<(BezPath, WindingRule)>,
}

/// Reads an SVG file.
#[cfg(not(feature = "png"))]
pub(crate) fn read(_: &[u8]) -> Result<SvgPaths, String> {
    Err("is SVG, which this program was built without (feature `png`)".to_owned())
}

/// Reads an SVG file.
#[cfg(feature = "png")]
pub(crate) fn read(bytes: &[u8]) -> Result<SvgPaths, String> {
    let tree =
        usvg::Tree::from_data(bytes, &usvg::Options::default()).map_err(|e| format!("is not SVG ({e})"))?;
    let size = [tree.size().width(), tree.size().height()].map(f64::from);
    let mut found = SvgPaths { size, ..SvgPaths::default() };
    gather(tree.root(), &mut found);
    Ok(found)
}

#[cfg(feature = "png")]
fn gather(group: &usvg::Group, found: &mut SvgPaths) {
    for node in group.children() {
        match node {
            usvg::Node::Group(inner) => gather(inner, found),
            usvg::Node::Path(path) => {
                let placed = |own: usvg::tiny_skia_path::Path| own.transform(path.abs_transform());
                let whole = placed(path.data().clone()).map(|own| bez_path(&own)).unwrap_or_default();
                if let Some(fill) = path.fill().filter(|fill| path.is_visible() && is_dark(fill.paint())) {
                    let filling = match fill.rule() {
                        usvg::FillRule::NonZero => WindingRule::NonZero,
                        usvg::FillRule::EvenOdd => WindingRule::EvenOdd,
                    };
                    found.painted.push((whole.clone(), filling));
                }
                if let Some(stroke) =
                    path.stroke().filter(|stroke| path.is_visible() && is_dark(stroke.paint()))
                {
                    let stroke = stroke.to_tiny_skia();
                    let dashed = stroke
                        .dash
                        .as_ref()
                        .and_then(|dash| path.data().clone().dash(dash, STROKE_RESOLUTION_SCALE));
                    let outline =
                        dashed.as_ref().unwrap_or(path.data()).stroke(&stroke, STROKE_RESOLUTION_SCALE);
                    let outline = outline.and_then(placed).map(|own| bez_path(&own)).unwrap_or_default();
                    found.painted.push((outline, WindingRule::NonZero));
                }
                found.paths.push(whole);
            }
            usvg::Node::Image(_) | usvg::Node::Text(_) => {}
        }
    }
}

/// Resolution scale for stroke outlines: they are as fine as for a picture this many times larger.
#[cfg(feature = "png")]
const STROKE_RESOLUTION_SCALE: f32 = 8.0;

/// Whether a paint is dark; gradients and patterns count as dark.
#[cfg(feature = "png")]
fn is_dark(paint: &usvg::Paint) -> bool {
    match paint {
        usvg::Paint::Color(c) => u32::from(c.red) + u32::from(c.green) + u32::from(c.blue) < 3 * 128,
        _ => true,
    }
}
