//! SVG files to a [`Picture`], with transforms, units and styles resolved by usvg.

use std::panic::catch_unwind;
use std::sync::Arc;

use kurbo::{Affine, BezPath, Point};
use usvg::tiny_skia_path::PathSegment;

use super::paint_description;
use super::tagged_svg::{self, ShapeOrigin, TaggedSvg};
use super::unsupported_features::unread;
use crate::colour::srgb::Colour;
use crate::diff::markup::input_limits;
use crate::diff::shapes::ink::{self, ShapeInk, ShapePaint};
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};
use crate::diff::shapes::placeholder::Details;
use crate::diff::shapes::render_tree::RenderTree;
use crate::drawing::{Cap, Drawing, Join};
use crate::error::Error;
use crate::export::SvgOptions;

/// Largest coordinate accepted, in px.
const MAX_COORDINATE_PX: f64 = 1e8;
/// Stack size for the recursion over nested elements, independent of the calling thread.
const STACK_BYTES: usize = 64 << 20;

impl Picture {
    /// Reads an SVG file in any form that resvg reads. Texts are compared by their words and pictures by
    /// their bytes.
    ///
    /// # Errors
    /// If the text is not SVG, or if reading it might take more time or memory than its length justifies:
    /// deeply nested groups, references that multiply, or numbers above ten million px. The error has no file
    /// name.
    pub fn from_svg(svg: &str) -> Result<Self, Error> {
        picture(svg)
    }

    /// Converts a drawing to the picture that its file would give.
    ///
    /// # Errors
    /// If the drawing exceeds the limits of [`Picture::from_svg`].
    pub fn from_drawing(drawing: &Drawing, options: &SvgOptions) -> Result<Self, Error> {
        Self::from_svg(&drawing.to_svg(options))
    }
}

/// Reads a file on a thread with a large stack.
fn picture(svg: &str) -> Result<Picture, Error> {
    let pool = rayon_core::ThreadPoolBuilder::new().num_threads(1).stack_size(STACK_BYTES).build();
    let pool = pool.map_err(|error| Error::new(format!("cannot start a thread: {error}")))?;
    let gave_up = |_| Error::new("the SVG parser failed").remedy("save it as plain SVG");
    pool.install(|| catch_unwind(|| read(svg))).map_err(gave_up)?
}

/// Reads a file: limits, markup, usvg tree, shapes.
fn read(svg: &str) -> Result<Picture, Error> {
    let document = input_limits::parse(svg)?;
    let mut markup = tagged_svg::rewrite(&document)?;
    let unread: Arc<[&'static str]> = unread(&document, markup.has_unapplied_rules).into_iter().collect();
    drop(document);
    let stand_ins = markup.origins.iter().filter_map(|(id, origin)| {
        Some((id.clone(), origin.words.as_ref().map(|words| ink::is_text(words))?))
    });
    let stand_ins = stand_ins.collect();
    let drawn = RenderTree::new(std::mem::take(&mut markup.svg), stand_ins).map_err(|error| {
        Error::new(format!("is not a drawing: {error}")).remedy("give an SVG file with a width and a height")
    })?;
    let tree = drawn.smooth();
    let size = tree.size();
    let mut reader = ShapeReader { markup: &markup, shapes: Vec::new() };
    reader.group(tree.root(), &GroupContext::default());
    let far = |shape: &Shape| {
        let bounds = shape.path.control_box();
        let most = bounds.x0.abs().max(bounds.y0.abs()).max(bounds.x1.abs()).max(bounds.y1.abs());
        most > MAX_COORDINATE_PX || most.is_nan()
    };
    if let Some(shape) = reader.shapes.iter().find(|shape| far(shape)) {
        return Err(Error::new(format!(
            "a {} lies more than {MAX_COORDINATE_PX} px from the page",
            shape.label
        ))
        .remedy("remove it from the drawing"));
    }
    let scale = tree.root().children().first().map_or(1.0, |_| root_scale(svg_root(tree)));
    let shapes = Arc::from(reader.shapes);
    Ok(Picture {
        width: f64::from(size.width()),
        height: f64::from(size.height()),
        unit: markup.unit,
        step_px: scale * 0.1f64.powi(i32::from(markup.decimals)),
        has_arcs: markup.arcs,
        shapes,
        svg: Arc::from(svg),
        drawn: Arc::new(drawn),
        unread,
    })
}

/// Transform from user units to px: that of the group without an id that usvg adds.
fn svg_root(tree: &usvg::Tree) -> usvg::Transform {
    match tree.root().children() {
        [usvg::Node::Group(only)] if only.id().is_empty() => only.transform(),
        _ => usvg::Transform::identity(),
    }
}

fn root_scale(transform: usvg::Transform) -> f64 {
    affine(transform).determinant().abs().sqrt()
}

/// State inherited from groups.
#[derive(Clone, Default)]
struct GroupContext<'a> {
    opacity: f64,
    origin: Option<&'a ShapeOrigin>,
    /// Descriptions of the filters and blend modes applied to the shape.
    effects: Vec<Arc<str>>,
    clip: bool,
}

