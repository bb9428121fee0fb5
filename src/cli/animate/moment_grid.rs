//! `ligne animate --contact-sheet`: moments of an animation on one sheet.

use super::animation_totals::AnimationTotals;
use super::frame_renderer::FrameRenderer;
use crate::animate::Animator;
use crate::cli::draw::contact_sheet::{COLUMN_COUNT, GridPicture, write};
use crate::cli::output::number_text;
use crate::cli::output::output_files::Output;
use crate::error::Error;

impl FrameRenderer<'_> {
    /// Draws all frames on one sheet, with their times as captions.
    pub(crate) fn sheet(&self, output: &Output, total: &mut AnimationTotals) -> Result<(), Error> {
        let timeline = self.plan.schedule.timeline;
        let animator = Animator::new(self.rigged, self.style);
        let mut pictures = Vec::new();
        for frame in timeline.drawn_frames() {
            let (drawing, report, ms) = self.draw(&animator, frame)?;
            total.add(&report, ms);
            let time = number_text::plain(timeline.time(frame), 3);
            pictures.push(GridPicture {
                drawing,
                caption: format!("--time {time}"),
                key: format!("time-{time}"),
            });
        }
        total.frames = pictures.len() as u64;
        let outputs = std::slice::from_ref(output);
        total.counts.bytes_out =
            write(pictures, COLUMN_COUNT, self.request, outputs)?.iter().map(|(_, bytes)| bytes).sum();
        Ok(())
    }
}
