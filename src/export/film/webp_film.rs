//! Animated WebP, exact and with transparency.
//!
//! Source: WebP container specification, developers.google.com/speed/webp/docs/riff_container. The file has
//! `VP8X`, `ANIM`, and for each frame an `ANMF` with a still picture without its outermost header.

use image_webp::{ColorType, WebPEncoder};

use super::frame_clock::FrameClock;
use super::frame_difference::ChangedRect;
use crate::error::Error;
use crate::export::Pixels;

/// Time units per second.
const TIME_UNITS_PER_SECOND: f64 = 1000.0;

/// Most pixels per side.
const MAX_SIDE_PIXELS: u32 = 16_384;

/// Length of the outermost header of a still picture: `RIFF`, its length, `WEBP`.
const RIFF_HEADER_BYTES: usize = 12;

/// Flags of `VP8X`: animation and alpha.
const ANIMATION_AND_ALPHA_FLAGS: u8 = 0x02 | 0x10;

/// Flags of `ANMF`: pixels replace the canvas without blending, and are not disposed of.
const NO_BLEND_FLAG: u8 = 0x02;

/// Writer of an animated WebP.
pub struct WebpFilm {
    /// All chunks after the outermost header.
    chunks: Vec<u8>,
    pace: FrameClock,
    before: Option<Pixels>,
}

impl WebpFilm {
    /// Creates a film with `fps` ticks per second.
    #[must_use]
    pub fn new(fps: f64) -> Self {
        Self { chunks: Vec::new(), pace: FrameClock::new(fps), before: None }
    }

    /// Adds a frame that is shown for `ticks` ticks.
    ///
    /// # Errors
    /// If it has another size than the first frame, or exceeds the size limit of WebP.
    pub fn push(&mut self, pixels: &Pixels, ticks: u32) -> Result<(), Error> {
        if pixels.width.max(pixels.height) > MAX_SIDE_PIXELS {
            return Err(
                Error::new("WebP is limited to 16384 pixels per side").remedy("choose a smaller size")
            );
        }
        let changed = ChangedRect::since(self.before.as_ref(), pixels)?.even();
        if self.before.is_none() {
            let mut extended = vec![ANIMATION_AND_ALPHA_FLAGS, 0, 0, 0];
            extended.extend(low(pixels.width - 1));
            extended.extend(low(pixels.height - 1));
            self.chunk(*b"VP8X", &extended);
            // A transparent background and infinite repetition.
            self.chunk(*b"ANIM", &[0; 6]);
        }
        let rows: Vec<u8> = changed.rows(pixels).flatten().copied().collect();
        let mut still = Vec::new();
        WebPEncoder::new(&mut still)
            .encode(&rows, changed.width, changed.height, ColorType::Rgba8)
            .map_err(|error| Error::new(format!("cannot write WebP: {error}")))?;
        let mut frame = Vec::with_capacity(still.len() + 16);
        for number in [changed.left / 2, changed.top / 2, changed.width - 1, changed.height - 1] {
            frame.extend(low(number));
        }
        frame.extend(low(self.pace.next(ticks, TIME_UNITS_PER_SECOND).min(0x00ff_ffff)));
        frame.push(NO_BLEND_FLAG);
        frame.extend_from_slice(still.get(RIFF_HEADER_BYTES..).unwrap_or_default());
        self.chunk(*b"ANMF", &frame);
        self.before = Some(pixels.clone());
        Ok(())
    }

    /// Returns the film as bytes.
    ///
    /// # Errors
    /// If there is no frame, or the film exceeds the length limit of WebP.
    pub fn finish(self) -> Result<Vec<u8>, Error> {
        if self.before.is_none() {
            return Err(Error::new("a film needs at least one frame"));
        }
        let length = u32::try_from(self.chunks.len() + 4)
            .map_err(|_| Error::new("the film is longer than WebP allows").remedy("write fewer frames"))?;
        let mut file = b"RIFF".to_vec();
        file.extend(length.to_le_bytes());
        file.extend(b"WEBP");
        file.extend(self.chunks);
        Ok(file)
    }

    /// Adds a chunk, padded to an even length.
    fn chunk(&mut self, name: [u8; 4], content: &[u8]) {
        self.chunks.extend(name);
        self.chunks.extend((content.len() as u32).to_le_bytes());
        self.chunks.extend_from_slice(content);
        if content.len() % 2 == 1 {
            self.chunks.push(0);
        }
    }
}

/// The lowest three bytes of a number.
fn low(number: u32) -> [u8; 3] {
    let [a, b, c, _] = number.to_le_bytes();
    [a, b, c]
}