/// Collects shapes from the usvg tree.
struct ShapeReader<'a> {
    markup: &'a TaggedSvg,
    shapes: Vec<Shape>,
}

impl<'a> ShapeReader<'a> {
    fn origin(&self, id: &str) -> Option<&'a ShapeOrigin> {
        self.markup.origins.get(id)
    }

    /// Collects the shapes of a group, its clip paths and its masks.
    fn group(&mut self, group: &usvg::Group, around: &GroupContext<'a>) {
        let mut inherited = around.clone();
        // Opacity 0 from `Default` means that there is no group yet.
        let outer = if around.opacity == 0.0 { 1.0 } else { around.opacity };
        inherited.opacity = outer * f64::from(group.opacity().get());
        inherited.origin = self.origin(group.id()).or(around.origin);
        if !group.filters().is_empty() {
            inherited.effects.push(Arc::from(format!("{} filters", group.filters().len())));
        }
        if group.blend_mode() != usvg::BlendMode::Normal {
            inherited.effects.push(Arc::from(format!("{:?}", group.blend_mode()).to_lowercase()));
        }
        let mut clip = group.clip_path();
        while let Some(path) = clip {
            self.group(path.root(), &GroupContext { clip: true, ..inherited.clone() });
            clip = path.clip_path();
        }
        let mut mask = group.mask();
        while let Some(content) = mask {
            self.group(content.root(), &GroupContext { clip: true, ..inherited.clone() });
            mask = content.mask();
        }
        for child in group.children() {
            match child {
                usvg::Node::Group(inner) => self.group(inner, &inherited),
                usvg::Node::Path(path) if path.is_visible() => self.path(path, &inherited),
                usvg::Node::Path(_) | usvg::Node::Image(_) | usvg::Node::Text(_) => {}
            }
        }
    }

    /// Adds the shapes of a path: its fill and its stroke in painting order.
    fn path(&mut self, path: &usvg::Path, inherited: &GroupContext<'a>) {
        let plain = ShapeOrigin::default();
        let origin = self.origin(path.id()).or(inherited.origin).unwrap_or(&plain);
        let to_page = affine(path.abs_transform());
        let scale = to_page.determinant().abs().sqrt();
        let geometry = to_page * bez_path(path.data());
        let is_crisp = !path.rendering_mode().use_shape_antialiasing();
        let details = origin.words.as_ref().and_then(|_| details(origin, to_page));
        let kind = |kind| if inherited.clip { ShapeKind::Clip } else { kind };
        let fill = path.fill().and_then(|fill| {
            let paint = painted(fill.paint(), fill.opacity().get(), inherited, origin)?;
            let even_odd = fill.rule() == usvg::FillRule::EvenOdd;
            let axis = origin.axis.as_ref().and_then(|(axis, width)| {
                Some((BezPath::from_svg(axis).ok()?, *width)).filter(|(axis, _)| axis.elements().len() > 1)
            });
            Some(match axis {
                Some((axis, width)) => Shape {
                    path: to_page * axis,
                    outline: Some(geometry.clone()),
                    kind: kind(ShapeKind::Line),
                    even_odd,
                    ink: ShapeInk {
                        width: width * scale,
                        outlined: true,
                        cap: Cap::Round,
                        join: Join::Round,
                        invisibility: origin.invisibility,
                        ..ShapeInk::region(paint, None)
                    },
                    label: Arc::clone(&origin.label),
                    material: origin.material.clone(),
                },
                None => Shape {
                    path: geometry.clone(),
                    outline: None,
                    kind: kind(ShapeKind::Region),
                    even_odd,
                    ink: ShapeInk {
                        is_crisp,
                        details: details.clone(),
                        ..ShapeInk::region(paint, origin.tone)
                    },
                    label: Arc::clone(&origin.label),
                    material: origin.material.clone(),
                },
            })
        });
        let stroke = path.stroke().and_then(|stroke| {
            let paint = painted(stroke.paint(), stroke.opacity().get(), inherited, origin)?;
            let dash = stroke.dasharray().unwrap_or_default();
            Some(Shape {
                path: geometry.clone(),
                outline: None,
                kind: kind(ShapeKind::Line),
                even_odd: false,
                ink: ShapeInk {
                    width: f64::from(stroke.width().get()) * scale,
                    dash: dash.iter().map(|length| f64::from(*length) * scale).collect(),
                    cap: cap(stroke.linecap()),
                    join: join(stroke.linejoin()),
                    tone: origin.tone,
                    invisibility: origin.invisibility,
                    is_crisp,
                    ..ShapeInk::region(paint, None)
                },
                label: Arc::clone(&origin.label),
                material: origin.material.clone(),
            })
        });
        match path.paint_order() {
            usvg::PaintOrder::FillAndStroke => self.shapes.extend(fill.into_iter().chain(stroke)),
            usvg::PaintOrder::StrokeAndFill => self.shapes.extend(stroke.into_iter().chain(fill)),
        }
    }
}

