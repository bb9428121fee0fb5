//! The tree of an SVG text, painted on pixels: paths of one colour by exact coverage, all else by resvg.
//!
//! The rasteriser of resvg paints strokes of a pixel or less as hairlines: a slanted one is too thin by the cosine of its slant.
//! It samples wider ones, and fills, four times a pixel, so that a line of 1.1 px has 1 or 1.25 px of ink.

use tiny_skia::{BlendMode, IntRect, Mask, MaskType, Pixmap, PixmapMut, PixmapPaint, Transform};
use usvg::{Group, Node, Paint, PaintOrder};

use super::png_coverage::{Coverage, Ink, Winding};

/// Paints a tree over what is there; `to` leads from its units to pixels.
pub(crate) fn render(tree: &usvg::Tree, to: Transform, pixmap: &mut PixmapMut) {
    nodes(tree.root(), to, pixmap);
}

fn nodes(parent: &Group, to: Transform, pixmap: &mut PixmapMut) {
    for node in parent.children() {
        let painted = match node {
            Node::Group(group) => self::group(group, to.pre_concat(group.transform()), pixmap),
            Node::Path(path) => self::path(path, to, pixmap),
            _ => None,
        };
        if painted.is_none() {
            others(node, to, pixmap);
        }
    }
}

/// Paints a node by resvg, which shifts it to its bounds.
fn others(node: &Node, to: Transform, pixmap: &mut PixmapMut) {
    if let Some(bounds) = node.abs_layer_bounding_box() {
        resvg::render_node(node, to.pre_translate(bounds.x(), bounds.y()), pixmap);
    }
}

/// Paints a group; `None` if it has masks, filters or rare ways of blending.
fn group(group: &Group, to: Transform, pixmap: &mut PixmapMut) -> Option<()> {
    if !group.should_isolate() {
        nodes(group, to, pixmap);
        return Some(());
    }
    if group.mask().is_some() || !group.filters().is_empty() || group.blend_mode() != usvg::BlendMode::Normal
    {
        return None;
    }
    let canvas = IntRect::from_xywh(0, 0, pixmap.width(), pixmap.height())?;
    let Some(bounds) = group.layer_bounding_box().transform(to).and_then(|bounds| {
        let (left, top) = ((bounds.left() - 2.0).floor() as i32, (bounds.top() - 2.0).floor() as i32);
        let (right, bottom) = ((bounds.right() + 2.0).ceil() as i32, (bounds.bottom() + 2.0).ceil() as i32);
        IntRect::from_ltrb(left, top, right, bottom)?.intersect(&canvas)
    }) else {
        // Nothing of it lies on the canvas.
        return Some(());
    };
    let mut layer = Pixmap::new(bounds.width(), bounds.height())?;
    let to = to.post_translate(-bounds.x() as f32, -bounds.y() as f32);
    nodes(group, to, &mut layer.as_mut());
    if let Some(clip) = group.clip_path() {
        self::clip(clip, to, &mut layer)?;
    }
    let paint = PixmapPaint { opacity: group.opacity().get(), ..PixmapPaint::default() };
    pixmap.draw_pixmap(bounds.x(), bounds.y(), layer.as_ref(), &paint, Transform::identity(), None);
    Some(())
}

/// Cuts a layer to a clip path.
fn clip(clip: &usvg::ClipPath, to: Transform, layer: &mut Pixmap) -> Option<()> {
    let mut inside = Pixmap::new(layer.width(), layer.height())?;
    clip_areas(clip.root(), to.pre_concat(clip.transform()), &mut inside)?;
    if let Some(outer) = clip.clip_path() {
        self::clip(outer, to, layer)?;
    }
    layer.apply_mask(&Mask::from_pixmap(inside.as_ref(), MaskType::Alpha));
    Some(())
}

/// Fills the areas of a clip path.
fn clip_areas(parent: &Group, to: Transform, inside: &mut Pixmap) -> Option<()> {
    for node in parent.children() {
        match node {
            Node::Path(path) if path.is_visible() => {
                let winding = path.fill().map_or(Winding::NonZero, |fill| winding(fill.rule()));
                let mut coverage = Coverage::new(inside.width(), inside.height());
                coverage.add(path.data(), to);
                coverage.paint(Ink::new([0; 3], 1.0), winding, &mut inside.as_mut());
            }
            Node::Group(group) => {
                let to = to.pre_concat(group.transform());
                match group.clip_path() {
                    None => clip_areas(group, to, inside)?,
                    Some(clip) => {
                        let mut own = Pixmap::new(inside.width(), inside.height())?;
                        clip_areas(group, to, &mut own)?;
                        self::clip(clip, to, &mut own)?;
                        let paint =
                            PixmapPaint { blend_mode: BlendMode::SourceOver, ..PixmapPaint::default() };
                        inside.draw_pixmap(0, 0, own.as_ref(), &paint, Transform::identity(), None);
                    }
                }
            }
            _ => {}
        }
    }
    Some(())
}

/// Paints a path; `None` if it has other paint than colours, or no smooth edges.
fn path(path: &usvg::Path, to: Transform, pixmap: &mut PixmapMut) -> Option<()> {
    if !path.is_visible() {
        return Some(());
    }
    if !path.rendering_mode().use_shape_antialiasing() {
        return None;
    }
    let fill = match path.fill() {
        Some(fill) => Some((ink(fill.paint(), fill.opacity())?, winding(fill.rule()))),
        None => None,
    };
    let stroke = match path.stroke() {
        Some(stroke) => Some((ink(stroke.paint(), stroke.opacity())?, stroke.to_tiny_skia())),
        None => None,
    };
    let filled = |pixmap: &mut PixmapMut| {
        if let Some((ink, winding)) = fill {
            let mut coverage = Coverage::new(pixmap.width(), pixmap.height());
            coverage.add(path.data(), to);
            coverage.paint(ink, winding, pixmap);
        }
    };
    let stroked = |pixmap: &mut PixmapMut| {
        let Some((ink, stroke)) = &stroke else { return };
        let scale = tiny_skia::PathStroker::compute_resolution_scale(&to);
        let dashed = stroke.dash.as_ref().map(|dash| path.data().dash(dash, scale));
        let line = match &dashed {
            Some(Some(dashed)) => dashed,
            Some(None) => return,
            None => path.data(),
        };
        if let Some(outline) = line.stroke(stroke, scale) {
            let mut coverage = Coverage::new(pixmap.width(), pixmap.height());
            coverage.add(&outline, to);
            coverage.paint(*ink, Winding::NonZero, pixmap);
        }
    };
    if path.paint_order() == PaintOrder::FillAndStroke {
        filled(pixmap);
        stroked(pixmap);
    } else {
        stroked(pixmap);
        filled(pixmap);
    }
    Some(())
}

fn winding(rule: usvg::FillRule) -> Winding {
    match rule {
        usvg::FillRule::NonZero => Winding::NonZero,
        usvg::FillRule::EvenOdd => Winding::EvenOdd,
    }
}

/// The ink of a paint of one colour.
fn ink(paint: &Paint, opacity: usvg::Opacity) -> Option<Ink> {
    match paint {
        Paint::Color(colour) => {
            Some(Ink::new([colour.red, colour.green, colour.blue], f64::from(opacity.get())))
        }
        _ => None,
    }
}
