//! [`AnimationTotals`]: times, counts and warnings summed over all frames.

use std::collections::BTreeMap;

use serde::Serialize;

use crate::cli::request::draw_request::DrawRequest;
use crate::error::Error;
use crate::pipeline::Report;
use crate::pipeline::report::drawing_report::{Counts, StagesMs};

/// Times, counts and warnings of an animation. The report is this structure as JSON.
#[derive(Debug, Default, Serialize)]
pub(crate) struct AnimationTotals {
    /// Number of frames, and of distinct drawings.
    pub(crate) frames: u64,
    pub(crate) drawings: u64,
    pub(crate) fps: f64,
    pub(crate) stages_ms: StagesMs,
    pub(crate) counts: Counts,
    /// Face limit of each drawing, if there is one, and drawing time of each in ms.
    pub(crate) faces: Vec<u64>,
    pub(crate) drawing_ms: Vec<f64>,
    pub(crate) warnings: Vec<String>,
    /// Number of drawings with each warning.
    #[serde(skip)]
    pub(crate) warned: BTreeMap<String, usize>,
}

impl AnimationTotals {
    /// Adds the report of one drawing.
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

/// Turns the first warning into an error under `--strict`.
pub(crate) fn refuse_warnings<'a>(
    request: &DrawRequest,
    mut warnings: impl Iterator<Item = &'a String>,
) -> Result<(), Error> {
    match warnings.next().filter(|_| request.how.strict) {
        Some(warning) => Err(Error::new(warning.clone())
            .in_file(&request.model)
            .remedy("repair the model, or draw without --strict")),
        None => Ok(()),
    }
}
