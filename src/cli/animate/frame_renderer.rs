//! [`Stage`]: draws frames in parallel and writes them in order.

use std::path::Path;

use crate::parallel::prelude::*;

use super::animate_args::AnimateArgs;
use super::animation_totals::{Total, refuse_warnings};
use super::destination::FilmFormat;
use super::face_limit::Faces;
use super::film_writer::{Film, Frame};
use super::frame_fading::{Around, Drawn};
use super::frame_plan::Plan;
use crate::animate::{Animator, Budget, Level};
use crate::animation::Rigged;
use crate::cli::draw::model_drawing;
use crate::cli::library_calls;
use crate::cli::options::values::shard::Share;
use crate::cli::output::numbered_files::Numbered;
use crate::cli::output::output_files::{Format, Staging};
use crate::cli::output::progress::Progress;
use crate::cli::request::draw_request::DrawRequest;
use crate::drawing::Drawing;
use crate::edit::simplify::Detail;
use crate::error::Error;
use crate::export::encoding::gzip;
use crate::export::{DxfOptions, PngOptions, Resolution};
use crate::pipeline::{Report, Stopwatch};
use crate::style::Style;

/// Everything that the frames share.
pub(crate) struct Stage<'a> {
    pub(crate) args: &'a AnimateArgs,
    pub(crate) request: &'a DrawRequest,
    pub(crate) plan: &'a Plan,
    pub(crate) rigged: &'a Rigged,
    pub(crate) style: &'a Style,
    /// Levels of detail, if frames may have fewer faces than the model.
    pub(crate) detail: Option<&'a Detail>,
    pub(crate) faces: Faces,
    pub(crate) progress: &'a Progress,
}

/// Finished frame.
struct Made {
    /// The frame for a film; none if it is already written to a file.
    frame: Option<Frame>,
    report: Report,
    /// Drawing time, ms.
    ms: f64,
}

