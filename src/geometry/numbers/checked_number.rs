//! Numbers of style sheets and option files that must pass a check.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

/// Reads a number, and fails with the number and a complaint unless it is valid.
pub(crate) fn checked<'de, D: Deserializer<'de>>(
    deserializer: D,
    is_valid: impl Fn(f64) -> bool,
    complaint: &str,
) -> Result<f64, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if is_valid(value) { Ok(value) } else { Err(D::Error::custom(format!("{value} {complaint}"))) }
}

/// Reads a number from 0 to 1, called a share in the error.
pub(crate) fn share<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    checked(deserializer, |value| (0.0..=1.0).contains(&value), "is not a share; write a number from 0 to 1")
}

/// Reads a number from 0 to 1, called a fraction in the error.
pub(crate) fn fraction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<f64, D::Error> {
    let advice = "is not a fraction; write a number from 0 to 1";
    checked(deserializer, |value| (0.0..=1.0).contains(&value), advice)
}

/// Like [`fraction`], for a number that may be missing.
pub(crate) fn some_fraction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    fraction(deserializer).map(Some)
}
