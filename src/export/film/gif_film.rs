//! Animated GIF.
//!
//! - Every frame contains only the changes since the previous one, with its own palette.
//! - GIF counts time in hundredths of a second, and browsers show a frame for at least two of them. Frames
//!   shown for less are left out, so that the film keeps its length. Whether the last frame is long enough is
//!   known only at the end, so frames are written late.
//! - A pixel is opaque or transparent. Pixels with an alpha of one half or more become opaque. If a pixel
//!   becomes transparent, the previous frame is disposed of: its rectangle is cleared, and must contain all
//!   opaque pixels.

use std::collections::VecDeque;
use std::io::Write;

use gif::{DisposalMethod, Encoder, EncodingError, Frame, Repeat};

use super::frame_difference::ChangedRect;
use super::palette::Palette;
use crate::error::Error;
use crate::export::Pixels;

/// Time units per second.
const TIME_UNITS_PER_SECOND: f64 = 100.0;

/// Shortest frame in hundredths of a second. Browsers show shorter frames for a tenth of a second.
const MIN_DELAY_HUNDREDTHS: u64 = 2;

/// Most pixels per side.
const MAX_SIDE_PIXELS: u32 = u16::MAX as u32;

/// Least alpha of a pixel that becomes opaque.
const MIN_OPAQUE_ALPHA: u8 = 128;

/// Writer of an animated GIF.
pub struct GifFilm<W: Write> {
    /// Writer, until the first frame determines the size.
    out: Option<W>,
    encoder: Option<Encoder<W>>,
    fps: f64,
    /// Ticks of all frames so far.
    ticks: u64,
    /// Frames not yet written, at most two, each with its start in hundredths of a second.
    waiting: VecDeque<(Pixels, u64)>,
    /// Canvas of the player when the next frame is drawn.
    canvas: Option<Pixels>,
    left_out: u64,
}

impl<W: Write> GifFilm<W> {
    /// Creates a film with `fps` ticks per second.
    pub fn new(out: W, fps: f64) -> Self {
        let waiting = VecDeque::new();
        Self { out: Some(out), encoder: None, fps, ticks: 0, waiting, canvas: None, left_out: 0 }
    }

    /// Adds a frame that is shown for `ticks` ticks.
    ///
    /// # Errors
    /// If it cannot be written, has another size than the first frame, or exceeds the size limit of GIF.
    pub fn push(&mut self, pixels: &Pixels, ticks: u32) -> Result<(), Error> {
        let begin = self.now();
        self.ticks += u64::from(ticks);
        if pixels.width.max(pixels.height) > MAX_SIDE_PIXELS {
            return Err(Error::new("GIF is limited to 65535 pixels per side").remedy("choose a smaller size"));
        }
        if let Some((last, at)) = self.waiting.back() {
            if [last.width, last.height] != [pixels.width, pixels.height] {
                return Err(Error::new("a frame has another size than the first"));
            }
            if begin < at + MIN_DELAY_HUNDREDTHS {
                self.left_out += 1;
                return Ok(());
            }
        }
        self.waiting.push_back((opaque_or_clear(pixels), begin));
        if self.waiting.len() > 2 { self.write_first() } else { Ok(()) }
    }

    /// Number of frames left out because they would be shown for less than two hundredths of a second.
    pub(crate) fn left_out(&self) -> u64 {
        self.left_out + u64::from(self.is_last_too_short())
    }

    /// Ends the film and returns its writer.
    ///
    /// # Errors
    /// If the end cannot be written, or there is no frame.
    pub fn finish(mut self) -> Result<W, Error> {
        if self.is_last_too_short() {
            self.waiting.pop_back();
        }
        while !self.waiting.is_empty() {
            self.write_first()?;
        }
        let encoder = self.encoder.ok_or_else(|| Error::new("a film needs at least one frame"))?;
        encoder.into_inner().map_err(cannot_write)
    }

