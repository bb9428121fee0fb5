//! [`Timeline`]: the frames of a film, their times in seconds, and the frames that are drawn.
//!
//! Frames are numbered from 0 and have equal length. With a hold of `n`, every `n`-th frame is drawn and
//! shown for `n` frames (animation "on twos", "on threes").

use super::tolerances::MAX_SPAN_ROUNDING_FRAMES;
use crate::error::Error;

/// Maximum number of frames: 11.5 hours at 24 frames per second.
const MAX_FRAMES: f64 = 1e6;

/// Frames of equal length. Some repeat the drawing of the frame before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timeline {
    /// Time of the first frame, seconds.
    from: f64,
    /// Frames per second.
    fps: f64,
    /// Number of frames.
    frames: usize,
    /// Number of frames that each drawing is shown.
    hold: usize,
}

impl Timeline {
    /// Frames between two times in seconds, `fps` per second.
    ///
    /// The first frame is at the start. No frame is at the end, so that a cyclic clip loops. If the times are
    /// equal, there is one frame.
    ///
    /// # Errors
    /// If a time is not finite, the end is before the start, there are too many frames, or the rate is not in
    /// (0, 1000].
    pub fn between(from: f64, to: f64, fps: f64) -> Result<Self, Error> {
        if !(from.is_finite() && to.is_finite() && from <= to) {
            return Err(Error::new(format!(
                "the film ends at {to} s, which is not after its start at {from} s"
            ))
            .remedy("make the end later than the start"));
        }
        let frames = ((to - from) * fps - MAX_SPAN_ROUNDING_FRAMES).ceil().max(1.0);
        if frames > MAX_FRAMES {
            return Err(Error::new(format!("{frames} frames are too many"))
                .remedy("draw a shorter time, or fewer frames per second"));
        }
        Self::of_frames(frames as usize, from, fps)
    }

    /// A given number of frames, starting at a time in seconds.
    ///
    /// # Errors
    /// If there are no frames or too many, the time is not finite, or the rate is not in (0, 1000].
    pub fn of_frames(frames: usize, from: f64, fps: f64) -> Result<Self, Error> {
        if !(fps > 0.0 && fps <= 1000.0) {
            return Err(Error::new(format!("{fps} is not a usable number of frames per second"))
                .remedy("give a number above 0, at most 1000"));
        }
        if frames == 0 || frames as f64 > MAX_FRAMES || !from.is_finite() {
            return Err(Error::new(format!("{frames} frames cannot be drawn"))
                .remedy("give a number from 1 to a million"));
        }
        Ok(Self { from, fps, frames, hold: 1 })
    }

    /// The same timeline with each drawing shown for several frames.
    #[must_use]
    pub fn holding(self, frames: usize) -> Self {
        Self { hold: frames.max(1), ..self }
    }

    /// Number of frames.
    #[must_use]
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// Frames per second.
    #[must_use]
    pub fn fps(&self) -> f64 {
        self.fps
    }

    /// Number of frames that each drawing is shown.
    #[must_use]
    pub fn hold(&self) -> usize {
        self.hold
    }

    /// The frames that are drawn, in order. The others repeat the drawing before them.
    pub fn drawn_frames(&self) -> impl Iterator<Item = usize> + use<> {
        (0..self.frames).step_by(self.hold)
    }

    /// The drawn frame whose drawing is shown in `frame`.
    #[must_use]
    pub fn drawn_frame(&self, frame: usize) -> usize {
        frame - frame % self.hold
    }

    /// Number of frames that show the drawing of frame `drawn`; fewer than the hold at the end of the film.
    #[must_use]
    pub fn repeat_count(&self, drawn: usize) -> usize {
        self.hold.min(self.frames.saturating_sub(drawn))
    }

    /// Time of a frame in seconds.
    #[must_use]
    pub fn time(&self, frame: usize) -> f64 {
        self.from + frame as f64 / self.fps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn timeline_excludes_its_end_and_holding_repeats_frames() -> Result<(), Error> {
        for (to, fps, frames) in [(4.0, 12.0, 48), (0.1, 30.0, 3), (0.0, 24.0, 1), (1.01, 10.0, 11)] {
            let timeline = Timeline::between(0.0, to, fps)?;
            assert_eq!(timeline.frames(), frames, "{to} s");
        }
        let timeline = Timeline::between(-1.0, 0.0, 10.0)?.holding(3);
        assert_eq!(timeline.drawn_frames().collect::<Vec<_>>(), [0, 3, 6, 9]);
        assert_eq!(
            (0..10).map(|frame| timeline.drawn_frame(frame)).collect::<Vec<_>>(),
            [0, 0, 0, 3, 3, 3, 6, 6, 6, 9]
        );
        assert_eq!((timeline.repeat_count(6), timeline.repeat_count(9)), (3, 1));
        assert!((timeline.time(9) + 0.1).abs() < 1e-12);
        Ok(())
    }

    #[test]
    fn timeline_rejects_invalid_times_and_frame_rates() {
        for (from, to, fps) in [
            (0.0, -1.0, 12.0),
            (f64::NAN, 1.0, 12.0),
            (0.0, f64::INFINITY, 12.0),
            (0.0, 1.0, 0.0),
            (0.0, 1.0, f64::NAN),
            (0.0, 1e9, 1000.0),
        ] {
            assert!(Timeline::between(from, to, fps).is_err(), "{from} {to} {fps}");
        }
        assert!(Timeline::of_frames(0, 0.0, 12.0).is_err());
    }
}