impl Stage<'_> {
    /// Draws the frames and writes one file per frame.
    pub(crate) fn numbered(&self, numbered: &Numbered, total: &mut Total) -> Result<(), Error> {
        let folder = &numbered.folder;
        if !folder.as_os_str().is_empty() && !folder.is_dir() {
            std::fs::create_dir_all(folder)
                .map_err(|error| Error::io("cannot create the folder", error).in_file(folder))?;
        }
        let timeline = self.plan.course.timeline;
        let shard = self.args.shard.map(Share::shard).transpose()?;
        let mine = |drawn: &usize| shard.is_none_or(|shard| shard.has(drawn / timeline.hold()));
        let missing = |drawn: &usize| {
            !self.args.resume || (0..timeline.shown(*drawn)).any(|held| !numbered.path(drawn + held).exists())
        };
        let frames: Vec<usize> = timeline.drawn().filter(mine).collect();
        total.frames = frames.iter().map(|drawn| timeline.shown(*drawn) as u64).sum();
        let frames: Vec<usize> = frames.into_iter().filter(missing).collect();
        let one = |drawn: usize, (drawing, mut report, ms): Drawn| -> Result<Made, Error> {
            let mut watch = Stopwatch::start();
            let bytes = match numbered.format {
                Format::Png => library_calls::png(&drawing, self.dpi(&drawing))?,
                #[cfg(feature = "pdf")]
                Format::Pdf => drawing.to_pdf(),
                Format::Svg | Format::SvgToStdout => library_calls::svg(&drawing, &self.request.svg),
                Format::Dxf => drawing.to_dxf(&DxfOptions::default()),
                Format::Svgz => gzip::packed(&library_calls::svg(&drawing, &self.request.svg)),
            };
            for held in 0..timeline.shown(drawn) {
                let mut staging = Staging::default();
                staging.add(&numbered.path(drawn + held), &bytes)?;
                staging.commit()?;
                report.counts.bytes_out += bytes.len() as u64;
            }
            report.stages_ms.write = watch.lap_ms();
            Ok(Made { frame: None, report, ms })
        };
        self.in_order(&frames, one, |_, _| Ok(0.0), total)
    }

    /// Draws all frames into one film.
    pub(crate) fn film(&self, path: &Path, format: FilmFormat, total: &mut Total) -> Result<(), Error> {
        let timeline = self.plan.course.timeline;
        let frames: Vec<usize> = timeline.drawn().collect();
        total.frames = timeline.frames() as u64;
        let in_file = |error: Error| match error.file {
            None => error.in_file(path),
            Some(_) => error,
        };
        let mut film =
            Film::new(path, format, timeline.fps(), frames.len(), &self.request.svg).map_err(in_file)?;
        let one = |_: usize, (drawing, mut report, ms): Drawn| -> Result<Made, Error> {
            let mut watch = Stopwatch::start();
            let frame = if format.is_vector() {
                Frame::Vector(Box::new(drawing))
            } else {
                let options = PngOptions::of_resolution(Resolution::Dpi(self.dpi(&drawing)));
                Frame::Pixels(drawing.to_pixels(&options).map_err(in_file)?)
            };
            report.stages_ms.write = watch.lap_ms();
            Ok(Made { frame: Some(frame), report, ms })
        };
        let put = |drawn: usize, frame: &Frame| {
            let mut watch = Stopwatch::start();
            film.push(frame, timeline.shown(drawn) as u32).map_err(in_file)?;
            Ok(watch.lap_ms())
        };
        self.in_order(&frames, one, put, total)?;
        if film.left_out() > 0 {
            let warning = format!(
                "GIF shows a frame for two hundredths of a second at least: {} of {} frames are left out; .webp and .png have more \
                 than 50 a second",
                film.left_out(),
                frames.len()
            );
            refuse_warnings(self.request, [&warning].into_iter())?;
            total.warned.insert(warning, 0);
        }
        let mut watch = Stopwatch::start();
        total.counts.bytes_out = film.finish().map_err(in_file)?;
        total.stages_ms.write += watch.lap_ms();
        Ok(())
    }

    /// Draws one frame.
    pub(crate) fn draw(&self, animator: &Animator, frame: usize) -> Result<Drawn, Error> {
        let mut watch = Stopwatch::start();
        let moment = self.plan.moment(self.rigged, frame, self.style.background)?;
        let (drawing, mut report) = animator.draw(&moment).map_err(|error| match error.file {
            None => error.in_file(&self.request.model),
            Some(_) => error,
        })?;
        let ms = watch.lap_ms();
        report.counts.triangles = model_drawing::triangles(animator.rest());
        report.counts.paths = model_drawing::paths(&drawing);
        refuse_warnings(self.request, report.warnings.iter())?;
        Ok((drawing, report, ms))
    }

    fn dpi(&self, drawing: &Drawing) -> f64 {
        self.request.dpi.unwrap_or(model_drawing::default_dpi(drawing.page.unit))
    }

    /// Draws frames within their face limits and passes them on in order.
    fn in_order(
        &self,
        frames: &[usize],
        make: impl Fn(usize, Drawn) -> Result<Made, Error> + Sync,
        mut put: impl FnMut(usize, &Frame) -> Result<f64, Error>,
        total: &mut Total,
    ) -> Result<(), Error> {
        let mut take = |drawn: usize, made: &Made, total: &mut Total| {
            if let Some(frame) = &made.frame {
                total.stages_ms.write += put(drawn, frame)?;
            }
            total.add(&made.report, made.ms);
            Ok(())
        };
        let Some(detail) = self.detail else {
            let animator = Animator::new(self.rigged, self.style);
            return self.at_once(&animator, frames, &make, &mut take, total);
        };
        let level = |faces: u64| Level::of(detail, &self.rigged.scene, faces);
        let faces_of = |drawn: usize| match &self.faces {
            Faces::Listed(list) => list.get(drawn / self.plan.course.timeline.hold()).copied(),
            Faces::Most(most) => Some(*most),
            Faces::All | Faces::Budget(_) => None,
        };
        let Faces::Budget(ms) = self.faces else {
            for frames in frames.chunk_by(|a, b| faces_of(*a) == faces_of(*b)) {
                let faces = frames.first().and_then(|drawn| faces_of(*drawn)).unwrap_or(u64::MAX);
                let level = level(faces)?;
                let animator = Animator::at_level(self.rigged, &level, self.style).ready();
                total.faces.extend(frames.iter().map(|_| faces));
                self.at_once(&animator, frames, &make, &mut take, total)?;
            }
            return Ok(());
        };
        // Drawn one by one, because frames drawn at the same time would distort the measured times.
        let mut budget = Budget::new(ms, model_drawing::triangles(&self.rigged.scene));
        let mut left = frames;
        while !left.is_empty() {
            let faces = budget.faces();
            let level = level(faces)?;
            let animator = Animator::at_level(self.rigged, &level, self.style).ready();
            while let Some((drawn, rest)) = left.split_first().filter(|_| budget.faces() == faces) {
                self.step(frames.len() - left.len(), frames.len());
                let made = make(*drawn, self.draw(&animator, *drawn)?)?;
                budget.took(made.ms);
                total.faces.push(faces);
                take(*drawn, &made, total)?;
                left = rest;
            }
        }
        Ok(())
    }

    /// Draws as many frames in parallel as there are threads, and passes them on in order.
    fn at_once(
        &self,
        animator: &Animator,
        frames: &[usize],
        make: &(impl Fn(usize, Drawn) -> Result<Made, Error> + Sync),
        take: &mut impl FnMut(usize, &Made, &mut Total) -> Result<(), Error>,
        total: &mut Total,
    ) -> Result<(), Error> {
        let at_once = rayon_core::current_num_threads().max(1);
        let motion = &self.style.motion;
        let mut around = Around::new(&self.plan.course, motion.fade, motion.fade_by);
        let draw = |drawn: usize| self.draw(animator, drawn);
        for (number, window) in frames.chunks(at_once).enumerate() {
            self.step(number * at_once, frames.len());
            if motion.fade > 0 {
                around.look_at(window, draw)?;
            }
            let make = |drawn: &usize| make(*drawn, around.faded(*drawn).map_or_else(|| draw(*drawn), Ok)?);
            let made: Vec<Result<Made, Error>> = window.par_iter().with_max_len(1).map(make).collect();
            for (drawn, made) in window.iter().zip(made) {
                take(*drawn, &made?, total)?;
            }
        }
        Ok(())
    }

    fn step(&self, done: usize, of: usize) {
        self.progress.step(format!("frame {} of {of} of", done + 1));
    }
}
