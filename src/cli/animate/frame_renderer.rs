//! [`FrameRenderer`]: draws frames in parallel and writes them in order.

use std::path::Path;

use crate::parallel::prelude::*;

use super::animate_args::AnimateArgs;
use super::animation_totals::{AnimationTotals, refuse_warnings};
use super::destination::FilmFormat;
use super::face_limit::FaceLimit;
use super::film_writer::{FilmFile, FilmFrame};
use super::frame_fading::{FadeWindow, TimedDrawing};
use super::frame_plan::FramePlan;
use crate::animate::{Animator, Budget, DetailLevel};
use crate::animation::Rigged;
use crate::cli::draw::model_drawing;
use crate::cli::library_calls;
use crate::cli::options::values::shard::ShardSpec;
use crate::cli::output::numbered_files::NumberedFiles;
use crate::cli::output::output_files::{Format, write_file};
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
pub(crate) struct FrameRenderer<'a> {
    pub(crate) args: &'a AnimateArgs,
    pub(crate) request: &'a DrawRequest,
    pub(crate) plan: &'a FramePlan,
    pub(crate) rigged: &'a Rigged,
    pub(crate) style: &'a Style,
    /// Levels of detail, if frames may have fewer faces than the model.
    pub(crate) detail: Option<&'a Detail>,
    pub(crate) faces: FaceLimit,
    pub(crate) progress: &'a Progress,
}

/// Finished frame.
struct FinishedFrame {
    /// The frame for a film; none if it is already written to a file.
    frame: Option<FilmFrame>,
    report: Report,
    /// Drawing time, ms.
    ms: f64,
}

