//! `ligne styles --sheet`: one model in every built-in style, side by side, to choose from.

use std::path::Path;

use kurbo::{BezPath, Point, Rect, Shape, Vec2};

use super::output::{Format, Output, Staging, check_place};
use super::paper::Extent;
use super::viewpoint::{Sheet, View, Viewpoint, viewpoint};
use super::{draw, number, pipeline, print, say};
use crate::drawing::lettering::lettered;
use crate::drawing::{
    Cap, Drawing, Join, Layer, LayerKind, Mark, Page, Paint, Provenance, StrokePaint, Unit,
};
use crate::error::Error;
use crate::export::{DxfOptions, SvgOptions, gzip};
use crate::math::colour::Colour;
use crate::render::Prepared;
use crate::scene::Scene;
use crate::scene::framing::world_points;
use crate::style::Style;

/// Side of the picture in each style, px.
const SIDE: f64 = 320.0;

/// Room between pictures, and around the sheet.
const GAP: f64 = 20.0;

/// Room for the name under a picture, and how high its letters are.
const UNDER: f64 = 34.0;
const LETTER: f64 = 9.0;

/// How many pictures lie side by side.
const COLUMNS: usize = 6;

/// Draws the model in all styles, and says so.
pub(super) fn run(out: &Path, model: &Path) -> Result<(), Error> {
    let output = Output::new(out.to_path_buf())?;
    if output.format != Format::SvgToStdout {
        check_place(out)?;
    }
    let scene = Scene::open(model)?;
    let sheet = sheet(&scene)?;
    let bytes = match output.format {
        Format::SvgToStdout => return print(sheet.to_svg(&SvgOptions::default()).as_bytes()),
        Format::Svg => sheet.to_svg(&SvgOptions::default()).into_bytes(),
        Format::Svgz => gzip::packed(sheet.to_svg(&SvgOptions::default()).as_bytes()),
        Format::Dxf => sheet.to_dxf(&DxfOptions::default()),
        Format::Png => pipeline::png(&sheet, draw::default_dpi(Unit::Px))?,
        #[cfg(feature = "pdf")]
        Format::Pdf => sheet.to_pdf(),
    };
    let mut staging = Staging::default();
    staging.add(out, &bytes)?;
    staging.commit()?;
    let counted = number::counted(Style::names().count() as u64, "style");
    say(&format!("{}: {counted}, {}", output.name(), number::bytes(bytes.len() as u64)));
    Ok(())
}

/// The sheet: pictures in rows, names under them.
fn sheet(scene: &Scene) -> Result<Drawing, Error> {
    let styles: Vec<&str> = Style::names().collect();
    let (columns, rows) = (COLUMNS.min(styles.len()), styles.len().div_ceil(COLUMNS));
    let page = Page {
        width: columns as f64 * (SIDE + GAP) + GAP,
        height: rows as f64 * (SIDE + UNDER) + GAP,
        unit: Unit::Px,
        background: Some(Colour::WHITE),
    };
    let mut layers: Vec<Layer> = Vec::new();
    let mut names: Vec<Mark> = Vec::new();
    let mut title = String::new();
    for (place, name) in styles.into_iter().enumerate() {
        let (column, row) = ((place % COLUMNS) as f64, (place / COLUMNS) as f64);
        let corner = Vec2::new(GAP + column * (SIDE + GAP), GAP + row * (SIDE + UNDER));
        let style = Style::load(name, &[])?;
        let drawing = picture(scene, &style)?;
        title = drawing.title;
        layers.extend(style.background.filter(|colour| *colour != Colour::WHITE).map(|colour| {
            let path = Rect::new(0.0, 0.0, SIDE, SIDE).to_path(0.1);
            let mark = Mark { path, paint: Paint::Fill(colour), provenance: Provenance::default() };
            layer(LayerKind::Paper, name, vec![mark.moved(corner)], false)
        }));
        layers.extend(drawing.layers.into_iter().map(|own| {
            let marks = own.marks.into_iter().map(|mark| mark.moved(corner)).collect();
            layer(own.kind, name, marks, own.ordered)
        }));
        let under = Point::new(SIDE / 2.0, SIDE + UNDER / 2.0) + corner;
        names.push(written(lettered(name, LETTER, under), name));
    }
    layers.push(Layer { kind: LayerKind::Callouts, pen: None, ordered: false, marks: names });
    Ok(Drawing::new(title, page, layers))
}

/// The model in one style.
fn picture(scene: &Scene, style: &Style) -> Result<Drawing, Error> {
    let extent = Extent { width: SIDE, height: SIDE };
    let sheet = Sheet { extent: Some((extent, Unit::Px)), ..Sheet::default() };
    let view = View::Angles { azimuth_deg: None, elevation_deg: None, lens: None };
    let Viewpoint { camera, paper, .. } = viewpoint(&view, &sheet, scene, || Ok(world_points(scene).into()))?;
    let page = Page { background: style.background, ..paper.page() };
    Ok(Prepared::for_camera(scene, style, &camera).draw(&camera, page, None)?.0)
}

/// A layer that is known by the style it is of.
fn layer(kind: LayerKind, style: &str, marks: Vec<Mark>, ordered: bool) -> Layer {
    Layer { kind, pen: Some(style.to_owned()), ordered, marks }
}

/// A name in lines, which can be read as text too.
fn written(path: BezPath, name: &str) -> Mark {
    let paint = Paint::Stroke(StrokePaint {
        width: 1.4,
        colour: Colour::rgb(0x33, 0x33, 0x33),
        cap: Cap::Round,
        join: Join::Round,
        dash: Vec::new(),
        dash_offset: 0.0,
    });
    Mark { path, paint, provenance: Provenance { note: Some(name.into()), ..Provenance::default() } }
}