/// Paint of a shape; `None` if it is invisible.
fn painted(
    paint: &usvg::Paint,
    opacity: f32,
    inherited: &GroupContext,
    origin: &ShapeOrigin,
) -> Option<ShapePaint> {
    let opacity = f64::from(opacity) * inherited.opacity;
    let alpha = (opacity * 255.0).round() as u8;
    if alpha == 0 && !inherited.clip {
        return None;
    }
    let paint = match (paint, &origin.words) {
        (_, Some(words)) if alpha == 255 => ShapePaint::Other(Arc::clone(words)),
        (_, Some(words)) => ShapePaint::Other(Arc::from(format!("{words} at {:.0} %", opacity * 100.0))),
        (usvg::Paint::Color(colour), None) => {
            ShapePaint::Colour(Colour { r: colour.red, g: colour.green, b: colour.blue, a: alpha })
        }
        (other, None) => ShapePaint::Other(Arc::from(paint_description::of(other, alpha))),
    };
    if inherited.effects.is_empty() {
        return Some(paint);
    }
    Some(ShapePaint::Other(Arc::from(format!("{paint} through {}", inherited.effects.join(", ")))))
}

/// Properties of a text or a picture, with its rotation. The rectangle alone looks the same when rotated by
/// 180°.
fn details(origin: &ShapeOrigin, to_page: Affine) -> Option<Arc<Details>> {
    let mut details = origin.details.clone();
    let [a, b, ..] = to_page.as_coeffs();
    let turn = crate::geometry::numbers::portable_math::atan2(b, a).to_degrees();
    if turn.abs() > 0.01 {
        details.insert("turned".to_owned(), format!("{}°", ink::trimmed((turn * 100.0).round() / 100.0)));
    }
    if to_page.determinant() < 0.0 {
        details.insert("mirrored".to_owned(), "yes".to_owned());
    }
    (!details.is_empty()).then(|| Arc::new(details))
}

fn affine(t: usvg::Transform) -> Affine {
    Affine::new([t.sx, t.ky, t.kx, t.sy, t.tx, t.ty].map(f64::from))
}

fn bez_path(path: &usvg::tiny_skia_path::Path) -> BezPath {
    let at = |p: usvg::tiny_skia_path::Point| Point::new(f64::from(p.x), f64::from(p.y));
    let mut out = BezPath::new();
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(p) => out.move_to(at(p)),
            PathSegment::LineTo(p) => out.line_to(at(p)),
            PathSegment::QuadTo(c, p) => out.quad_to(at(c), at(p)),
            PathSegment::CubicTo(c1, c2, p) => out.curve_to(at(c1), at(c2), at(p)),
            PathSegment::Close => out.close_path(),
        }
    }
    out
}

fn cap(cap: usvg::LineCap) -> Cap {
    match cap {
        usvg::LineCap::Butt => Cap::Butt,
        usvg::LineCap::Round => Cap::Round,
        usvg::LineCap::Square => Cap::Square,
    }
}

fn join(join: usvg::LineJoin) -> Join {
    match join {
        usvg::LineJoin::Miter | usvg::LineJoin::MiterClip => Join::Miter,
        usvg::LineJoin::Round => Join::Round,
        usvg::LineJoin::Bevel => Join::Bevel,
    }
}
