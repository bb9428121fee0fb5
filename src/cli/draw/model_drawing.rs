//! `ligne draw`: draws one model from one or several views, in one or several formats.

use std::borrow::Cow;

use super::web_output;
use crate::animation::Rigged;
use crate::cli::models::opened_model::{OpenedModel, cut_and_explode, open};
use crate::cli::options::dxf_args;
#[cfg(feature = "pdf")]
use crate::cli::options::print_args;
use crate::cli::output::number_text;
use crate::cli::output::output_files::{Format, Output, Staging, check_place, is_stdout};
use crate::cli::output::progress::Progress;
use crate::cli::request::draw_request::DrawRequest;
use crate::cli::request::viewpoint::{ViewRequest, Viewpoint, viewpoint};
use crate::cli::request::{model_hints, usage_warnings};
use crate::cli::{library_calls, print, say};
use crate::drawing::{Drawing, Page, Unit};
use crate::error::Error;
use crate::export::encoding::gzip;
use crate::pipeline::{MapFiles, Renderer, Report, Stopwatch};
use crate::scene::Scene;
use crate::scene::cameras::framing::world_points;
use crate::scene::warnings::add_new;
use crate::style::Style;

/// Default resolution of PNG, pixels per inch: one pixel per px, and print resolution on a page in mm.
const SCREEN_DPI: f64 = 96.0;
const PRINT_DPI: f64 = 300.0;

/// Drawing encoded in all its formats, not yet written.
pub(crate) struct EncodedDrawing {
    drawing: Drawing,
    /// The camera and sheet of the drawing.
    view_request: ViewRequest,
    pub(crate) report: Report,
    /// Hints and choices made for the user. They are not warnings, so `--strict` accepts them.
    pub(crate) notes: Vec<String>,
    /// Encoded bytes, one entry per output.
    pub(crate) encoded: Vec<Vec<u8>>,
    maps: Option<MapFiles>,
}

impl EncodedDrawing {
    /// The drawing without its report and encoded bytes.
    pub(crate) fn into_drawing(self) -> Drawing {
        self.drawing
    }
}

/// Draws a request and prints one line per output.
pub(crate) fn run(request: &DrawRequest) -> Result<(), Error> {
    let mut watch = Stopwatch::start();
    for output in request.outputs.iter().filter(|output| output.format != Format::SvgToStdout) {
        check_place(&output.path)?;
    }
    if let Some(report) = request.report.as_ref().filter(|path| !is_stdout(path)) {
        check_place(report)?;
    }
    if let Some(record) = &request.save_camera {
        check_place(record)?;
    }
    if let Some(folder) = request.maps.as_ref().filter(|folder| !folder.is_dir()) {
        check_place(folder)?;
        if folder.exists() {
            return Err(Error::new("this is not a folder")
                .in_file(folder)
                .remedy("name a folder for the maps"));
        }
    }
    let mut drawn = library_calls::in_threads(request.how.threads, || draw(request, &mut watch))??;
    drawn.report.warnings.extend(usage_warnings::bare_lengths(request));
    refuse_warnings(request, &drawn.report)?;
    if !request.how.quiet {
        for warning in &drawn.report.warnings {
            say(&format!("warning: {}: {warning}", request.model.display()));
        }
        for note in &drawn.notes {
            say(&format!("note: {}: {note}", request.model.display()));
        }
    }
    write(request, &mut drawn, &mut watch)?;
    if !request.how.quiet {
        for (output, bytes) in request.outputs.iter().zip(&drawn.encoded) {
            say(&format!("{}: {}", output.name(), summary(&drawn, bytes, watch.seconds())));
        }
    }
    // The process ends here. Freeing a large drawing would only take time.
    std::mem::forget(drawn);
    Ok(())
}

/// Draws one view and encodes its outputs.
fn draw(request: &DrawRequest, watch: &mut Stopwatch) -> Result<EncodedDrawing, Error> {
    let progress = Progress::start(request.how.quiet, &request.model);
    let mut drawn = None;
    draw_model(None, &[request], watch, &progress, |_, view| {
        drawn = Some(view);
        Ok(())
    })?;
    drawn.ok_or_else(|| Error::new("no view was given"))
}