impl FrameRenderer<'_> {
    /// Draws the frames and writes one file per frame.
    pub(crate) fn numbered(
        &self,
        numbered: &NumberedFiles,
        total: &mut AnimationTotals,
    ) -> Result<(), Error> {
        let folder = &numbered.folder;
        if !folder.as_os_str().is_empty() && !folder.is_dir() {
            std::fs::create_dir_all(folder)
                .map_err(|error| Error::io("cannot create the folder", error).in_file(folder))?;
        }
        let timeline = self.plan.schedule.timeline;
        let shard = self.args.shard.map(ShardSpec::shard).transpose()?;
        let is_in_shard =
            |frame_index: &usize| shard.is_none_or(|shard| shard.has(frame_index / timeline.hold()));
        let missing = |frame_index: &usize| {
            !self.args.resume
                || (0..timeline.repeat_count(*frame_index))
                    .any(|repeat_offset| !numbered.path(frame_index + repeat_offset).exists())
        };
        let frames: Vec<usize> = timeline.drawn_frames().filter(is_in_shard).collect();
        total.frames = frames.iter().map(|frame_index| timeline.repeat_count(*frame_index) as u64).sum();
        let frames: Vec<usize> = frames.into_iter().filter(missing).collect();
        let encode_frame =
            |frame_index: usize, (drawing, mut report, ms): TimedDrawing| -> Result<FinishedFrame, Error> {
                let mut watch = Stopwatch::start();
                let bytes = match numbered.format {
                    Format::Png => library_calls::png(&drawing, self.dpi(&drawing))?,
                    #[cfg(feature = "pdf")]
                    Format::Pdf => drawing.to_pdf(),
                    Format::Svg | Format::SvgToStdout => library_calls::svg(&drawing, &self.request.how),
                    Format::Dxf => drawing.to_dxf(&DxfOptions::default()),
                    Format::Svgz => gzip::packed(&library_calls::svg(&drawing, &self.request.how)),
                };
                for repeat_offset in 0..timeline.repeat_count(frame_index) {
                    write_file(&numbered.path(frame_index + repeat_offset), &bytes)?;
                    report.counts.bytes_out += bytes.len() as u64;
                }
                report.stages_ms.write = watch.lap_ms();
                Ok(FinishedFrame { frame: None, report, ms })
            };
        self.draw_in_order(&frames, encode_frame, |_, _| Ok(0.0), total)
    }

    /// Draws all frames into one film.
    pub(crate) fn film(
        &self,
        path: &Path,
        format: FilmFormat,
        total: &mut AnimationTotals,
    ) -> Result<(), Error> {
        let timeline = self.plan.schedule.timeline;
        let frames: Vec<usize> = timeline.drawn_frames().collect();
        total.frames = timeline.frames() as u64;
        let in_file = |error: Error| error.or_in_file(path);
        let mut film =
            FilmFile::new(path, format, timeline.fps(), frames.len(), &self.request.how).map_err(in_file)?;
        let one = |_: usize, (drawing, mut report, ms): TimedDrawing| -> Result<FinishedFrame, Error> {
            let mut watch = Stopwatch::start();
            let frame = if format.is_vector() {
                FilmFrame::Vector(Box::new(drawing))
            } else {
                let options = PngOptions::of_resolution(Resolution::Dpi(self.dpi(&drawing)));
                FilmFrame::Pixels(drawing.to_pixels(&options).map_err(in_file)?)
            };
            report.stages_ms.write = watch.lap_ms();
            Ok(FinishedFrame { frame: Some(frame), report, ms })
        };
        let put = |drawn: usize, frame: &FilmFrame| {
            let mut watch = Stopwatch::start();
            film.push(frame, timeline.repeat_count(drawn) as u32).map_err(in_file)?;
            Ok(watch.lap_ms())
        };
        self.draw_in_order(&frames, one, put, total)?;
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
    pub(crate) fn draw(&self, animator: &Animator, frame: usize) -> Result<TimedDrawing, Error> {
        let mut watch = Stopwatch::start();
        let moment = self.plan.moment(self.rigged, frame, self.style.background)?;
        let (drawing, mut report) =
            animator.draw(&moment).map_err(|error| error.or_in_file(&self.request.model))?;
        let ms = watch.lap_ms();
        report.counts.triangles = model_drawing::triangles(animator.rest());
        report.counts.paths = model_drawing::paths(&drawing);
        refuse_warnings(self.request, report.warnings.iter())?;
        Ok((drawing, report, ms))
    }

    fn dpi(&self, drawing: &Drawing) -> f64 {
        self.request.how.dpi.unwrap_or(model_drawing::default_dpi(drawing.page.unit))
    }

    /// Draws frames within their face limits and passes them on in order.
    fn draw_in_order(
        &self,
        frames: &[usize],
        make: impl Fn(usize, TimedDrawing) -> Result<FinishedFrame, Error> + Sync,
        mut write_frame: impl FnMut(usize, &FilmFrame) -> Result<f64, Error>,
        total: &mut AnimationTotals,
    ) -> Result<(), Error> {
        let mut take = |frame_index: usize, finished_frame: &FinishedFrame, total: &mut AnimationTotals| {
            if let Some(frame) = &finished_frame.frame {
                total.stages_ms.write += write_frame(frame_index, frame)?;
            }
            total.add(&finished_frame.report, finished_frame.ms);
            Ok(())
        };
        let Some(detail) = self.detail else {
            let animator = Animator::new(self.rigged, self.style);
            return self.draw_in_parallel(&animator, frames, &make, &mut take, total);
        };
        let level = |faces: u64| DetailLevel::of(detail, &self.rigged.scene, faces);
        let faces_of = |frame_index: usize| match &self.faces {
            FaceLimit::Listed(list) => list.get(frame_index / self.plan.schedule.timeline.hold()).copied(),
            FaceLimit::AtMost(max_faces) => Some(*max_faces),
            FaceLimit::All | FaceLimit::Budget(_) => None,
        };
        let FaceLimit::Budget(ms) = self.faces else {
            for frames in frames.chunk_by(|a, b| faces_of(*a) == faces_of(*b)) {
                let faces = frames.first().and_then(|frame_index| faces_of(*frame_index)).unwrap_or(u64::MAX);
                let level = level(faces)?;
                let animator = Animator::at_level(self.rigged, &level, self.style).ready();
                total.faces.extend(frames.iter().map(|_| faces));
                self.draw_in_parallel(&animator, frames, &make, &mut take, total)?;
            }
            return Ok(());
        };
        // Drawn one by one, because frames drawn at the same time would distort the measured times.
        let mut budget = Budget::new(ms, model_drawing::triangles(&self.rigged.scene));
        let mut remaining_frames = frames;
        while !remaining_frames.is_empty() {
            let faces = budget.faces();
            let level = level(faces)?;
            let animator = Animator::at_level(self.rigged, &level, self.style).ready();
            while let Some((frame_index, rest)) =
                remaining_frames.split_first().filter(|_| budget.faces() == faces)
            {
                self.step(frames.len() - remaining_frames.len(), frames.len());
                let finished_frame = make(*frame_index, self.draw(&animator, *frame_index)?)?;
                budget.record_frame(finished_frame.ms);
                total.faces.push(faces);
                take(*frame_index, &finished_frame, total)?;
                remaining_frames = rest;
            }
        }
        Ok(())
    }

    /// Draws as many frames in parallel as there are threads, and passes them on in order.
    fn draw_in_parallel(
        &self,
        animator: &Animator,
        frames: &[usize],
        make: &(impl Fn(usize, TimedDrawing) -> Result<FinishedFrame, Error> + Sync),
        take: &mut impl FnMut(usize, &FinishedFrame, &mut AnimationTotals) -> Result<(), Error>,
        total: &mut AnimationTotals,
    ) -> Result<(), Error> {
        let at_once = rayon_core::current_num_threads().max(1);
        let motion = &self.style.motion;
        let mut fade_window = FadeWindow::new(&self.plan.schedule, motion.fade, motion.fade_by);
        let draw = |frame_index: usize| self.draw(animator, frame_index);
        for (number, window) in frames.chunks(at_once).enumerate() {
            self.step(number * at_once, frames.len());
            if motion.fade > 0 {
                fade_window.prepare_frames(window, draw)?;
            }
            let make = |frame_index: &usize| {
                make(
                    *frame_index,
                    fade_window.faded_drawing(*frame_index).map_or_else(|| draw(*frame_index), Ok)?,
                )
            };
            let finished_frames: Vec<Result<FinishedFrame, Error>> =
                window.par_iter().with_max_len(1).map(make).collect();
            for (frame_index, finished_frame) in window.iter().zip(finished_frames) {
                take(*frame_index, &finished_frame?, total)?;
            }
        }
        Ok(())
    }

    fn step(&self, done: usize, of: usize) {
        self.progress.step(format!("frame {} of {of} of", done + 1));
    }
}
