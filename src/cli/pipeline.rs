//! The calls of the command line into the stages and the exporters.

use std::sync::Arc;

use kurbo::Affine;

use super::draw_args::GroupBy;
use super::request::SvgChoices;
use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::export::png::{PngOptions, Resolution};
use crate::export::svg::{Grouping, SvgOptions};
use crate::math::colour::Colour;
use crate::mesh::Mesh;
use crate::render::{Report, Stage, Stopwatch};
use crate::scene::{Camera, Scene, Warnings};
use crate::stroke::InkContext;
use crate::style::Style;
use crate::view::View;
use crate::{chain, lines, stroke, viewmap};

/// The style by that name or in that file, changed by `sets` (`KEY=VALUE` each) and with the
/// background that was asked for.
pub(super) fn load_style(
    name_or_path: &str,
    sets: &[String],
    background: Option<Option<Colour>>,
) -> Result<Style, Error> {
    let style = Style::load(name_or_path, sets)?;
    Ok(match background {
        Some(background) => Style { background, ..style },
        None => style,
    })
}

/// What cleaning the mesh of a scene finds wrong with it.
pub(super) fn mesh_warnings(scene: &Scene) -> Warnings {
    cleaning_warnings(&Mesh::build(scene.to_soup()))
}

fn cleaning_warnings(mesh: &Mesh) -> Warnings {
    let cleaning = mesh.cleaning;
    let mut warnings = Warnings::default();
    warnings.count("collapsed faces", cleaning.collapsed);
    warnings.count("doubled faces", cleaning.doubled);
    warnings.count("faces without area", cleaning.degenerate);
    warnings.count("non-manifold edges", cleaning.non_manifold);
    warnings
}

/// The drawing, or what one stage made of it. The frame of the camera lies in the middle of the
/// page.
pub(super) fn render(
    scene: &Scene,
    camera: &Camera,
    style: &Style,
    page: Page,
    _stage: Option<Stage>,
) -> (Drawing, Report) {
    let mut report = Report::default();
    let mut watch = Stopwatch::start();
    let mesh = Mesh::build(scene.to_soup());
    report.stages_ms.topology = watch.lap_ms();
    let view = View::new(&mesh, camera);
    let found = lines::extract(&mesh, &view, &style.lines);
    report.stages_ms.features = watch.lap_ms();
    let map = viewmap::build(&mesh, &view, &found, &style.lines);
    report.stages_ms.visibility = watch.lap_ms();
    let chains = chain::link(&map, &style.chain, page.unit);
    report.stages_ms.chains = watch.lap_ms();
    let parts: Vec<Arc<str>> = scene.parts.iter().map(|part| Arc::from(part.name.as_str())).collect();
    let materials: Vec<(Arc<str>, Colour)> =
        scene.materials.iter().map(|m| (Arc::from(m.name.as_str()), m.colour)).collect();
    let context =
        InkContext { unit: page.unit, parts: &parts, materials: &materials, hidden: style.lines.hidden };
    let mut layers = stroke::ink(&chains, &context, &style.stroke);
    let aside = Affine::translate(((page.width - camera.width) / 2.0, (page.height - camera.height) / 2.0));
    for mark in layers.iter_mut().flat_map(|layer| &mut layer.marks) {
        mark.path.apply_affine(aside);
    }
    report.stages_ms.strokes = watch.lap_ms();
    report.counts.vertices = mesh.positions.len() as u64;
    report.counts.edges = mesh.edges.len() as u64;
    report.counts.chains = chains.len() as u64;
    report.warnings = cleaning_warnings(&mesh).lines();
    (Drawing { title: String::new(), page, layers }, report)
}

/// The drawing as SVG.
pub(super) fn svg(drawing: &Drawing, choices: &SvgChoices) -> Vec<u8> {
    let options = SvgOptions {
        precision: choices.precision,
        id_prefix: choices.id_prefix.clone().unwrap_or_default(),
        group: match choices.group {
            GroupBy::Layer => Grouping::Layer,
            GroupBy::Part => Grouping::Part,
        },
    };
    drawing.to_svg(&options).into_bytes()
}

/// The drawing as PNG, at so many pixels to the inch.
pub(super) fn png(drawing: &Drawing, dpi: Option<f64>) -> Result<Vec<u8>, Error> {
    let resolution = dpi.map_or(Resolution::Natural, Resolution::Dpi);
    drawing.to_png(&PngOptions { resolution })
}
