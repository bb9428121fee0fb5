//! `ligne animate --contact-sheet`: the moments of an animation side by side.

use super::stage::Stage;
use super::total::Total;
use crate::animate::Animator;
use crate::cli::contact_sheet::{COLUMNS, Picture, write};
use crate::cli::number;
use crate::cli::output::Output;
use crate::error::Error;

impl Stage<'_> {
    /// All frames on one sheet, with their times as captions.
    pub(super) fn sheet(&self, output: &Output, total: &mut Total) -> Result<(), Error> {
        let timeline = self.plan.course.timeline;
        let animator = Animator::new(self.rigged, self.style);
        let mut pictures = Vec::new();
        for frame in timeline.drawn() {
            let (drawing, report, ms) = self.draw(&animator, frame)?;
            total.add(&report, ms);
            let time = number::plain(timeline.time(frame), 3);
            pictures.push(Picture {
                drawing,
                caption: format!("--time {time}"),
                key: format!("time-{time}"),
            });
        }
        total.frames = pictures.len() as u64;
        let outputs = std::slice::from_ref(output);
        total.counts.bytes_out =
            write(pictures, COLUMNS, self.request, outputs)?.iter().map(|(_, bytes)| bytes).sum();
        Ok(())
    }
}
