//! The command-line reference in `docs/reference` equals the generated page.

use std::fs;
use std::path::Path;

use crate::folder::TestFolder;

#[test]
fn command_line_reference_is_current() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/reference/command-line.md");
    let page = TestFolder::new("reference").ligne("man --markdown").expect_success().out.clone();
    let written = fs::read_to_string(&path).unwrap_or_default().replace("\r\n", "\n");
    let difference = page.lines().zip(written.lines()).find(|(new, old)| new != old);
    assert!(
        page == written,
        "docs/reference/command-line.md is out of date; renew it with\n\n    \
         cargo run -- man --markdown > docs/reference/command-line.md\n\nfirst difference: {difference:?}"
    );
}