    /// Start of the next frame in hundredths of a second.
    fn now(&self) -> u64 {
        (self.ticks as f64 / self.fps * TIME_UNITS_PER_SECOND).round() as u64
    }

    /// Whether the last waiting frame would be shown for too short a time.
    fn is_last_too_short(&self) -> bool {
        let end = self.now();
        self.waiting.len() > 1 && self.waiting.back().is_some_and(|(_, at)| end < at + MIN_DELAY_HUNDREDTHS)
    }

    /// Writes the first waiting frame.
    fn write_first(&mut self) -> Result<(), Error> {
        let end = self.now();
        let Some((now, at)) = self.waiting.pop_front() else { return Ok(()) };
        let next = self.waiting.front();
        let delay = next.map_or(end, |(_, at)| *at).saturating_sub(at);
        // After the last frame, the first one follows on an empty canvas.
        let clears = next.map_or_else(|| is_clear_somewhere(&now), |(next, _)| becomes_clear(&now, next));
        let changed = match &self.canvas {
            None => ChangedRect::whole(&now),
            Some(canvas) if clears => {
                ChangedRect::between(canvas, &now).around(ChangedRect::between(&blank(&now), &now))
            }
            Some(canvas) => ChangedRect::between(canvas, &now),
        };
        let canvas = self.canvas.take().unwrap_or_else(|| blank(&now));
        if let Some(out) = self.out.take() {
            let mut encoder =
                Encoder::new(out, now.width as u16, now.height as u16, &[]).map_err(cannot_write)?;
            encoder.set_repeat(Repeat::Infinite).map_err(cannot_write)?;
            self.encoder = Some(encoder);
        }
        let rgb = |pixel: &[u8]| <[u8; 3]>::try_from(pixel.get(..3).unwrap_or_default()).unwrap_or_default();
        let opaque = changed.rows(&now).flat_map(|row| row.chunks_exact(4)).filter(|pixel| pixel[3] > 0);
        let mut palette = Palette::of(opaque.map(rgb));
        let unchanged = palette.unchanged();
        let mut numbers = Vec::with_capacity(changed.width as usize * changed.height as usize);
        for (old, new) in changed.rows(&canvas).zip(changed.rows(&now)) {
            let pairs = old.chunks_exact(4).zip(new.chunks_exact(4));
            numbers.extend(pairs.map(|(a, b)| if a == b { unchanged } else { palette.number(rgb(b)) }));
        }
        let frame = Frame {
            delay: delay.clamp(MIN_DELAY_HUNDREDTHS, u64::from(u16::MAX)) as u16,
            dispose: if clears { DisposalMethod::Background } else { DisposalMethod::Keep },
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
        self.canvas = Some(if clears { blank(&now) } else { now });
        Ok(())
    }
}

/// Makes each pixel opaque, or transparent black.
fn opaque_or_clear(pixels: &Pixels) -> Pixels {
    let mut rgba = pixels.rgba.clone();
    for pixel in rgba.chunks_exact_mut(4) {
        if pixel[3] < MIN_OPAQUE_ALPHA {
            pixel.fill(0);
        } else {
            pixel[3] = u8::MAX;
        }
    }
    Pixels { rgba, ..*pixels }
}

/// A transparent picture of the same size.
fn blank(pixels: &Pixels) -> Pixels {
    Pixels { rgba: vec![0; pixels.rgba.len()], ..*pixels }
}

fn is_clear_somewhere(pixels: &Pixels) -> bool {
    pixels.rgba.chunks_exact(4).any(|pixel| pixel[3] == 0)
}

/// Whether some opaque pixel is transparent in the next picture.
fn becomes_clear(now: &Pixels, next: &Pixels) -> bool {
    now.rgba.chunks_exact(4).zip(next.rgba.chunks_exact(4)).any(|(a, b)| a[3] > 0 && b[3] == 0)
}

fn cannot_write(error: EncodingError) -> Error {
    match error {
        EncodingError::Io(error) => Error::io("cannot write", error),
        error => Error::new(format!("cannot write GIF: {error}")),
    }
}
