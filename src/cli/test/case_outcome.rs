//! [`CaseOutcome`]: drawing of a case, compared with the approved drawing.

use std::path::Path;

use super::test_case::{CaseSettings, CaseSubject, TestCase};
use crate::cli::draw::model_drawing;
use crate::cli::options::step_args::StepArgs;
use crate::cli::step::open_other;
use crate::diff::{self, Diff, DiffOptions, Picture, Tolerances, View};
use crate::error::Error;
use crate::export::SvgOptions;
use crate::page::PageFile;
use crate::pipeline::Stopwatch;

/// Result of a case.
#[derive(Debug)]
pub(crate) enum CaseVerdict {
    /// The drawing matches within the tolerance.
    Passed,
    /// The drawing differs.
    Differs(Box<Diff>),
    /// No drawing is approved yet.
    New,
    /// The case cannot be drawn or compared.
    Error(Error),
}

impl CaseVerdict {
    /// Word for the result.
    pub(crate) fn word(&self) -> &'static str {
        match self {
            Self::Passed => "passed",
            Self::Differs(_) => "differs",
            Self::New => "new",
            Self::Error(_) => "error",
        }
    }
}

/// Case after drawing and comparing.
#[derive(Debug)]
pub(crate) struct CaseOutcome<'a> {
    pub(crate) case: &'a TestCase,
    pub(crate) verdict: CaseVerdict,
    /// Approved drawing, if it exists.
    pub(crate) before: Option<String>,
    /// Current drawing, if it could be made.
    pub(crate) after: Option<String>,
    pub(crate) seconds: f64,
}

/// Draws the single page of a page file as SVG.
fn page(file: &Path) -> Result<Vec<u8>, Error> {
    let pages =
        PageFile::open(file)?.reading_models(|path| open_other(path, &StepArgs::default())).compose()?;
    match pages.as_slice() {
        [page] => Ok(page.composition.to_svg(&SvgOptions::default()).into_bytes()),
        pages => Err(Error::new(format!("it has {} pages, and a case compares one", pages.len()))
            .in_file(file)
            .remedy("write a page file for each page")),
    }
}

impl<'a> CaseOutcome<'a> {
    /// Draws a case and compares it with the approved drawing.
    pub(crate) fn of(case: &'a TestCase, tolerances: &Tolerances) -> Self {
        let watch = Stopwatch::start();
        let mut outcome = Self { case, verdict: CaseVerdict::New, before: None, after: None, seconds: 0.0 };
        outcome.verdict = match &case.order {
            Ok(order) => outcome.draw(order, tolerances).unwrap_or_else(CaseVerdict::Error),
            Err(error) => CaseVerdict::Error(error.clone()),
        };
        outcome.seconds = watch.seconds();
        outcome
    }

    fn draw(&mut self, order: &CaseSettings, tolerances: &Tolerances) -> Result<CaseVerdict, Error> {
        let svg = match &order.subject {
            CaseSubject::Drawing(request) => model_drawing::encode_first_output(request)?,
            CaseSubject::Page(file) => page(file)?,
        };
        let after = self.after.insert(String::from_utf8_lossy(&svg).into_owned());
        let drawing = &self.case.drawing;
        let before = match std::fs::read(drawing) {
            Ok(bytes) => self.before.insert(String::from_utf8_lossy(&bytes).into_owned()),
            Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(CaseVerdict::New),
            Err(error) => {
                return Err(Error::io("cannot read the approved drawing", error).in_file(drawing));
            }
        };
        if before == after {
            return Ok(CaseVerdict::Passed);
        }
        let unfit = |error: Error| {
            error.in_file(drawing).remedy("remove the file, then approve the drawing with --bless")
        };
        let before = Picture::from_svg(before).map_err(unfit)?;
        let after = Picture::from_svg(after)?;
        let tolerances = tolerances.clone().with(order.tolerances.clone());
        let diff = diff::compare(&before, &after, &DiffOptions { tolerances, ..DiffOptions::default() });
        Ok(if diff.is_same() { CaseVerdict::Passed } else { CaseVerdict::Differs(Box::new(diff)) })
    }

    /// Difference picture as SVG, if the drawing differs.
    pub(crate) fn difference(&self) -> Option<String> {
        match &self.verdict {
            CaseVerdict::Differs(diff) => Some(diff.picture(View::Over).to_svg(&SvgOptions::default())),
            _ => None,
        }
    }

    /// One-line summary. If `blessed`, differing and new drawings were approved.
    pub(crate) fn summary(&self, blessed: bool) -> String {
        match &self.verdict {
            CaseVerdict::New if blessed => "drawn for the first time".to_owned(),
            CaseVerdict::Passed => String::new(),
            CaseVerdict::Differs(diff) => diff.summary(),
            CaseVerdict::New => format!("{} is not approved yet", self.case.drawing.display()),
            CaseVerdict::Error(error) => error.to_string(),
        }
    }

    /// Differences, one line each.
    pub(crate) fn lines(&self) -> Vec<String> {
        match &self.verdict {
            CaseVerdict::Differs(diff) => diff.lines(),
            _ => Vec::new(),
        }
    }
}

/// Number of cases with each result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) struct CaseTotals {
    pub(crate) passed: usize,
    pub(crate) differ: usize,
    pub(crate) new: usize,
    pub(crate) errors: usize,
}

impl CaseTotals {
    /// Counts the results.
    pub(crate) fn of(outcomes: &[CaseOutcome<'_>]) -> Self {
        let mut totals = Self::default();
        for outcome in outcomes {
            match outcome.verdict {
                CaseVerdict::Passed => totals.passed += 1,
                CaseVerdict::Differs(_) => totals.differ += 1,
                CaseVerdict::New => totals.new += 1,
                CaseVerdict::Error(_) => totals.errors += 1,
            }
        }
        totals
    }

    /// Summary line: `12 cases: 10 passed, 1 differs, 1 is new`
    pub(crate) fn line(self, blessed: bool) -> String {
        let Self { passed, differ, new, errors } = self;
        let cases = passed + differ + new + errors;
        let mut parts = vec![format!("{passed} passed")];
        let mut count = |n: usize, one: &str, many: &str| {
            if n > 0 {
                parts.push(format!("{n} {}", if n == 1 { one } else { many }));
            }
        };
        if blessed {
            count(differ + new, "blessed", "blessed");
        } else {
            count(differ, "differs", "differ");
            count(new, "is new", "are new");
        }
        count(errors, "cannot be drawn", "cannot be drawn");
        format!("{cases} {}: {}", if cases == 1 { "case" } else { "cases" }, parts.join(", "))
    }
}
