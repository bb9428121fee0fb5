//! Numbers from 0 to 1, as style sheets write them.

use serde::de::Error as _;
use serde::{Deserialize, Deserializer};

/// Reads a number from 0 to 1.
pub(crate) fn fraction<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<f64>, D::Error> {
    let value = f64::deserialize(deserializer)?;
    if (0.0..=1.0).contains(&value) {
        Ok(Some(value))
    } else {
        Err(D::Error::custom(format!("{value} is not a fraction; write a number from 0 to 1")))
    }
}
