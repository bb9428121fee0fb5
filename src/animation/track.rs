//! [`Track`]: an animated property as keyframes: its values at key times, interpolated between them.
//!
//! Source: Khronos Group, glTF 2.0 specification, appendix C (interpolation modes).

use glam::DQuat;

use super::tolerances;
use crate::geometry::numbers::portable_math::{atan2, sin};

/// Interpolation between two keys.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Interpolation {
    /// Linear; rotations by spherical linear interpolation along the shorter arc.
    #[default]
    Linear,
    /// Constant: the earlier key up to the next.
    Step,
    /// Cubic Hermite spline with an incoming and an outgoing tangent at each key.
    CubicSpline,
}

/// Keyframes of one animated property: one or several numbers per key.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Track {
    /// Times of the keys, seconds.
    times: Vec<f64>,
    /// Values of all keys in order; in cubic tracks with a tangent before and after each value.
    values: Vec<f64>,
    /// Numbers per value, such as 3 for a translation.
    width: usize,
    interpolation: Interpolation,
}

impl Track {
    /// Creates a track with keys at `times`, in seconds and not decreasing. The numbers per value follow
    /// from the lengths. A cubic track has incoming tangent, value and outgoing tangent for each key.
    ///
    /// # Errors
    /// Describes what is wrong with the keys.
    pub(crate) fn new(
        times: Vec<f64>,
        values: Vec<f64>,
        interpolation: Interpolation,
    ) -> Result<Self, String> {
        let keys = times.len();
        if keys == 0 {
            return Err("it has no keys".to_owned());
        }
        if let Some(k) = times.iter().position(|time| !time.is_finite()) {
            return Err(format!("the time of key {k} is not a number"));
        }
        if let Some(k) = times.array_windows().position(|[a, b]| b < a) {
            return Err(format!("key {} is earlier than the one before it", k + 1));
        }
        let a_key = if interpolation == Interpolation::CubicSpline { 3 } else { 1 };
        let width = values.len() / keys / a_key;
        if width == 0 || width * keys * a_key != values.len() {
            return Err(format!("{} numbers for {keys} keys", values.len()));
        }
        if let Some(k) = values.iter().position(|value| !value.is_finite()) {
            return Err(format!("key {} has a value that is not a number", k / width / a_key));
        }
        Ok(Self { times, values, width, interpolation })
    }

    /// Numbers per value.
    #[must_use]
    pub(crate) const fn width(&self) -> usize {
        self.width
    }

    /// Times of the keys, in seconds.
    #[must_use]
    pub(crate) fn times(&self) -> &[f64] {
        &self.times
    }

    /// Values at a time, clamped to the first and last key.
    #[must_use]
    pub(crate) fn at(&self, time: f64) -> Vec<f64> {
        match self.between(time) {
            (k, None) => self.value(k).to_vec(),
            (k, Some((share, span))) => self.blend(k, share, span),
        }
    }

    /// Rotation at a time, for a track of quaternions (x, y, z, w); `None` if the values are not a rotation.
    #[must_use]
    pub(crate) fn rotation_at(&self, time: f64) -> Option<DQuat> {
        let quaternion = |values: &[f64]| <[f64; 4]>::try_from(values).ok().and_then(unit_quaternion);
        match self.between(time) {
            (k, Some((share, _))) if self.interpolation == Interpolation::Linear => {
                Some(slerp(quaternion(self.value(k))?, quaternion(self.value(k + 1))?, share))
            }
            _ => quaternion(&self.at(time)),
        }
    }

    /// Last key at or before a time. If the time lies between two keys, also the share of the way to the next
    /// key, and the duration between them in seconds.
    fn between(&self, time: f64) -> (usize, Option<(f64, f64)>) {
        let after = self.times.partition_point(|key| *key <= time);
        let Some(k) = after.checked_sub(1) else { return (0, None) };
        let Some(next) = self.times.get(after) else { return (k, None) };
        let span = next - self.times[k];
        (k, Some(((time - self.times[k]) / span, span)))
    }

    fn value(&self, key: usize) -> &[f64] {
        let (place, a_key) = if self.interpolation == Interpolation::CubicSpline { (1, 3) } else { (0, 1) };
        self.numbers(key * a_key + place)
    }

    fn numbers(&self, place: usize) -> &[f64] {
        self.values.get(place * self.width..(place + 1) * self.width).unwrap_or_default()
    }

    fn blend(&self, key: usize, s: f64, span: f64) -> Vec<f64> {
        let (from, to) = (self.value(key), self.value(key + 1));
        match self.interpolation {
            Interpolation::Step => from.to_vec(),
            Interpolation::Linear => from.iter().zip(to).map(|(a, b)| a + (b - a) * s).collect(),
            Interpolation::CubicSpline => {
                let (out, into) = (self.numbers(key * 3 + 2), self.numbers(key * 3 + 3));
                let (s2, s3) = (s * s, s * s * s);
                let (of_from, of_to) = (2.0 * s3 - 3.0 * s2 + 1.0, 3.0 * s2 - 2.0 * s3);
                let (of_out, of_into) = (span * (s3 - 2.0 * s2 + s), span * (s3 - s2));
                (0..self.width)
                    .map(|i| of_from * from[i] + of_out * out[i] + of_to * to[i] + of_into * into[i])
                    .collect()
            }
        }
    }
}

