//! `ligne animate`: a model's animation, or a turn round a model, frame by frame.

mod args;
mod destination;
mod film;
mod plan;
mod video;

use std::collections::BTreeMap;
use std::path::Path;

use rayon::prelude::*;
use serde::Serialize;

pub(super) use args::AnimateArgs;
use destination::{Destination, FilmFormat, Numbered};
use film::{Film, Frame};
use plan::Plan;

use super::output::{Format, Staging, check_place, is_stdout};
use super::progress::Progress;
use super::request::DrawRequest;
use super::{draw, number, pipeline, print, say};
use crate::animate::Animator;
use crate::drawing::Drawing;
use crate::error::Error;
use crate::export::{PngOptions, Resolution};
use crate::math::colour::Colour;
use crate::pose::Rigged;
use crate::render::report::{Counts, StagesMs};
use crate::render::{Report, Stopwatch};

/// What all frames took and what they hold.
#[derive(Debug, Default, Serialize)]
struct Total {
    /// Frames, and those of them that were drawn.
    frames: u64,
    drawings: u64,
    fps: f64,
    stages_ms: StagesMs,
    counts: Counts,
    warnings: Vec<String>,
    /// In how many drawings there was each warning.
    #[serde(skip)]
    warned: BTreeMap<String, usize>,
}

/// Draws all frames, and says so in one line.
pub(super) fn run(args: AnimateArgs) -> Result<(), Error> {
    let watch = Stopwatch::start();
    let destination = Destination::of(&args.out)?;
    let request = DrawRequest::of_model(args.model.clone(), args.how.clone())?;
    check(&args, &request, &destination)?;
    let total = pipeline::in_threads(request.threads, || draw(&args, &request, &destination))??;
    if !request.quiet {
        for warning in &total.warnings {
            say(&format!("warning: {}: {warning}", request.model.display()));
        }
        say(&format!("{}: {}", args.out.display(), summary(&total, watch.seconds())));
    }
    Ok(())
}

/// Refuses what cannot be done, before any work.
fn check(args: &AnimateArgs, request: &DrawRequest, destination: &Destination) -> Result<(), Error> {
    if request.time.is_some() {
        return Err(Error::new("frames have times of their own")
            .at("--time")
            .remedy("say with --from and --to which are drawn, or draw one moment with ligne draw"));
    }
    if let Some(report) = args.report.as_ref().filter(|path| !is_stdout(path)) {
        check_place(report)?;
    }
    match destination {
        Destination::Numbered(_) => Ok(()),
        Destination::Film(path, _) => {
            let alone = [("--shard", args.shard.is_some()), ("--resume", args.resume)];
            if let Some((option, _)) = alone.into_iter().find(|(_, given)| *given) {
                return Err(Error::new("one film is not written piece by piece")
                    .at(option)
                    .remedy("write a file for each frame, such as 'frames/%04d.svg'"));
            }
            check_place(path)?;
            let same = |path: &Path| path.canonicalize().ok();
            if same(path).is_some() && same(path) == same(&request.model) {
                return Err(Error::new("the film would overwrite the model")
                    .in_file(path)
                    .remedy("give the film another name"));
            }
            Ok(())
        }
    }
}

fn draw(args: &AnimateArgs, request: &DrawRequest, destination: &Destination) -> Result<Total, Error> {
    let style = pipeline::load_style(&request.style, &request.sets, request.background)?;
    let progress = Progress::start(request.quiet, &request.model);
    progress.step("reading");
    let mut watch = Stopwatch::start();
    let mut rigged = Rigged::open(&request.model)?;
    pipeline::keep_moving_parts(&mut rigged, &request.only, &request.hide)?;
    if let Some(up) = request.up {
        rigged.scene.up = up;
    }
    let plan = Plan::new(args, request, &rigged)?;
    let timeline = plan.course.timeline;
    let mut total = Total { fps: timeline.fps(), ..Total::default() };
    total.stages_ms.load = watch.lap_ms();
    for warning in rigged.scene.warnings.lines().into_iter().chain(plan.warnings.iter().cloned()) {
        total.warned.insert(warning, 0);
    }
    refuse_warnings(request, total.warned.keys())?;
    let animator = Animator::new(&rigged, &style);
    let stage =
        Stage { args, request, plan: &plan, animator: &animator, rigged: &rigged, progress: &progress };
    match destination {
        Destination::Numbered(numbered) => stage.numbered(numbered, style.background, &mut total)?,
        Destination::Film(path, format) => stage.film(path, *format, style.background, &mut total)?,
    }
    drop(progress);
    let counted = |(warning, drawings): (&String, &usize)| match drawings {
        0 => warning.clone(),
        _ if *drawings as u64 == total.drawings => warning.clone(),
        _ => format!("{warning} ({})", number::counted(*drawings as u64, "frame")),
    };
    total.warnings = total.warned.iter().map(counted).collect();
    if let Some(path) = &args.report {
        write_report(path, &total)?;
    }
    Ok(total)
}

