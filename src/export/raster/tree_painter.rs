//! Painter for parsed SVG: paths of one colour by exact coverage, everything else by resvg.
//!
//! The rasteriser of resvg paints strokes up to one pixel as hairlines, so a slanted one is too thin by the
//! cosine of its slope. It samples wider strokes and fills four times per pixel, so a line of 1.1 px gets 1
//! or 1.25 px of ink.

use kurbo::BezPath;
use tiny_skia::{
    BlendMode, IntRect, Mask, MaskType, PathSegment, Pixmap, PixmapMut, PixmapPaint, Point, Rect, Transform,
};
use usvg::{Group, Node, Paint, PaintOrder};

use super::area_coverage::{Coverage, CoverageInk, Winding};

/// Longest line, in segments, that is outlined without clipping it to the window first.
const MAX_UNCUT_SEGMENTS: usize = 64;

/// A path of a tree in double precision.
pub(crate) fn bez_path(path: &tiny_skia::Path) -> BezPath {
    let at = |p: Point| (f64::from(p.x), f64::from(p.y));
    let mut all = BezPath::new();
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(p) => all.move_to(at(p)),
            PathSegment::LineTo(p) => all.line_to(at(p)),
            PathSegment::QuadTo(q, p) => all.quad_to(at(q), at(p)),
            PathSegment::CubicTo(q, r, p) => all.curve_to(at(q), at(r), at(p)),
            PathSegment::Close => all.close_path(),
        }
    }
    all
}

/// Paints a tree over the existing pixels; `to` transforms its units to pixels.
pub(crate) fn render(tree: &usvg::Tree, to: Transform, pixmap: &mut PixmapMut) {
    TreePainter::default().nodes(tree.root(), to, pixmap);
}

/// Override of how a path is painted.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(not(feature = "diff"), allow(dead_code))]
pub(crate) enum PaintOverride {
    /// As in the file.
    Own,
    /// Not at all.
    Absent,
    /// In black, with lines of 1 px, or both.
    Plain { black: bool, thin: bool },
}

/// Options for painting a tree.
#[derive(Clone, Copy, Default)]
pub(crate) struct TreePainter<'a> {
    /// If set, only nodes that touch this rectangle are painted; in tree units.
    pub window: Option<Rect>,
    /// Whether each pixel is covered completely or not at all.
    pub crisp: bool,
    /// Override for each path.
    pub override_of_path: Option<&'a dyn Fn(&usvg::Path) -> PaintOverride>,
    /// Whether opacities, masks and filters of groups are ignored.
    pub plain: bool,
    /// Whether lines are outlined with eight times the usual precision.
    pub precise: bool,
}