/// Draws several views of one model, which is read only if `model` is none, and once. Options except views and
/// outputs come from the first request. Each view is passed to `take` before the next is drawn.
pub(crate) fn draw_model(
    model: Option<Rigged>,
    requests: &[&DrawRequest],
    watch: &mut Stopwatch,
    progress: &Progress,
    mut take: impl FnMut(&DrawRequest, EncodedDrawing) -> Result<(), Error>,
) -> Result<(), Error> {
    let Some(request) = requests.first() else { return Ok(()) };
    let mut style = library_calls::load_style(&request.how.style, &request.sets, request.background)?;
    if request.is_to_scale() {
        style = style.to_scale();
    }
    progress.step("reading");
    let OpenedModel { mut scene, mut framed, mut warnings, mut notes } = open(request, model, &style)?;
    notes.extend(model_hints::of_drawing(request, &scene));
    if let Some(up) = request.how.up {
        scene.up = up;
    }
    let load_ms = watch.lap_ms();
    progress.step("drawing");
    if !request.outputs.is_empty() {
        warnings.extend(usage_warnings::unused_options(request, std::env::args_os()));
    }
    cut_and_explode(requests, &mut scene, &mut framed, &mut style)?;
    let points = || Ok(framed.as_deref().map_or_else(|| Cow::Owned(world_points(&scene)), Cow::Borrowed));
    let eyes = requests.iter().map(|request| viewpoint(&request.view, &request.sheet, &scene, points));
    let eyes = eyes.collect::<Result<Vec<_>, _>>()?;
    let all_warnings = scene.warnings.lines().into_iter().chain(warnings).collect();
    let hidden = usage_warnings::remaining_parts(request, &scene);
    let mut of_scene =
        SceneReport { triangles: triangles(&scene), warnings: all_warnings, hidden, notes, scene: None };
    let mut retained_scene = None;
    let enclosed: Vec<_> =
        eyes.iter().map(|eye| usage_warnings::camera_inside_part(&scene, &eye.camera)).collect();
    watch.lap_ms();
    // The scene is kept if hotspots or several views need it.
    let prepared = match eyes.as_slice() {
        [eye] if !request.web.hotspots => {
            Renderer::for_camera(Cow::Owned(scene), &style, &eye.camera, eye.paper.page().unit)
        }
        eyes => {
            let scene = &*of_scene.scene.insert(retained_scene.insert(scene));
            match eyes {
                [eye] => {
                    Renderer::for_camera(Cow::Borrowed(scene), &style, &eye.camera, eye.paper.page().unit)
                }
                _ => Renderer::new(scene, &style),
            }
        }
    };
    let preparing_ms = watch.lap_ms();
    for ((request, eye), enclosed) in requests.iter().zip(eyes).zip(enclosed) {
        let page = Page { background: style.background, ..eye.paper.page() };
        let of_view = (eye, page, enclosed);
        let mut encoded_drawing =
            draw_view(request, of_view, &of_scene, (&style, &prepared), watch, progress)?;
        encoded_drawing.report.stages_ms.load = load_ms;
        encoded_drawing.report.stages_ms.topology += preparing_ms;
        take(request, encoded_drawing)?;
    }
    Ok(())
}

/// Data of the scene that all its views share.
struct SceneReport<'a> {
    triangles: u64,
    /// Warnings of the scene and of the options.
    warnings: Vec<String>,
    /// Warning that lists the visible parts, for drawings that turn out empty under `--only` or `--hide`.
    hidden: Option<String>,
    /// Hints and choices made for the user.
    notes: Vec<String>,
    /// The scene, if views still need it.
    scene: Option<&'a Scene>,
}

