//! [`GifFilm`]: frames as an animated GIF.
//!
//! Every frame holds only what changed since the one before, in a palette of its own. GIF knows no half clear pixels: what has no
//! background is put on white.

use std::io::Write;

use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use super::changed::Changed;
use super::pace::Pace;
use super::palette::Palette;
use crate::error::Error;
use crate::export::Pixels;

/// Units of time a second.
const PER_SECOND: f64 = 100.0;

/// Shorter than two hundredths of a second browsers show a frame for a tenth.
const SHORTEST: u32 = 2;

/// Most pixels a side.
const LONGEST_SIDE: u32 = u16::MAX as u32;

/// Writes an animated GIF.
pub struct GifFilm<W: Write> {
    /// Until the first frame tells the size.
    out: Option<W>,
    encoder: Option<Encoder<W>>,
    pace: Pace,
    before: Option<Pixels>,
}

impl<W: Write> GifFilm<W> {
    /// A film of so many ticks a second.
    pub fn new(out: W, fps: f64) -> Self {
        Self { out: Some(out), encoder: None, pace: Pace::new(fps), before: None }
    }

    /// Adds a frame that is shown for so many ticks.
    ///
    /// # Errors
    /// If it cannot be written, if it is of another size than the first, or larger than the format allows.
    pub fn push(&mut self, pixels: &Pixels, ticks: u32) -> Result<(), Error> {
        let now = pixels.on_white();
        if now.width.max(now.height) > LONGEST_SIDE {
            return Err(Error::new("GIF holds no more than 65535 pixels a side").remedy("draw smaller"));
        }
        let changed = match &self.before {
            Some(before) if [before.width, before.height] != [now.width, now.height] => {
                return Err(Error::new("a frame is of another size than the first"));
            }
            Some(before) => Changed::between(before, &now),
            None => Changed::whole(&now),
        };
        if let Some(out) = self.out.take() {
            let mut encoder =
                Encoder::new(out, now.width as u16, now.height as u16, &[]).map_err(cannot_write)?;
            encoder.set_repeat(Repeat::Infinite).map_err(cannot_write)?;
            self.encoder = Some(encoder);
        }
        let rgb = |pixel: &[u8]| <[u8; 3]>::try_from(pixel.get(..3).unwrap_or_default()).unwrap_or_default();
        let mut palette = Palette::of(changed.rows(&now).flat_map(|row| row.chunks_exact(4)).map(rgb));
        let unchanged = palette.unchanged();
        let mut numbers = Vec::with_capacity(changed.width as usize * changed.height as usize);
        match &self.before {
            Some(before) => {
                for (old, new) in changed.rows(before).zip(changed.rows(&now)) {
                    let pairs = old.chunks_exact(4).zip(new.chunks_exact(4));
                    numbers
                        .extend(pairs.map(|(a, b)| if a == b { unchanged } else { palette.number(rgb(b)) }));
                }
            }
            None => {
                for row in changed.rows(&now) {
                    numbers.extend(row.chunks_exact(4).map(|pixel| palette.number(rgb(pixel))));
                }
            }
        }
        let frame = Frame {
            delay: self.pace.next(ticks, PER_SECOND).clamp(SHORTEST, u32::from(u16::MAX)) as u16,
            dispose: DisposalMethod::Keep,
            transparent: Some(unchanged),
            top: changed.top as u16,
            left: changed.left as u16,
            width: changed.width as u16,
            height: changed.height as u16,
            palette: Some(palette.bytes()),
            buffer: numbers.into(),
            ..Frame::default()
        };
        if let Some(encoder) = &mut self.encoder {
            encoder.write_frame(&frame).map_err(cannot_write)?;
        }
        self.before = Some(now);
        Ok(())
    }

    /// Ends the film and gives back what it was written to.
    ///
    /// # Errors
    /// If the end cannot be written, or if there is no frame.
    pub fn finish(self) -> Result<W, Error> {
        let encoder = self.encoder.ok_or_else(|| Error::new("a film needs a frame"))?;
        encoder.into_inner().map_err(cannot_write)
    }
}

fn cannot_write(error: EncodingError) -> Error {
    match error {
        EncodingError::Io(error) => Error::io("cannot write", error),
        error => Error::new(format!("cannot write GIF: {error}")),
    }
}
