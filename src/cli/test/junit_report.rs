//! Report of the test as JUnit XML, for CI services.

use std::fmt::Write;

use super::case_outcome::{CaseOutcome, CaseTotals, CaseVerdict};
use crate::export::encoding::xml::escaped;

/// Writes the document. If `blessed`, differing and new drawings were approved.
pub(crate) fn document(folder: &str, outcomes: &[CaseOutcome<'_>], blessed: bool) -> String {
    let CaseTotals { differ, new, errors, .. } = CaseTotals::of(outcomes);
    let failures = if blessed { 0 } else { differ + new };
    let seconds: f64 = outcomes.iter().map(|outcome| outcome.seconds).sum();
    let tests = outcomes.len();
    let counts =
        format!("tests=\"{tests}\" failures=\"{failures}\" errors=\"{errors}\" time=\"{seconds:.3}\"");
    let folder = escaped(folder);
    let mut xml = String::from("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n");
    let _ = writeln!(xml, "<testsuites name=\"ligne test\" {counts}>");
    let _ = writeln!(xml, "<testsuite name=\"{folder}\" {counts} skipped=\"0\">");
    for outcome in outcomes {
        let name = escaped(&outcome.case.name);
        let _ =
            write!(xml, "<testcase name=\"{name}\" classname=\"{folder}\" time=\"{:.3}\"", outcome.seconds);
        let element = match outcome.verdict {
            CaseVerdict::Error(_) => Some("error"),
            CaseVerdict::Differs(_) | CaseVerdict::New if !blessed => Some("failure"),
            _ => None,
        };
        let Some(element) = element else {
            xml.push_str("/>\n");
            continue;
        };
        let (kind, message) = (outcome.verdict.word(), escaped(&outcome.summary(blessed)));
        let _ = write!(xml, ">\n<{element} type=\"{kind}\" message=\"{message}\">");
        let lines: Vec<String> = outcome.lines().iter().map(|line| escaped(line)).collect();
        xml.push_str(&lines.join("\n"));
        let _ = writeln!(xml, "</{element}>\n</testcase>");
    }
    xml.push_str("</testsuite>\n</testsuites>\n");
    xml
}