fn draw_view(
    request: &DrawRequest,
    (Viewpoint { camera, paper, warning }, page, enclosed): (Viewpoint, Page, Option<String>),
    of_scene: &SceneReport,
    (style, prepared): (&Style, &Renderer),
    watch: &mut Stopwatch,
    progress: &Progress,
) -> Result<EncodedDrawing, Error> {
    watch.lap_ms();
    let (mut drawing, mut report) = prepared.draw_stage(&camera, page, request.stage)?;
    let bare = web_output::complete(request, &mut drawing, of_scene.scene, &camera, style)?;
    let maps = request.maps.is_some().then(|| prepared.maps(&camera, page.unit)).transpose()?;
    report.counts.triangles = of_scene.triangles;
    report.counts.paths = paths(&drawing);
    let told = of_scene.warnings.iter().cloned();
    let hidden = of_scene.hidden.clone().filter(|_| report.counts.paths == 0);
    let all = told.chain(hidden).chain(warning).chain(bare.map(str::to_owned)).chain(enclosed);
    add_new(&mut report.warnings, all);
    if report.warnings.is_empty() {
        report.warnings.extend(usage_warnings::tiny_drawing(&drawing));
    }

    progress.step("writing");
    watch.lap_ms();
    let svg = web_output::svg_options(request, style)?;
    let mut left_out = None;
    let mut encode = |format| match format {
        Format::Svg | Format::SvgToStdout => Ok(drawing.to_svg(&svg).into_bytes()),
        Format::Svgz => Ok(gzip::packed(drawing.to_svg(&svg).as_bytes())),
        Format::Png => library_calls::png(&drawing, request.how.dpi.unwrap_or(default_dpi(page.unit))),
        #[cfg(feature = "pdf")]
        Format::Pdf => print_args::encode(&drawing, request.print.as_ref()),
        Format::Dxf => {
            let (bytes, told) = dxf_args::encode(&drawing, &camera, &request.dxf)?;
            left_out = told;
            Ok(bytes)
        }
    };
    let mut encode_output =
        |output: &Output| encode(output.format).map_err(|error| error.or_in_file(&output.path));
    let encoded = request.outputs.iter().map(&mut encode_output);
    let encoded = encoded.collect::<Result<Vec<_>, _>>()?;
    report.warnings.extend(left_out);
    let notes = of_scene.notes.clone();
    Ok(EncodedDrawing {
        drawing,
        view_request: ViewRequest::Fixed(camera, paper),
        report,
        notes,
        encoded,
        maps,
    })
}

pub(crate) fn default_dpi(unit: Unit) -> f64 {
    match unit {
        Unit::Px => SCREEN_DPI,
        Unit::Mm => PRINT_DPI,
    }
}

/// Turns warnings into an error under `--strict`.
pub(crate) fn refuse_warnings(request: &DrawRequest, report: &Report) -> Result<(), Error> {
    if !request.how.strict || report.warnings.is_empty() {
        return Ok(());
    }
    Err(Error::new(report.warnings.join("; "))
        .in_file(&request.model)
        .remedy("repair the model, or draw without --strict"))
}

/// Encodes the first output of a request without writing it.
pub(crate) fn encode_first_output(request: &DrawRequest) -> Result<Vec<u8>, Error> {
    Ok(encode_with_view(request)?.0)
}

/// Encodes the first output of a request, and returns its view so that another model can be drawn the same
/// way.
pub(crate) fn encode_with_view(request: &DrawRequest) -> Result<(Vec<u8>, ViewRequest), Error> {
    let drawn = draw(request, &mut Stopwatch::start())?;
    refuse_warnings(request, &drawn.report)?;
    Ok((drawn.encoded.into_iter().next().unwrap_or_default(), drawn.view_request))
}

