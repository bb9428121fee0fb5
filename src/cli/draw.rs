//! `ligne draw`: one drawing of one model, in one or several formats.

use super::output::{Format, Staging, check_place};
use super::progress::Progress;
use super::request::DrawRequest;
use super::viewpoint::{Viewpoint, viewpoint};
use super::{number, pipeline, print, say};
use crate::drawing::{Drawing, Page};
use crate::error::Error;
use crate::render::{Report, Stopwatch};
use crate::scene::Scene;

/// Parts that an error names.
const NAMED_PARTS: usize = 12;

/// A drawing in all its formats, not yet written.
struct Drawn {
    drawing: Drawing,
    report: Report,
    /// One an output, in their order.
    encoded: Vec<Vec<u8>>,
}

/// Draws, and says so in one line an output.
pub(super) fn run(request: &DrawRequest) -> Result<(), Error> {
    let mut watch = Stopwatch::start();
    for output in request.outputs.iter().filter(|output| output.format != Format::SvgToStdout) {
        check_place(&output.path)?;
    }
    if let Some(report) = &request.report {
        check_place(report)?;
    }
    let mut drawn = match request.threads {
        None => draw(request, &mut watch)?,
        Some(n) => rayon::ThreadPoolBuilder::new()
            .num_threads(usize::from(n))
            .build()
            .map_err(|error| Error::new(format!("cannot start {n} threads: {error}")).at("--threads"))?
            .install(|| draw(request, &mut watch))?,
    };
    tell_warnings(request, &drawn.report)?;
    write(request, &mut drawn, &mut watch)?;
    if !request.quiet {
        for (output, bytes) in request.outputs.iter().zip(&drawn.encoded) {
            say(&format!("{}: {}", output.name(), summary(&drawn, bytes.len(), watch.seconds())));
        }
    }
    Ok(())
}

/// Everything up to the bytes of each output.
fn draw(request: &DrawRequest, watch: &mut Stopwatch) -> Result<Drawn, Error> {
    let style = pipeline::load_style(&request.style, &request.sets, request.background)?;
    let progress = Progress::start(request.quiet, &request.model);
    progress.step("reading");
    let mut scene = Scene::open(&request.model)?;
    keep_parts(&mut scene, request)?;
    if let Some(up) = request.up {
        scene.up = up;
    }
    let load_ms = watch.lap_ms();

    progress.step("drawing");
    let Viewpoint { camera, paper, warning } = viewpoint(request, &scene)?;
    let page = Page { background: style.background, ..paper.page() };
    let (drawing, mut report) = pipeline::render(&scene, &camera, &style, page, request.stage);
    report.stages_ms.load = load_ms;
    report.counts.triangles = scene.triangle_count() as u64;
    report.counts.paths = paths(&drawing);
    for warning in scene.warnings.lines().into_iter().chain(warning) {
        if !report.warnings.contains(&warning) {
            report.warnings.push(warning);
        }
    }
    if report.counts.paths == 0 && report.warnings.is_empty() {
        report.warnings.push("the drawing is empty: no line of the model is in sight".to_owned());
    }

    progress.step("writing");
    watch.lap_ms();
    let encode = |format| match format {
        Format::Svg | Format::SvgToStdout => Ok(pipeline::svg(&drawing, &request.svg)),
        Format::Png => pipeline::png(&drawing, request.dpi),
    };
    let encoded = request.outputs.iter().map(|output| {
        encode(output.format).map_err(|error| match error.file {
            None => error.in_file(&output.path),
            Some(_) => error,
        })
    });
    let encoded = encoded.collect::<Result<Vec<_>, _>>()?;
    Ok(Drawn { drawing, report, encoded })
}

/// Leaves the parts that were asked for.
fn keep_parts(scene: &mut Scene, request: &DrawRequest) -> Result<(), Error> {
    let names: Vec<String> = scene.parts.iter().map(|part| part.name.clone()).take(NAMED_PARTS).collect();
    let before = scene.parts.len();
    scene.keep_parts(&request.only, &request.hide);
    if scene.parts.is_empty() && before > 0 {
        let more = if before > names.len() { ", ..." } else { "" };
        return Err(Error::new("--only and --hide leave no part to draw")
            .in_file(&request.model)
            .remedy(format!("the parts are {}{more}", names.join(", "))));
    }
    Ok(())
}

/// Names the warnings; under `--strict` they are errors.
fn tell_warnings(request: &DrawRequest, report: &Report) -> Result<(), Error> {
    let model = request.model.display();
    if request.strict && !report.warnings.is_empty() {
        return Err(Error::new(report.warnings.join("; "))
            .in_file(&request.model)
            .remedy("mend the model, or draw without --strict"));
    }
    if !request.quiet {
        for warning in &report.warnings {
            say(&format!("warning: {model}: {warning}"));
        }
    }
    Ok(())
}

/// Writes all outputs and the report, all or none.
fn write(request: &DrawRequest, drawn: &mut Drawn, watch: &mut Stopwatch) -> Result<(), Error> {
    let mut staging = Staging::default();
    for (output, bytes) in request.outputs.iter().zip(&drawn.encoded) {
        if output.format == Format::SvgToStdout {
            continue;
        }
        staging.add(&output.path, bytes)?;
    }
    drawn.report.counts.bytes_out = drawn.encoded.iter().map(|bytes| bytes.len() as u64).sum();
    drawn.report.stages_ms.write = watch.lap_ms();
    if let Some(path) = &request.report {
        staging.add(path, drawn.report.to_json().as_bytes())?;
    }
    for (output, bytes) in request.outputs.iter().zip(&drawn.encoded) {
        if output.format == Format::SvgToStdout {
            print(bytes)?;
        }
    }
    staging.commit()
}

fn paths(drawing: &Drawing) -> u64 {
    drawing.layers.iter().map(|layer| layer.marks.len() as u64).sum()
}

/// `1000 x 1000 px, 74 paths, 18.2 kB, 0.03 s, 69,451 triangles`
fn summary(drawn: &Drawn, bytes: usize, seconds: f64) -> String {
    let Page { width, height, unit, .. } = drawn.drawing.page;
    let counts = &drawn.report.counts;
    format!(
        "{} x {} {}, {}, {}, {seconds:.2} s, {}",
        number::plain(width, 2),
        number::plain(height, 2),
        unit.name(),
        number::counted(counts.paths, "path"),
        number::bytes(bytes as u64),
        number::counted(counts.triangles, "triangle"),
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::Unit;
    use crate::render::report::Counts;

    #[test]
    fn the_summary_is_one_line() {
        let page = Page { width: 210.0, height: 297.0, unit: Unit::Mm, background: None };
        let counts = Counts { paths: 74, triangles: 69_451, ..Counts::default() };
        let drawn = Drawn {
            drawing: Drawing { title: String::new(), page, layers: Vec::new() },
            report: Report { counts, ..Report::default() },
            encoded: Vec::new(),
        };
        assert_eq!(
            summary(&drawn, 18_249, 0.031),
            "210 x 297 mm, 74 paths, 18.2 kB, 0.03 s, 69,451 triangles"
        );
    }
}
