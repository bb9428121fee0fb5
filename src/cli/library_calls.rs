//! Library calls that several commands share.

use rayon_core::ThreadPool;

use crate::animation::Rigged;
use crate::cli::options::draw_args::{GroupBy, HowArgs};
use crate::colour::srgb::Colour;
use crate::drawing::Drawing;
use crate::error::Error;
use crate::export::{Grouping, PngOptions, Resolution, SvgOptions};
use crate::mesh::Mesh;
use crate::pipeline::report::mesh_defects;
use crate::scene::{Scene, Warnings};
use crate::style::Style;

/// Loads a style by name or path, applies `sets` (`KEY=VALUE` each), and replaces the background if one is
/// given.
pub(crate) fn load_style(
    name_or_path: &str,
    sets: &[String],
    background: Option<Option<Colour>>,
) -> Result<Style, Error> {
    let mut style = Style::load_with(name_or_path, sets)?;
    if let Some(background) = background {
        style.background = background;
    }
    Ok(style)
}

/// Keeps parts whose names match `only` (all if empty) and none of `hide`.
pub(crate) fn keep_parts(scene: &mut Scene, only: &[String], hide: &[String]) -> Result<(), Error> {
    if only.is_empty() && hide.is_empty() {
        return Ok(());
    }
    let names = part_names(scene);
    scene.keep_parts(only, hide);
    check_left(scene, &names)
}

/// Keeps the same parts of a rigged model, with the nodes that move them.
pub(crate) fn keep_moving_parts(rigged: &mut Rigged, only: &[String], hide: &[String]) -> Result<(), Error> {
    if only.is_empty() && hide.is_empty() {
        return Ok(());
    }
    let names = part_names(&rigged.scene);
    rigged.keep_parts(only, hide);
    check_left(&rigged.scene, &names)
}

fn part_names(scene: &Scene) -> Vec<String> {
    scene.parts.iter().map(|part| part.name.clone()).collect()
}

/// Refuses a scene without parts. `names` are the parts before the selection.
fn check_left(scene: &Scene, names: &[String]) -> Result<(), Error> {
    if scene.parts.is_empty() {
        let mut shown: Vec<&str> = names.iter().map(String::as_str).take(8).collect();
        shown.dedup();
        return Err(Error::new("--only and --hide leave no part")
            .remedy(format!("the parts are {}", shown.join(", "))));
    }
    Ok(())
}

/// Builds the mesh of a scene, and returns the defects that cleaning found.
pub(crate) fn mesh_findings(scene: &Scene) -> (Warnings, Mesh) {
    let mesh = Mesh::build(scene.to_soup());
    (mesh_defects::of_mesh(&mesh, scene), mesh)
}

/// Encodes a drawing as SVG.
pub(crate) fn svg(drawing: &Drawing, how: &HowArgs) -> Vec<u8> {
    drawing.to_svg(&svg_options(how)).into_bytes()
}

/// Converts the SVG options of a request for the exporter.
pub(crate) fn svg_options(how: &HowArgs) -> SvgOptions {
    let group = match how.group {
        GroupBy::Layer => Grouping::Layer,
        GroupBy::Part => Grouping::Part,
    };
    let id_prefix = how.id_prefix.clone().unwrap_or_default();
    SvgOptions { precision: how.precision, id_prefix, group, ..SvgOptions::default() }
}

/// Encodes a drawing as PNG with a resolution in pixels per inch.
pub(crate) fn png(drawing: &Drawing, dpi: f64) -> Result<Vec<u8>, Error> {
    drawing.to_png(&PngOptions { resolution: Resolution::Dpi(dpi) })
}

/// Runs work on a number of threads; by default one per core.
pub(crate) fn in_threads<T: Send>(threads: Option<u16>, work: impl FnOnce() -> T + Send) -> Result<T, Error> {
    match threads {
        // Runs on a thread of the global pool, which avoids a hand-over at each parallel step.
        None => Ok(rayon_core::scope(|_| work())),
        Some(_) => Ok(pool(threads)?.install(work)),
    }
}

/// Thread pool with a number of threads; by default one per core.
pub(crate) fn pool(threads: Option<u16>) -> Result<ThreadPool, Error> {
    let pool = rayon_core::ThreadPoolBuilder::new().num_threads(threads.map_or(0, usize::from)).build();
    pool.map_err(|error| Error::new(format!("cannot start threads: {error}")).at("--threads"))
}
