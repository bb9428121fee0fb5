//! [`Total`]: what all frames took and what they hold.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::cli::request::draw_request::DrawRequest;
use crate::error::Error;
use crate::pipeline::Report;
use crate::pipeline::report::drawing_report::{Counts, StagesMs};

/// What all frames took and what they hold.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Total {
    /// Frames, and those of them that were drawn.
    pub(crate) frames: u64,
    pub(crate) drawings: u64,
    pub(crate) fps: f64,
    pub(crate) stages_ms: StagesMs,
    pub(crate) counts: Counts,
    /// The most faces that each drawing might have, where that was asked for, and how long each took.
    pub(crate) faces: Vec<u64>,
    pub(crate) drawing_ms: Vec<f64>,
    pub(crate) warnings: Vec<String>,
    /// In how many drawings there was each warning.
    #[serde(skip)]
    pub(crate) warned: BTreeMap<String, usize>,
}

impl Total {
    /// Adds what a drawing took and holds.
    pub(crate) fn add(&mut self, report: &Report, ms: f64) {
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
pub(crate) fn refuse_warnings<'a>(
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