impl TreePainter<'_> {
    /// Paints all children of a group.
    pub(crate) fn nodes(self, parent: &Group, to: Transform, pixmap: &mut PixmapMut) {
        for node in parent.children().iter().filter(|node| self.touches(node)) {
            let painted = match node {
                Node::Group(group) => self.group(group, to.pre_concat(group.transform()), pixmap),
                Node::Path(path) => self.path(path, to, pixmap),
                _ => None,
            };
            if painted.is_none() {
                others(node, to, pixmap);
            }
        }
    }

    /// Whether a node touches the window.
    fn touches(self, node: &Node) -> bool {
        let Some(window) = self.window else { return true };
        let bounds = match node {
            Node::Group(group) => group.abs_layer_bounding_box().to_rect(),
            _ => node.abs_stroke_bounding_box(),
        };
        bounds.left() <= window.right()
            && bounds.right() >= window.left()
            && bounds.top() <= window.bottom()
            && bounds.bottom() >= window.top()
    }

    /// Paints a group; `None` if it has masks, filters or unusual blend modes.
    fn group(self, group: &Group, to: Transform, pixmap: &mut PixmapMut) -> Option<()> {
        let plain = self.plain;
        if !group.should_isolate() || plain && group.clip_path().is_none() {
            self.nodes(group, to, pixmap);
            return Some(());
        }
        let blended = group.blend_mode() != usvg::BlendMode::Normal;
        if !plain && (group.mask().is_some() || !group.filters().is_empty() || blended) {
            return None;
        }
        let canvas = IntRect::from_xywh(0, 0, pixmap.width(), pixmap.height())?;
        let Some(bounds) = group.layer_bounding_box().transform(to).and_then(|bounds| {
            let (left, top) = ((bounds.left() - 2.0).floor() as i32, (bounds.top() - 2.0).floor() as i32);
            let (right, bottom) =
                ((bounds.right() + 2.0).ceil() as i32, (bounds.bottom() + 2.0).ceil() as i32);
            IntRect::from_ltrb(left, top, right, bottom)?.intersect(&canvas)
        }) else {
            // The group is outside the canvas.
            return Some(());
        };
        let mut layer = Pixmap::new(bounds.width(), bounds.height())?;
        let to = to.post_translate(-bounds.x() as f32, -bounds.y() as f32);
        self.nodes(group, to, &mut layer.as_mut());
        if let Some(clip) = group.clip_path() {
            self.clip(clip, to, &mut layer)?;
        }
        let opacity = if plain { 1.0 } else { group.opacity().get() };
        let paint = PixmapPaint { opacity, ..PixmapPaint::default() };
        pixmap.draw_pixmap(bounds.x(), bounds.y(), layer.as_ref(), &paint, Transform::identity(), None);
        Some(())
    }

    /// Clips a layer to a clip path.
    fn clip(self, clip: &usvg::ClipPath, to: Transform, layer: &mut Pixmap) -> Option<()> {
        let mut inside = Pixmap::new(layer.width(), layer.height())?;
        self.clip_areas(clip.root(), to.pre_concat(clip.transform()), &mut inside)?;
        if let Some(outer) = clip.clip_path() {
            self.clip(outer, to, layer)?;
        }
        layer.apply_mask(&Mask::from_pixmap(inside.as_ref(), MaskType::Alpha));
        Some(())
    }

    /// Fills the areas of a clip path.
    fn clip_areas(self, parent: &Group, to: Transform, inside: &mut Pixmap) -> Option<()> {
        for node in parent.children() {
            match node {
                Node::Path(path) if path.is_visible() => {
                    let winding = path.fill().map_or(Winding::NonZero, |fill| winding(fill.rule()));
                    let mut coverage = Coverage::new(inside.width(), inside.height());
                    coverage.add(path.data(), to);
                    coverage.paint(self.ink([0; 3], 1.0), winding, &mut inside.as_mut());
                }
                Node::Group(group) => {
                    let to = to.pre_concat(group.transform());
                    match group.clip_path() {
                        None => self.clip_areas(group, to, inside)?,
                        Some(clip) => {
                            let mut own = Pixmap::new(inside.width(), inside.height())?;
                            self.clip_areas(group, to, &mut own)?;
                            self.clip(clip, to, &mut own)?;
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

    /// Paints a path; `None` if it has paints other than colours, or no anti-aliasing.
    fn path(self, path: &usvg::Path, to: Transform, pixmap: &mut PixmapMut) -> Option<()> {
        let look = self.override_of_path.map_or(PaintOverride::Own, |look| look(path));
        if !path.is_visible() || look == PaintOverride::Absent {
            return Some(());
        }
        if !self.crisp && !path.rendering_mode().use_shape_antialiasing() {
            return None;
        }
        let (black, thin) = match look {
            PaintOverride::Plain { black, thin } => (black, thin),
            _ => (false, false),
        };
        let ink = |paint: &Paint, opacity: usvg::Opacity| match paint {
            _ if black => Some(self.ink([0; 3], 1.0)),
            Paint::Color(colour) => {
                Some(self.ink([colour.red, colour.green, colour.blue], f64::from(opacity.get())))
            }
            _ => None,
        };
        let fill = match path.fill() {
            Some(fill) => Some((ink(fill.paint(), fill.opacity())?, winding(fill.rule()))),
            None => None,
        };
        let stroke = match path.stroke() {
            Some(stroke) => {
                let pen = match thin {
                    false => stroke.to_tiny_skia(),
                    true => {
                        let t = path.abs_transform();
                        let scale = (t.sx * t.sy - t.kx * t.ky).abs().sqrt().max(f32::MIN_POSITIVE);
                        // Round, so that a line in several pieces looks like one line.
                        let (line_cap, line_join) = (tiny_skia::LineCap::Round, tiny_skia::LineJoin::Round);
                        tiny_skia::Stroke {
                            width: 1.0 / scale,
                            line_cap,
                            line_join,
                            ..tiny_skia::Stroke::default()
                        }
                    }
                };
                Some((ink(stroke.paint(), stroke.opacity())?, pen))
            }
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
            let precision = if self.precise { 8.0 } else { 1.0 };
            let scale = tiny_skia::PathStroker::compute_resolution_scale(&to) * precision;
            let near = self.near(path, stroke);
            let dashed = stroke.dash.as_ref().map(|dash| path.data().dash(dash, scale));
            let line = match &dashed {
                Some(Some(dashed)) => dashed,
                Some(None) => return,
                None => match &near {
                    Some(Some(near)) => near,
                    Some(None) => return,
                    None => path.data(),
                },
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

    /// The segments of a long solid line that touch the window, if any; `None` if the whole line is to be
    /// used.
    fn near(self, path: &usvg::Path, stroke: &tiny_skia::Stroke) -> Option<Option<tiny_skia::Path>> {
        let window =
            self.window.filter(|_| path.data().len() > MAX_UNCUT_SEGMENTS && stroke.dash.is_none())?;
        let window = window.transform(path.abs_transform().invert()?)?;
        // The reach of a mitred corner or a cap.
        let reach = stroke.width * stroke.miter_limit.max(2.0);
        let window = window.outset(reach, reach)?;
        let mut near = tiny_skia::PathBuilder::new();
        let (mut start, mut last, mut drawn) = (Point::zero(), Point::zero(), false);
        for segment in path.data().segments() {
            let (points, end) = match segment {
                PathSegment::MoveTo(p) => {
                    (start, last, drawn) = (p, p, false);
                    continue;
                }
                PathSegment::LineTo(p) => ([last, last, last, p], p),
                PathSegment::QuadTo(q, p) => ([last, q, q, p], p),
                PathSegment::CubicTo(q, r, p) => ([last, q, r, p], p),
                PathSegment::Close => ([last, last, last, start], start),
            };
            let beyond = points.iter().all(|p| p.x < window.left())
                || points.iter().all(|p| p.x > window.right())
                || points.iter().all(|p| p.y < window.top())
                || points.iter().all(|p| p.y > window.bottom());
            if !beyond {
                if !drawn {
                    near.move_to(last.x, last.y);
                }
                match segment {
                    PathSegment::QuadTo(q, p) => near.quad_to(q.x, q.y, p.x, p.y),
                    PathSegment::CubicTo(q, r, p) => near.cubic_to(q.x, q.y, r.x, r.y, p.x, p.y),
                    _ => near.line_to(end.x, end.y),
                }
            }
            (last, drawn) = (end, !beyond);
        }
        Some(near.finish())
    }

    /// The ink of a colour.
    fn ink(self, rgb: [u8; 3], opacity: f64) -> CoverageInk {
        let ink = CoverageInk::new(rgb, opacity);
        if self.crisp { ink.crisp() } else { ink }
    }
}

/// Paints a node with resvg, which moves the node's bounding box to the origin.
fn others(node: &Node, to: Transform, pixmap: &mut PixmapMut) {
    if let Some(bounds) = node.abs_layer_bounding_box() {
        resvg::render_node(node, to.pre_translate(bounds.x(), bounds.y()), pixmap);
    }
}

fn winding(rule: usvg::FillRule) -> Winding {
    match rule {
        usvg::FillRule::NonZero => Winding::NonZero,
        usvg::FillRule::EvenOdd => Winding::EvenOdd,
    }
}
