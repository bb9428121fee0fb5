//! [`Budget`]: number of faces of the next frame, so that frames stay within their time.
//!
//! Source: A. Lake, C. Marshall, M. Harris and M. Blackstein, *Stylized Rendering Techniques for Scalable
//! Real-Time 3D Animation*, NPAR 2000, section 7 and figure 19: resolution follows the time of a frame.
//!
//! Deviation: the number of faces falls at once and rises slowly, in steps, so that a level lasts.

use super::tolerances::MIN_FRAME_TIME_MS;

/// Target share of the permitted frame time. The rest absorbs variation between frames.
const TARGET_TIME_SHARE: f64 = 0.6;

/// Share of the permitted time below which a frame has room for more faces.
const SPARE_TIME_SHARE: f64 = 0.42;

/// Number of consecutive frames with room before the number of faces rises.
const SPARE_FRAMES_TO_RISE: u32 = 6;

/// Ratio of face counts between consecutive levels.
const LEVEL_FACE_RATIO: f64 = 1.25;

/// Greatest change of the number of faces in one frame, as a factor.
const MAX_CHANGE_RATIO: f64 = 4.0;

/// Least number of faces.
const MIN_FACES: f64 = 100.0;

/// Assumed speed of a machine before its first frame, faces per millisecond.
const INITIAL_FACES_PER_MS: f64 = 150.0;

/// Face budget that follows the times of frames.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Budget {
    /// Permitted time of a frame, milliseconds.
    ms: f64,
    /// Faces of the whole scene.
    total_faces: u64,
    /// Level, in steps below all faces.
    level: u32,
    /// Consecutive frames with room for more faces.
    patient: u32,
}

impl Budget {
    /// A budget for frames of `ms` milliseconds and a scene of `total_faces` faces.
    #[must_use]
    pub fn new(ms: f64, all: u64) -> Self {
        let mut budget = Self { ms, total_faces: all, level: 0, patient: 0 };
        budget.level = budget.level_of(ms * INITIAL_FACES_PER_MS);
        budget
    }

    /// Number of faces of the next frame.
    #[must_use]
    pub fn faces(&self) -> u64 {
        let faces = self.total_faces as f64
            / crate::geometry::numbers::portable_math::pow(LEVEL_FACE_RATIO, f64::from(self.level));
        (faces.max(MIN_FACES).ceil() as u64).min(self.total_faces.max(1))
    }

    /// Records the time of a frame drawn with that number of faces.
    pub fn record_frame(&mut self, ms: f64) {
        let faces = self.faces() as f64;
        if ms > self.ms * (TARGET_TIME_SHARE + SPARE_TIME_SHARE).min(0.9) {
            self.patient = 0;
            let wanted = faces * (TARGET_TIME_SHARE * self.ms / ms).max(1.0 / MAX_CHANGE_RATIO);
            self.level = self.level_of(wanted).max(self.level + 1).min(self.lowest());
        } else if ms < self.ms * SPARE_TIME_SHARE && self.level > 0 {
            self.patient += 1;
            if self.patient >= SPARE_FRAMES_TO_RISE {
                self.patient = 0;
                let wanted =
                    faces * (TARGET_TIME_SHARE * self.ms / ms.max(MIN_FRAME_TIME_MS)).min(MAX_CHANGE_RATIO);
                self.level = self.level_of(wanted).min(self.level - 1);
            }
        } else {
            self.patient = 0;
        }
    }

    /// The finest level with at most the given number of faces.
    fn level_of(&self, faces: f64) -> u32 {
        let mut level = 0;
        while level < self.lowest() && (Self { level, ..*self }).faces() as f64 > faces {
            level += 1;
        }
        level
    }

    /// The coarsest level.
    fn lowest(&self) -> u32 {
        let mut level = 0;
        while level < 200 && (Self { level, ..*self }).faces() as f64 > MIN_FACES {
            level += 1;
        }
        level
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::numbers::noise::{hash, unit_interval};

    /// Simulates frames on a machine with the given speed in faces per millisecond, with some variation.
    /// Returns faces and times.
    fn simulate_frames(budget: &mut Budget, frames: u64, speed: impl Fn(u64) -> f64) -> Vec<(u64, f64)> {
        let frame = |number: u64| {
            let faces = budget.faces();
            let ms = faces as f64 / speed(number) * (0.85 + 0.3 * unit_interval(hash(1, &[number])));
            budget.record_frame(ms);
            (faces, ms)
        };
        (0..frames).map(frame).collect()
    }

    #[test]
    fn budget_settles_within_the_frame_time_and_rarely_changes_level() {
        for speed in [20.0, 400.0, 3000.0] {
            let mut budget = Budget::new(33.0, 200_000);
            let frames = simulate_frames(&mut budget, 400, |_| speed);
            let late = &frames[60..];
            assert!(late.iter().all(|(_, ms)| *ms <= 33.0), "{speed}");
            let wanted = (speed * 33.0 * 0.3).min(200_000.0);
            assert!(late.iter().all(|(faces, _)| *faces as f64 >= wanted), "{speed}: {:?}", late[0]);
            let changes = late.windows(2).filter(|pair| pair[0].0 != pair[1].0).count();
            assert!(changes <= 4, "{speed}: {changes}");
        }
    }

    #[test]
    fn budget_drops_at_once_on_a_slow_machine_and_recovers_later() {
        let mut budget = Budget::new(33.0, 1_000_000);
        let frames =
            simulate_frames(
                &mut budget,
                300,
                |frame| if (100..150).contains(&frame) { 100.0 } else { 400.0 },
            );
        assert!(frames[104..150].iter().all(|(_, ms)| *ms < 33.0));
        assert!(frames[103].0 < frames[99].0 / 2);
        assert!(frames[299].0 > frames[149].0 * 2);
    }

    #[test]
    fn budget_of_a_small_scene_stays_at_its_face_count() {
        let mut budget = Budget::new(33.0, 60);
        assert_eq!(budget.faces(), 60);
        budget.record_frame(1e9);
        assert_eq!(budget.faces(), 60);
        assert_eq!(Budget::new(33.0, 0).faces(), 1);
    }
}
