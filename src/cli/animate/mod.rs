//! `ligne animate`: draws an animation or a turntable as numbered frames, one film, or a contact sheet.
//!
//! 1. [`frame_plan`] decides the pose and the camera of each frame.
//! 2. [`face_limit`] sets the number of faces: all, a maximum, a time budget, or a list from a file.
//! 3. [`frame_renderer`] draws frames in parallel and passes them on in order. [`frame_fading`] keeps
//!    neighbouring drawings for strokes that fade in and out.
//! 4. Frames go to the [`destination`]: numbered files, a film ([`film_writer`], [`ffmpeg_video`]), or a
//!    sheet ([`moment_grid`]).
//! 5. [`animation_totals`] sums times, counts and warnings for the summary and the report.
//!
//! [`animate_args`] defines the options.

mod animate_args;
mod animation_totals;
mod destination;
mod face_limit;
mod ffmpeg_video;
mod film_writer;
mod frame_fading;
mod frame_plan;
mod frame_renderer;
mod moment_grid;

use std::path::Path;

use crate::cli::output::output_files::{Format, Output};
pub(crate) use animate_args::AnimateArgs;
use animation_totals::{AnimationTotals, refuse_warnings};
use destination::Destination;
use face_limit::FaceLimit;
use frame_plan::FramePlan;
use frame_renderer::FrameRenderer;

use super::models::lod;
use super::models::opened_model::cut_and_explode;
use super::output::number_text;
use super::request::usage_warnings;
use super::step::open_rigged;
use super::tolerances;
use super::{json_files, library_calls, print, say};
use crate::animation::Rigged;
use crate::cli::draw::contact_sheet::{check_outputs, picture_request};
use crate::cli::options::framing_args::FramedParts;
use crate::cli::output::output_files::{check_place, is_stdout, write_file};
use crate::cli::output::progress::Progress;
use crate::cli::request::draw_request::{DrawRequest, check_apart, refuse_overwriting};
use crate::error::Error;
use crate::pipeline::Stopwatch;
use crate::style::Style;

/// Style setting for limited face counts: contours along mesh edges, which are faster than smooth curves.
const FAST_CONTOUR_SETTING: &str = "lines.contours=mesh";

/// Draws all frames and prints a summary.
pub(crate) fn run(mut args: AnimateArgs) -> Result<(), Error> {
    let watch = Stopwatch::start();
    split_levels(&mut args)?;
    let mut request = DrawRequest::of_model(args.model.clone(), args.how.clone())?;
    let destination = if args.contact.contact_sheet {
        request = picture_request(request);
        Destination::Sheet(Output::new(args.out.clone())?)
    } else {
        Destination::of(&args.out)?
    };
    check(&args, &request, &destination)?;
    let total = library_calls::in_threads(request.how.threads, || draw(&args, &request, &destination))??;
    if !request.how.quiet {
        for warning in &total.warnings {
            say(&format!("warning: {}: {warning}", request.model.display()));
        }
        let line = match &destination {
            Destination::Sheet(_) => {
                let moments = number_text::counted(total.drawings, "moment");
                format!("{moments}, {}", number_text::bytes(total.counts.bytes_out))
            }
            _ => summary(&total, watch.seconds()),
        };
        say(&format!("{}: {line}", args.out.display()));
    }
    Ok(())
}

/// `--levels` with `--budget` is the older spelling of `--save-levels`.
fn split_levels(args: &mut AnimateArgs) -> Result<(), Error> {
    if args.budget.is_none() || args.levels.is_none() {
        return Ok(());
    }
    if args.save_levels.is_some() {
        return Err(Error::new("face counts are either read or found with --budget")
            .at("--levels")
            .remedy("leave out --levels or --budget"));
    }
    args.save_levels = args.levels.take();
    Ok(())
}