/// All that frames are drawn with.
struct Stage<'a> {
    args: &'a AnimateArgs,
    request: &'a DrawRequest,
    plan: &'a Plan,
    animator: &'a Animator<'a>,
    rigged: &'a Rigged,
    progress: &'a Progress,
}

impl Stage<'_> {
    /// Draws the frame of a number.
    fn draw(&self, frame: usize, background: Option<Colour>) -> Result<(Drawing, Report), Error> {
        let moment = self.plan.moment(self.rigged, frame, background)?;
        let (drawing, mut report) = self.animator.draw(&moment).map_err(|error| match error.file {
            None => error.in_file(&self.request.model),
            Some(_) => error,
        })?;
        report.counts.triangles = draw::triangles(&self.rigged.scene);
        report.counts.paths = draw::paths(&drawing);
        refuse_warnings(self.request, report.warnings.iter())?;
        Ok((drawing, report))
    }

    /// The resolution of frames as pixels.
    fn png(&self, drawing: &Drawing) -> PngOptions {
        let dpi = self.request.dpi.unwrap_or(draw::default_dpi(drawing.page.unit));
        PngOptions::of_resolution(Resolution::Dpi(dpi))
    }

    /// A file for each frame, written as soon as it is drawn.
    fn numbered(
        &self,
        numbered: &Numbered,
        background: Option<Colour>,
        total: &mut Total,
    ) -> Result<(), Error> {
        let folder = &numbered.folder;
        if !folder.as_os_str().is_empty() && !folder.is_dir() {
            std::fs::create_dir_all(folder)
                .map_err(|error| Error::io("cannot create the folder", error).in_file(folder))?;
        }
        let timeline = self.plan.course.timeline;
        let mine = |drawn: &usize| {
            self.args.shard.is_none_or(|shard| (drawn / timeline.hold()) % shard.of == shard.first)
        };
        let missing = |drawn: &usize| {
            !self.args.resume || (0..timeline.shown(*drawn)).any(|held| !numbered.path(drawn + held).exists())
        };
        let frames: Vec<usize> = timeline.drawn().filter(mine).collect();
        total.frames = frames.iter().map(|drawn| timeline.shown(*drawn) as u64).sum();
        let frames: Vec<usize> = frames.into_iter().filter(missing).collect();
        let one = |drawn: &usize| -> Result<Report, Error> {
            let (drawing, mut report) = self.draw(*drawn, background)?;
            let mut watch = Stopwatch::start();
            let bytes = match numbered.format {
                Format::Png => {
                    pipeline::png(&drawing, self.request.dpi.unwrap_or(draw::default_dpi(drawing.page.unit)))?
                }
                #[cfg(feature = "pdf")]
                Format::Pdf => drawing.to_pdf(),
                Format::Svg | Format::SvgToStdout => pipeline::svg(&drawing, &self.request.svg),
            };
            for held in 0..timeline.shown(*drawn) {
                let mut staging = Staging::default();
                staging.add(&numbered.path(drawn + held), &bytes)?;
                staging.commit()?;
                report.counts.bytes_out += bytes.len() as u64;
            }
            report.stages_ms.write = watch.lap_ms();
            Ok(report)
        };
        self.in_order(
            &frames,
            one,
            |_, report, total| {
                total.add(&report);
                Ok(())
            },
            total,
        )
    }

    /// All frames in one file.
    fn film(
        &self,
        path: &Path,
        format: FilmFormat,
        background: Option<Colour>,
        total: &mut Total,
    ) -> Result<(), Error> {
        let timeline = self.plan.course.timeline;
        let frames: Vec<usize> = timeline.drawn().collect();
        total.frames = timeline.frames() as u64;
        let in_file = |error: Error| match error.file {
            None => error.in_file(path),
            Some(_) => error,
        };
        let mut film =
            Film::new(path, format, timeline.fps(), frames.len(), &self.request.svg).map_err(in_file)?;
        let one = |drawn: &usize| -> Result<(Frame, Report), Error> {
            let (drawing, mut report) = self.draw(*drawn, background)?;
            let mut watch = Stopwatch::start();
            let frame = match format.is_vector() {
                true => Frame::Vector(Box::new(drawing)),
                false => Frame::Pixels(drawing.to_pixels(&self.png(&drawing)).map_err(in_file)?),
            };
            report.stages_ms.write = watch.lap_ms();
            Ok((frame, report))
        };
        let mut put = |drawn: usize, (frame, report): (Frame, Report), total: &mut Total| {
            let mut watch = Stopwatch::start();
            film.push(&frame, timeline.shown(drawn) as u32).map_err(in_file)?;
            total.stages_ms.write += watch.lap_ms();
            total.add(&report);
            Ok(())
        };
        self.in_order(&frames, one, &mut put, total)?;
        let mut watch = Stopwatch::start();
        total.counts.bytes_out = film.finish().map_err(in_file)?;
        total.stages_ms.write += watch.lap_ms();
        Ok(())
    }

    /// Makes frames, as many at once as there are threads, and takes them in their order.
    fn in_order<T: Send>(
        &self,
        frames: &[usize],
        make: impl Fn(&usize) -> Result<T, Error> + Sync,
        mut take: impl FnMut(usize, T, &mut Total) -> Result<(), Error>,
        total: &mut Total,
    ) -> Result<(), Error> {
        let at_once = rayon::current_num_threads().max(1);
        for (number, window) in frames.chunks(at_once).enumerate() {
            self.progress.step(format!("frame {} of {} of", number * at_once + 1, frames.len()));
            let made: Vec<Result<T, Error>> = window.par_iter().with_max_len(1).map(&make).collect();
            for (drawn, made) in window.iter().zip(made) {
                take(*drawn, made?, total)?;
            }
        }
        Ok(())
    }
}

