//! [`Total`]: what all frames took and what they hold.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::cli::request::DrawRequest;
use crate::error::Error;
use crate::render::Report;
use crate::render::report::{Counts, StagesMs};

/// What all frames took and what they hold.
#[derive(Debug, Default, Serialize)]
pub(super) struct Total {
    /// Frames, and those of them that were drawn.
    pub(super) frames: u64,
    pub(super) drawings: u64,
    pub(super) fps: f64,
    pub(super) stages_ms: StagesMs,
    pub(super) counts: Counts,
    /// The most faces that each drawing might have, where that was asked for, and how long each took.
    pub(super) faces: Vec<u64>,
    pub(super) drawing_ms: Vec<f64>,
    pub(super) warnings: Vec<String>,
    /// In how many drawings there was each warning.
    #[serde(skip)]
    pub(super) warned: BTreeMap<String, usize>,
}

impl Total {
    /// Adds what a drawing took and holds.
    pub(super) fn add(&mut self, report: &Report, ms: f64) {
        self.drawings += 1;
        self.drawing_ms.push(ms);
        self.stages_ms += report.stages_ms;
        self.counts += report.counts;
        for warning in &report.warnings {
            *self.warned.entry(warning.clone()).or_default() += 1;
        }
    }
}

/// Under `--strict` warnings are errors.
pub(super) fn refuse_warnings<'a>(
    request: &DrawRequest,
    mut warnings: impl Iterator<Item = &'a String>,
) -> Result<(), Error> {
    match warnings.next().filter(|_| request.strict) {
        Some(warning) => Err(Error::new(warning.clone())
            .in_file(&request.model)
            .remedy("repair the model, or draw without --strict")),
        None => Ok(()),
    }
}
