//! SVG files to a [`Picture`], with transforms, units and styles resolved by usvg.

use std::sync::Arc;

use kurbo::{Affine, BezPath};

use super::paint_description;
use super::tagged_svg::{self, ShapeOrigin, TaggedSvg};
use super::unsupported_features::unread;
use crate::colour::srgb::Colour;
use crate::diff::comparison::on_large_stack;
use crate::diff::markup::input_limits;
use crate::diff::shapes::ink::{self, ShapeInk, ShapePaint};
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};
use crate::diff::shapes::placeholder::Details;
use crate::diff::shapes::render_tree::RenderTree;
use crate::drawing::{Cap, Drawing, Join};
use crate::error::Error;
use crate::export::SvgOptions;
use crate::export::raster::tree_painter::bez_path;

/// Largest coordinate accepted, in px.
const MAX_COORDINATE_PX: f64 = 1e8;

impl Picture {
    /// Reads an SVG file in any form that resvg reads. Texts are compared by their words and pictures by
    /// their bytes.
    ///
    /// # Errors
    /// If the text is not SVG, or if reading it might take more time or memory than its length justifies:
    /// deeply nested groups, references that multiply, or numbers above ten million px. The error has no file
    /// name.
    pub fn from_svg(svg: &str) -> Result<Self, Error> {
        let gave_up = || Error::new("the SVG parser failed").remedy("save it as plain SVG");
        on_large_stack(1, || read(svg)).unwrap_or_else(|| Err(gave_up()))
    }

    /// Converts a drawing to the picture that its file would give.
    ///
    /// # Errors
    /// If the drawing exceeds the limits of [`Picture::from_svg`].
    pub fn from_drawing(drawing: &Drawing, options: &SvgOptions) -> Result<Self, Error> {
        Self::from_svg(&drawing.to_svg(options))
    }
}

/// Reads a file: limits, markup, usvg tree, shapes.
fn read(svg: &str) -> Result<Picture, Error> {
    let document = input_limits::parse(svg)?;
    let mut markup = tagged_svg::rewrite(&document, true)?;
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
    // usvg adds a group without an id for the transform from user units to px.
    let scale = match tree.root().children() {
        [usvg::Node::Group(only)] if only.id().is_empty() => scale(affine(only.transform())),
        _ => 1.0,
    };
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

fn scale(transform: Affine) -> f64 {
    transform.determinant().abs().sqrt()
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
        let clips = std::iter::successors(group.clip_path(), |clip| clip.clip_path()).map(|clip| clip.root());
        let masks = std::iter::successors(group.mask(), |mask| mask.mask()).map(|mask| mask.root());
        for content in clips.chain(masks) {
            self.group(content, &GroupContext { clip: true, ..inherited.clone() });
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
        let scale = scale(to_page);
        let geometry = to_page * bez_path(path.data());
        let is_crisp = !path.rendering_mode().use_shape_antialiasing();
        let details = origin.words.as_ref().and_then(|_| details(origin, to_page));
        let shape = |kind: ShapeKind, ink: ShapeInk| Shape {
            path: geometry.clone(),
            outline: None,
            kind: if inherited.clip { ShapeKind::Clip } else { kind },
            even_odd: false,
            ink,
            label: Arc::clone(&origin.label),
            material: origin.material.clone(),
        };
        let fill = path.fill().and_then(|fill| {
            let paint = painted(fill.paint(), fill.opacity().get(), inherited, origin)?;
            let even_odd = fill.rule() == usvg::FillRule::EvenOdd;
            let axis = origin.axis.as_ref().and_then(|(axis, width)| {
                Some((BezPath::from_svg(axis).ok()?, *width)).filter(|(axis, _)| axis.elements().len() > 1)
            });
            Some(match axis {
                Some((axis, width)) => {
                    let ink = ShapeInk {
                        width: width * scale,
                        outlined: true,
                        cap: Cap::Round,
                        join: Join::Round,
                        invisibility: origin.invisibility,
                        ..ShapeInk::region(paint, None)
                    };
                    let outline = Some(geometry.clone());
                    Shape { path: to_page * axis, outline, even_odd, ..shape(ShapeKind::Line, ink) }
                }
                None => {
                    let details = details.clone();
                    let ink = ShapeInk { is_crisp, details, ..ShapeInk::region(paint, origin.tone) };
                    Shape { even_odd, ..shape(ShapeKind::Region, ink) }
                }
            })
        });
        let stroke = path.stroke().and_then(|stroke| {
            let paint = painted(stroke.paint(), stroke.opacity().get(), inherited, origin)?;
            let dash = stroke.dasharray().unwrap_or_default();
            let ink = ShapeInk {
                width: f64::from(stroke.width().get()) * scale,
                dash: dash.iter().map(|length| f64::from(*length) * scale).collect(),
                cap: cap(stroke.linecap()),
                join: join(stroke.linejoin()),
                invisibility: origin.invisibility,
                is_crisp,
                ..ShapeInk::region(paint, origin.tone)
            };
            Some(shape(ShapeKind::Line, ink))
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