impl Total {
    /// Adds what a drawing took and holds.
    fn add(&mut self, report: &Report) {
        self.drawings += 1;
        self.stages_ms += report.stages_ms;
        self.counts += report.counts;
        for warning in &report.warnings {
            *self.warned.entry(warning.clone()).or_default() += 1;
        }
    }
}

/// Under `--strict` warnings are errors.
fn refuse_warnings<'a>(
    request: &DrawRequest,
    mut warnings: impl Iterator<Item = &'a String>,
) -> Result<(), Error> {
    match warnings.next().filter(|_| request.strict) {
        Some(warning) => Err(Error::new(warning.clone())
            .in_file(&request.model)
            .remedy("mend the model, or draw without --strict")),
        None => Ok(()),
    }
}

fn write_report(path: &Path, total: &Total) -> Result<(), Error> {
    // Numbers and strings always serialise.
    let mut json = serde_json::to_string_pretty(total).unwrap_or_default();
    json.push('\n');
    if is_stdout(path) {
        return print(json.as_bytes());
    }
    let mut staging = Staging::default();
    staging.add(path, json.as_bytes())?;
    staging.commit()
}

/// `48 frames, 24 drawings, 91.2 kB, 1.30 s, 18.5 drawings a second`
fn summary(total: &Total, seconds: f64) -> String {
    let Total { frames, drawings, counts, .. } = total;
    let held = if frames == drawings {
        String::new()
    } else {
        format!("{}, ", number::counted(*drawings, "drawing"))
    };
    format!(
        "{}, {held}{}, {seconds:.2} s, {:.1} drawings a second",
        number::counted(*frames, "frame"),
        number::bytes(counts.bytes_out),
        *drawings as f64 / seconds.max(1e-9),
    )
}