/// Normalises a quaternion to a rotation; `None` if its length is near zero.
#[must_use]
pub(crate) fn unit_quaternion(xyzw: [f64; 4]) -> Option<DQuat> {
    let length = xyzw.iter().map(|v| v * v).sum::<f64>().sqrt();
    // Files round the components. Other viewers normalise quaternions of any length as well.
    (length.is_finite() && length > tolerances::MIN_QUATERNION_LENGTH)
        .then(|| DQuat::from_array(xyzw.map(|v| v / length)))
}

/// Spherical linear interpolation along the shorter arc.
fn slerp(from: DQuat, to: DQuat, share: f64) -> DQuat {
    let to = if from.dot(to) < 0.0 { -to } else { to };
    // Half-angle formula from chord and sum: accurate for small angles too.
    let angle = 2.0 * atan2((to - from).length(), (to + from).length());
    let whole = sin(angle);
    if whole <= f64::MIN_POSITIVE {
        return from;
    }
    (from * (sin((1.0 - share) * angle) / whole) + to * (sin(share * angle) / whole)).normalize()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn track_interpolates_linear_step_and_cubic_spline_keys() {
        let track = |values: &[f64], interpolation| {
            Track::new(vec![1.0, 3.0], values.to_vec(), interpolation).unwrap()
        };
        let linear = track(&[0.0, 10.0, 4.0, 30.0], Interpolation::Linear);
        assert_eq!([0.0, 1.0, 1.5, 3.0, 9.0].map(|t| linear.at(t)[0]), [0.0, 0.0, 1.0, 4.0, 4.0]);
        assert_eq!(linear.at(2.0), [2.0, 20.0]);
        let step = track(&[5.0, 6.0], Interpolation::Step);
        assert_eq!([0.0, 2.999, 3.0].map(|t| step.at(t)[0]), [5.0, 5.0, 6.0]);
        // t² with its tangents is reproduced exactly.
        let square = track(&[0.0, 1.0, 2.0, 6.0, 9.0, 0.0], Interpolation::CubicSpline);
        for t in [1.0, 1.3, 2.0, 2.9, 3.0] {
            assert!((square.at(t)[0] - t * t).abs() < 1e-12, "{t}");
        }
    }

    #[test]
    fn track_rotations_take_the_shorter_arc_at_constant_speed() {
        let rotation_about_y = |degrees: f64| {
            let half = degrees.to_radians() / 2.0;
            [0.0, sin(half), 0.0, crate::geometry::numbers::portable_math::cos(half)]
        };
        let keys = |b: [f64; 4]| [rotation_about_y(20.0), b].concat();
        for to in [rotation_about_y(80.0), rotation_about_y(80.0).map(|v| -v)] {
            let track = Track::new(vec![0.0, 1.0], keys(to), Interpolation::Linear).unwrap();
            for fraction in [0.0, 0.25, 0.5, 0.9, 1.0] {
                let (interpolated, right) =
                    (track.rotation_at(fraction).unwrap(), rotation_about_y(20.0 + 60.0 * fraction));
                assert!(interpolated.dot(DQuat::from_array(right)).abs() > 1.0 - 1e-12, "{fraction}");
            }
        }
        let same = Track::new(vec![0.0, 1.0], keys(rotation_about_y(20.0)), Interpolation::Linear).unwrap();
        assert!(same.rotation_at(0.5).unwrap().dot(DQuat::from_array(rotation_about_y(20.0))) > 1.0 - 1e-12);
        let none = Track::new(vec![0.0], vec![0.0; 4], Interpolation::Linear).unwrap();
        assert!(none.rotation_at(0.0).is_none());
    }

    #[test]
    fn track_errors_describe_invalid_keys() {
        let new = |times: &[f64], values: &[f64]| {
            Track::new(times.to_vec(), values.to_vec(), Interpolation::Linear).map(|_| ()).unwrap_err()
        };
        assert_eq!(new(&[], &[]), "it has no keys");
        assert_eq!(new(&[0.0, f64::NAN], &[1.0, 1.0]), "the time of key 1 is not a number");
        assert_eq!(new(&[1.0, 0.0], &[1.0, 1.0]), "key 1 is earlier than the one before it");
        assert_eq!(new(&[0.0, 1.0], &[1.0, 1.0, 2.0]), "3 numbers for 2 keys");
        assert_eq!(new(&[0.0, 1.0], &[1.0, f64::INFINITY]), "key 1 has a value that is not a number");
    }

    #[test]
    fn track_jumps_between_two_keys_of_equal_time() {
        let track = Track::new(vec![0.0, 1.0, 1.0, 2.0], vec![0.0, 1.0, 5.0, 6.0], Interpolation::Linear);
        let track = track.unwrap();
        assert_eq!([0.5, 1.0, 1.5].map(|t| track.at(t)[0]), [0.5, 5.0, 5.5]);
    }
}