/// Refuses contradictory options before any work.
fn check(args: &AnimateArgs, request: &DrawRequest, destination: &Destination) -> Result<(), Error> {
    if request.how.time.is_some() {
        return Err(Error::new("an animation has no single moment")
            .at("--time")
            .remedy("give --from and --to, or draw one moment with ligne draw"));
    }
    if request.how.section.is_requested() {
        let goes_round = args.turntable.is_some() || args.path.is_some();
        if !goes_round || !request.how.animation.is_empty() {
            return Err(Error::new("a moving model can be neither cut nor exploded")
                .at("--section, --explode")
                .remedy("give --turntable 36, or draw one moment with ligne draw"));
        }
        if args.budget.is_some() || args.levels.is_some() || request.how.faces.is_some() {
            return Err(Error::new("a cut or exploded model cannot be simplified")
                .at("--section, --explode")
                .remedy("leave out --faces, --budget and --levels"));
        }
    }
    for file in args.report.iter().filter(|path| !is_stdout(path)).chain(&args.save_levels) {
        check_place(file)?;
    }
    match destination {
        Destination::Numbered(_) => Ok(()),
        Destination::Sheet(output) => {
            check_apart(&request.model, std::slice::from_ref(output), &[], None)?;
            check_outputs(std::slice::from_ref(output))
        }
        Destination::Film(path, _) => {
            let alone = [("--shard", args.shard.is_some()), ("--resume", args.resume)];
            if let Some((option, _)) = alone.into_iter().find(|(_, given)| *given) {
                return Err(Error::new("a single film cannot be split or resumed")
                    .at(option)
                    .remedy("write one file per frame, such as 'frames/%04d.svg'"));
            }
            check_place(path)?;
            refuse_overwriting(path, "the film", &request.model, "the model")
        }
    }
}

fn draw(
    args: &AnimateArgs,
    request: &DrawRequest,
    destination: &Destination,
) -> Result<AnimationTotals, Error> {
    // A smooth contour takes equally long on few and on many faces. Settings of the user come later and win.
    let hurried = args.budget.is_some() || args.levels.is_some();
    let sets: Vec<String> = hurried
        .then(|| FAST_CONTOUR_SETTING.to_owned())
        .into_iter()
        .chain(request.sets.iter().cloned())
        .collect();
    let mut style = library_calls::load_style(&request.how.style, &sets, request.background)?;
    let is_dxf = matches!(destination, Destination::Numbered(numbered) if numbered.format == Format::Dxf);
    if is_dxf || request.is_to_scale() {
        style = style.to_scale();
    }
    if hurried && style.motion.fade > 0 {
        return Err(Error::new("fading strokes need the same faces in all frames")
            .at("motion.fade")
            .remedy("leave out --budget and --levels, or --set motion.fade=0"));
    }
    let progress = Progress::start(request.how.quiet, &request.model);
    progress.step("reading");
    let mut watch = Stopwatch::start();
    let mut rigged = open_rigged(&request.model, &request.how.step)?;
    let coarse = args.budget.is_some() || args.levels.is_some() || request.how.faces.is_some();
    // Levels of detail belong to the stored model, before any part is removed.
    let detail = coarse.then(|| {
        let fewest = if args.budget.is_none() { request.how.faces } else { None };
        lod::detail(&request.model, &mut rigged.scene, fewest.unwrap_or(0))
    });
    if let Some(up) = request.how.up {
        rigged.scene.up = up;
    }
    let mut notes = usage_warnings::unmatched_patterns(&rigged.scene, &request.how.only, &request.how.hide);
    notes.extend(usage_warnings::bare_lengths(request));
    let mut whole = (request.how.framing.frame == FramedParts::All).then(|| rigged.clone());
    library_calls::keep_moving_parts(&mut rigged, &request.how.only, &request.how.hide)?;
    if request.how.section.is_requested() {
        open_up(request, &mut rigged, &mut whole, &mut style)?;
    }
    let plan = FramePlan::new(args, request, whole.as_ref().unwrap_or(&rigged))?;
    if !request.how.quiet {
        for note in &plan.notes {
            progress.print_line(&format!("note: {}: {note}", request.model.display()));
        }
    }
    let timeline = plan.schedule.timeline;
    let mut total = AnimationTotals { fps: timeline.fps(), ..AnimationTotals::default() };
    total.stages_ms.load = watch.lap_ms();
    for warning in rigged.scene.warnings.lines().into_iter().chain(plan.warnings.iter().cloned()).chain(notes)
    {
        total.warned.insert(warning, 0);
    }
    refuse_warnings(request, total.warned.keys())?;
    let drawings = timeline.drawn_frames().count();
    let faces = match (&args.levels, args.budget, request.how.faces) {
        (_, Some(ms), _) => FaceLimit::Budget(ms),
        (Some(path), None, _) => FaceLimit::Listed(face_limit::read_levels(path, drawings)?),
        (None, None, Some(most)) => FaceLimit::AtMost(most),
        (None, None, None) => FaceLimit::All,
    };
    let stage = FrameRenderer {
        args,
        request,
        plan: &plan,
        rigged: &rigged,
        style: &style,
        detail: detail.as_ref(),
        faces,
        progress: &progress,
    };
    match destination {
        Destination::Numbered(numbered) => stage.numbered(numbered, &mut total)?,
        Destination::Film(path, format) => stage.film(path, *format, &mut total)?,
        Destination::Sheet(output) => stage.sheet(output, &mut total)?,
    }
    drop(progress);
    if let (Some(ms), Some(path)) = (args.budget, &args.save_levels) {
        write_file(path, &face_limit::written_levels(&total.faces, ms))?;
    }
    let counted = |(warning, drawings): (&String, &usize)| match drawings {
        0 => warning.clone(),
        _ if *drawings as u64 == total.drawings => warning.clone(),
        _ => format!("{warning} ({})", number_text::counted(*drawings as u64, "frame")),
    };
    total.warnings = total.warned.iter().map(counted).collect();
    if let Some(path) = &args.report {
        write_report(path, &total)?;
    }
    Ok(total)
}

