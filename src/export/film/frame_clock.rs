//! Display times of frames in the time unit of a format, without accumulated rounding errors.

/// Position in time of a film.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrameClock {
    fps: f64,
    /// Ticks of all frames so far.
    ticks: u64,
}

impl FrameClock {
    /// Start of a film with `fps` ticks per second.
    pub(crate) fn new(fps: f64) -> Self {
        Self { fps, ticks: 0 }
    }

    /// Display time of the next frame in units of 1/`per_second` s, at least one. `ticks` is its number of
    /// ticks.
    pub(crate) fn next(&mut self, ticks: u32, per_second: f64) -> u32 {
        let at = |ticks: u64| (ticks as f64 / self.fps * per_second).round();
        let after = self.ticks + u64::from(ticks);
        let delay = at(after) - at(self.ticks);
        self.ticks = after;
        delay.clamp(1.0, f64::from(u32::MAX)) as u32
    }

    /// Display time of all frames so far in seconds.
    pub(crate) fn seconds(&self) -> f64 {
        self.ticks as f64 / self.fps
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn frame_clock_rounding_errors_do_not_accumulate() {
        let mut pace = FrameClock::new(24.0);
        let delays: Vec<u32> = (0..24).map(|_| pace.next(1, 100.0)).collect();
        assert_eq!(delays.iter().sum::<u32>(), 100);
        assert!(delays.iter().all(|delay| (4..=5).contains(delay)));
        assert!((pace.seconds() - 1.0).abs() < 1e-12);
    }
}
