//! Reports the shared models that tests requested and did not find. Tests run in alphabetical order, so the
//! module's name puts this report last.

use std::io::Write as _;

use crate::library::support::readers::shared_folder;

#[test]
fn missing_shared_models_are_reported() {
    if let Some(line) = shared_folder::absent() {
        // Written directly to stderr, because the test harness hides the output of print macros in passing
        // tests.
        let _ = writeln!(std::io::stderr().lock(), "\n{line}");
    }
}