/// Writes all outputs and the report, all or none.
fn write(request: &DrawRequest, drawn: &mut EncodedDrawing, watch: &mut Stopwatch) -> Result<(), Error> {
    let mut staging = Staging::default();
    for (output, bytes) in request.outputs.iter().zip(&drawn.encoded) {
        if output.format == Format::SvgToStdout {
            continue;
        }
        staging.add(&output.path, bytes)?;
    }
    drawn.report.counts.bytes_out = drawn.encoded.iter().map(|bytes| bytes.len() as u64).sum();
    drawn.report.stages_ms.write = watch.lap_ms();
    if let (Some(folder), Some(maps)) = (&request.maps, &drawn.maps) {
        staging.make_folder(folder)?;
        for (name, bytes) in maps.named() {
            staging.add(&folder.join(name), bytes)?;
        }
    }
    let mut printed = None;
    if let Some(path) = &request.report {
        let json = drawn.report.to_json();
        if is_stdout(path) { printed = Some(json) } else { staging.add(path, json.as_bytes())? }
    }
    if let (Some(path), ViewRequest::Fixed(camera, _)) = (&request.save_camera, &drawn.view_request) {
        staging.add(path, camera.to_json().as_bytes())?;
    }
    for (output, bytes) in request.outputs.iter().zip(&drawn.encoded) {
        if output.format == Format::SvgToStdout {
            print(bytes)?;
        }
    }
    if let Some(json) = printed {
        print(json.as_bytes())?;
    }
    staging.commit()
}

/// Number of triangles in the scene, with each instance counted.
pub(crate) fn triangles(scene: &Scene) -> u64 {
    let geometries = scene.parts.iter().filter_map(|part| scene.geometries.get(part.geometry));
    geometries.map(|geometry| geometry.triangles.len() as u64).sum()
}

pub(crate) fn paths(drawing: &Drawing) -> u64 {
    drawing.layers.iter().map(|layer| layer.marks.len() as u64).sum()
}

/// Width and height of a PNG file, from its header.
fn pixels(png: &[u8]) -> Option<[u32; 2]> {
    let png = png.strip_prefix(b"\x89PNG")?;
    let side = |from: usize| Some(u32::from_be_bytes(png.get(from..from + 4)?.try_into().ok()?));
    Some([side(12)?, side(16)?])
}

/// Summary line: `1000 x 1000 px, 74 paths, 18.2 kB, 0.03 s, 69,451 triangles`. The pixel size of a PNG is
/// added if it differs from the page size.
pub(crate) fn summary(drawn: &EncodedDrawing, bytes: &[u8], seconds: f64) -> String {
    let Page { width, height, unit, .. } = drawn.drawing.page;
    let counts = &drawn.report.counts;
    let of_page = |side: u32, length: f64| unit == Unit::Px && f64::from(side) == length;
    let pixels = match pixels(bytes) {
        Some([w, h]) if !(of_page(w, width) && of_page(h, height)) => format!(" as {w} x {h} pixels"),
        _ => String::new(),
    };
    format!(
        "{} x {} {}{pixels}, {}, {}, {seconds:.2} s, {}",
        number_text::plain(width, 2),
        number_text::plain(height, 2),
        unit.name(),
        number_text::counted(counts.paths, "path"),
        number_text::bytes(bytes.len() as u64),
        number_text::counted(counts.triangles, "triangle"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pipeline::report::drawing_report::Counts;

    #[test]
    fn drawing_summary_is_one_line() {
        let page = Page { width: 210.0, height: 297.0, unit: Unit::Mm, background: None };
        let counts = Counts { paths: 74, triangles: 69_451, ..Counts::default() };
        let drawn = EncodedDrawing {
            drawing: Drawing::new("", page, Vec::new()),
            view_request: ViewRequest::Angles { azimuth_deg: None, elevation_deg: None, lens: None },
            report: Report { counts, ..Report::default() },
            notes: Vec::new(),
            encoded: Vec::new(),
            maps: None,
        };
        assert_eq!(
            summary(&drawn, &[0; 18_249], 0.031),
            "210 x 297 mm, 74 paths, 18.2 kB, 0.03 s, 69,451 triangles"
        );
        let png = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x09\xb0\0\0\x0d\xb4";
        assert!(summary(&drawn, png, 0.0).starts_with("210 x 297 mm as 2480 x 3508 pixels, "));
    }
}
