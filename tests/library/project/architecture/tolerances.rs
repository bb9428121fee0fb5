//! Small numbers are constants with a comment in the `tolerances.rs` of their area, and nowhere else.

use super::{Source, sources};

/// Whether a line of code has a float literal with a negative exponent, or an `EPSILON`.
fn has_small_number(line: &str) -> bool {
    let is_exponent = |at: usize| {
        let before = line[..at].chars().next_back();
        let after = line[at + 2..].chars().next();
        before.is_some_and(|c| c.is_ascii_digit() || c == '.' || c == '_')
            && after.is_some_and(|c| c.is_ascii_digit())
    };
    line.match_indices("e-").any(|(at, _)| is_exponent(at)) || line.contains("::EPSILON")
}

fn is_tolerance_file(source: &Source) -> bool {
    source.path.file_name().is_some_and(|name| name == "tolerances.rs")
}

#[test]
fn small_numbers_are_found() {
    assert!(has_small_number("if length < 1e-9 {") && has_small_number("const A: f32 = 5.000_001e-9;"));
    assert!(has_small_number("x > f64::EPSILON"));
    assert!(!has_small_number("let tone-e-4 = 1e9 - 3.0;") && !has_small_number("use a::some-thing"));
}

#[test]
fn small_numbers_stand_in_files_of_tolerances() {
    let mut faults = Vec::new();
    for source in sources().iter().filter(|s| !s.is_test() && !is_tolerance_file(s)) {
        for (number, line) in source.code() {
            if has_small_number(line) {
                faults.push(format!("{}:{number}: {}", source.name(), line.trim()));
            }
        }
    }
    assert!(faults.is_empty(), "small numbers outside of tolerances.rs:\n{}", faults.join("\n"));
}

#[test]
fn tolerances_have_a_reason() {
    let sources = sources();
    let files: Vec<&Source> = sources.iter().filter(|s| is_tolerance_file(s)).collect();
    assert!(files.len() > 10, "{} files of tolerances", files.len());
    for source in files {
        let mut before = "";
        for line in source.text.lines() {
            let is_constant =
                line.trim_start_matches("pub(crate) ").trim_start_matches("pub ").starts_with("const ");
            let is_explained = before.starts_with("///") || before.starts_with("#[");
            assert!(!is_constant || is_explained, "{}: no comment: {line}", source.name());
            before = line.trim();
        }
    }
}