/// Cuts and explodes the model once for all frames.
fn open_up(
    request: &DrawRequest,
    rigged: &mut Rigged,
    whole: &mut Option<Rigged>,
    style: &mut Style,
) -> Result<(), Error> {
    let mut scene = std::mem::take(&mut rigged.scene);
    if cut_and_explode(&[request], &mut scene, &mut None, style)? {
        *whole = None;
    }
    *rigged = Rigged::from(scene);
    Ok(())
}

fn write_report(path: &Path, total: &AnimationTotals) -> Result<(), Error> {
    let json = json_files::text(total);
    if is_stdout(path) { print(json.as_bytes()) } else { write_file(path, json.as_bytes()) }
}

/// Summary line: `48 frames, 24 drawings, 91.2 kB, 1.30 s, 18.5 drawings a second`
fn summary(total: &AnimationTotals, seconds: f64) -> String {
    let AnimationTotals { frames, drawings, counts, faces, drawing_ms, .. } = total;
    let drawings_text = if frames == drawings {
        String::new()
    } else {
        format!("{}, ", number_text::counted(*drawings, "drawing"))
    };
    let mut line = format!(
        "{}, {drawings_text}{}, {seconds:.2} s, {:.1} drawings a second",
        number_text::counted(*frames, "frame"),
        number_text::bytes(counts.bytes_out),
        *drawings as f64 / seconds.max(tolerances::MIN_DURATION_S),
    );
    if let (Some(min_faces), Some(max_faces)) = (faces.iter().min(), faces.iter().max()) {
        let mut times = drawing_ms.clone();
        times.sort_unstable_by(f64::total_cmp);
        let late = times.get((times.len() * 99 / 100).min(times.len().saturating_sub(1))).copied();
        line += &format!(
            ", {} to {} faces, 99 % within {:.1} ms",
            number_text::grouped(*min_faces),
            number_text::grouped(*max_faces),
            late.unwrap_or_default()
        );
    }
    line
}
