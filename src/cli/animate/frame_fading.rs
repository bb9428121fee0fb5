//! [`FadeWindow`]: drawings of neighbouring frames, kept while they are needed to fade strokes in and out.

use std::collections::{BTreeMap, BTreeSet};

use crate::parallel::prelude::*;

use super::frame_plan::FrameSchedule;
use crate::animate::{StrokeTrace, fade};
use crate::drawing::Drawing;
use crate::error::Error;
use crate::motion::FadeBy;
use crate::pipeline::Report;

/// Drawing of a frame, its report, and its drawing time in ms.
pub(crate) type TimedDrawing = (Drawing, Report, f64);

/// Window of drawings around the frames that are being finished.
pub(crate) struct FadeWindow<'a> {
    schedule: &'a FrameSchedule,
    /// Number of drawings before and after each frame that its fading uses.
    frames: u32,
    by: FadeBy,
    drawings: BTreeMap<usize, (TimedDrawing, StrokeTrace)>,
}

impl<'a> FadeWindow<'a> {
    pub(crate) fn new(course: &'a FrameSchedule, frames: u32, by: FadeBy) -> Self {
        Self { schedule: course, frames, by, drawings: BTreeMap::new() }
    }

    /// Draws the missing frames of the windows around `frames`, and drops drawings outside them.
    pub(crate) fn prepare_frames(
        &mut self,
        frames: &[usize],
        draw: impl Fn(usize) -> Result<TimedDrawing, Error> + Sync,
    ) -> Result<(), Error> {
        let needed_frames = |frame: usize| self.pairs(frame).flatten().flatten().chain([frame]);
        let required_frames: BTreeSet<usize> = frames.iter().copied().flat_map(needed_frames).collect();
        let missing: Vec<usize> =
            required_frames.iter().copied().filter(|frame| !self.drawings.contains_key(frame)).collect();
        self.drawings.retain(|frame, _| required_frames.contains(frame));
        let draw = |frame: &usize| draw(*frame).map(|timed| (*frame, timed));
        let results: Vec<_> = missing.par_iter().with_max_len(1).map(draw).collect();
        for result in results {
            let (frame, timed_drawing) = result?;
            let trace = StrokeTrace::of(&timed_drawing.0);
            self.drawings.insert(frame, (timed_drawing, trace));
        }
        Ok(())
    }

    /// Drawing of a prepared frame with fading strokes; none if the frame is not in the window.
    pub(crate) fn faded_drawing(&self, frame: usize) -> Option<TimedDrawing> {
        let ((drawing, report, ms), _) = self.drawings.get(&frame)?;
        let trace = |frame: Option<usize>| self.drawings.get(&frame?).map(|(_, trace)| trace);
        let around: Vec<_> = self.pairs(frame).map(|pair| pair.map(trace)).collect();
        let mut drawing = drawing.clone();
        fade(&mut drawing, &around, self.by);
        Some((drawing, report.clone(), *ms))
    }

    /// Neighbours before and after a frame, nearest pair first.
    fn pairs(&self, frame: usize) -> impl Iterator<Item = [Option<usize>; 2]> + use<'a> {
        let course = self.schedule;
        (1..=self.frames as isize).map(move |far| [-far, far].map(|by| course.beside(frame, by)))
    }
}
