//! Animated PNG, exact and with transparency. Programs without animation show the first frame.

use std::io::Write;

use png::{BitDepth, BlendOp, ColorType, Compression, DisposeOp, Encoder, EncodingError, Writer};

use super::frame_clock::FrameClock;
use super::frame_difference::ChangedRect;
use crate::error::Error;
use crate::export::Pixels;

/// Time units per second.
const TIME_UNITS_PER_SECOND: u16 = 1000;

/// Writer of an animated PNG.
pub struct ApngFilm<W: Write> {
    /// Writer, until the first frame determines the size.
    out: Option<W>,
    writer: Option<Writer<W>>,
    pace: FrameClock,
    frames: u32,
    written: u32,
    before: Option<Pixels>,
}

impl<W: Write> ApngFilm<W> {
    /// Creates a film with `fps` ticks per second. Exactly `frames` frames must be pushed.
    pub fn new(out: W, fps: f64, frames: u32) -> Self {
        Self { out: Some(out), writer: None, pace: FrameClock::new(fps), frames, written: 0, before: None }
    }

    /// Adds a frame that is shown for `ticks` ticks.
    ///
    /// # Errors
    /// If it cannot be written, has another size than the first frame, or is one too many.
    pub fn push(&mut self, pixels: &Pixels, ticks: u32) -> Result<(), Error> {
        if self.written == self.frames {
            return Err(Error::new(format!("the film should have {} frames", self.frames)));
        }
        let changed = ChangedRect::since(self.before.as_ref(), pixels)?;
        let delay = self.pace.next(ticks, f64::from(TIME_UNITS_PER_SECOND)).min(u32::from(u16::MAX)) as u16;
        self.write(pixels, changed, delay).map_err(cannot_write)?;
        self.before = Some(pixels.clone());
        self.written += 1;
        Ok(())
    }

    fn write(&mut self, pixels: &Pixels, changed: ChangedRect, delay: u16) -> Result<(), EncodingError> {
        if let Some(out) = self.out.take() {
            let mut encoder = Encoder::new(out, pixels.width, pixels.height);
            encoder.set_color(ColorType::Rgba);
            encoder.set_depth(BitDepth::Eight);
            encoder.set_compression(Compression::Balanced);
            encoder.set_animated(self.frames, 0)?;
            encoder.set_frame_delay(delay, TIME_UNITS_PER_SECOND)?;
            encoder.set_blend_op(BlendOp::Source)?;
            encoder.set_dispose_op(DisposeOp::None)?;
            self.writer = Some(encoder.write_header()?);
        }
        let Some(writer) = &mut self.writer else { return Ok(()) };
        if self.before.is_some() {
            // The encoder refuses a frame that temporarily exceeds the picture.
            writer.reset_frame_position()?;
            writer.set_frame_dimension(changed.width, changed.height)?;
            writer.set_frame_position(changed.left, changed.top)?;
            writer.set_frame_delay(delay, TIME_UNITS_PER_SECOND)?;
        }
        let rows: Vec<u8> = changed.rows(pixels).flatten().copied().collect();
        writer.write_image_data(&rows)
    }

    /// Ends the film.
    ///
    /// # Errors
    /// If the end cannot be written, or frames are missing.
    pub fn finish(self) -> Result<(), Error> {
        let writer = self.writer.ok_or_else(|| Error::new("a film needs at least one frame"))?;
        if self.written < self.frames {
            return Err(Error::new(format!("this film has {} of {} frames", self.written, self.frames)));
        }
        writer.finish().map_err(cannot_write)
    }
}

fn cannot_write(error: EncodingError) -> Error {
    match error {
        EncodingError::IoError(error) => Error::io("cannot write", error),
        error => Error::new(format!("cannot write PNG: {error}")),
    }
}
