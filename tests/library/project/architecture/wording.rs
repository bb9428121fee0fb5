//! Names of modules and constants state what they are, and comments are in plain words.
//!
//! `docs/dev/style-guide.md` explains the rules.

use super::{Source, sources, sources_in};
use crate::library::support::plain_words::{self, TextStatistics};

/// Module names that state neither a product nor an algorithm.
const EMPTY_MODULE_NAMES: [&str; 40] = [
    "ahead",
    "asked",
    "aside",
    "asks",
    "at_rest",
    "before",
    "behind",
    "beside",
    "between",
    "beyond",
    "drawn",
    "found",
    "hidden",
    "inked",
    "kept",
    "known",
    "late",
    "leaning",
    "looks",
    "made",
    "marking",
    "nook",
    "offered",
    "on_page",
    "on_surface",
    "on_view",
    "painted",
    "places",
    "resting",
    "said",
    "seen",
    "shown",
    "sides",
    "teller",
    "told",
    "under",
    "utils",
    "varied",
    "welded",
    "wish",
];

/// Constants that begin with one of these words name no quantity.
const EMPTY_CONSTANT_WORDS: [&str; 29] = [
    "MOST", "FEW", "FEWEST", "ALIKE", "SAME", "FAR", "FARTHEST", "WIDE", "WIDEST", "LONG", "LONGEST",
    "MEANT", "NEAR", "NEAREST", "SURE", "MANY", "LEAST", "ENOUGH", "CLEAR", "AGAIN", "WHOLE", "EVEN",
    "UNEVEN", "APART", "LARGE", "SMALL", "FINE", "COARSE", "LARGEST",
];

/// Limits for all comments of a folder together. kurbo has 0.5 phrases per 1,000 words, ripgrep 1.4.
const MAX_MEAN_WORDS: f64 = 13.0;
const MAX_LONG_SHARE: f64 = 0.02;
const MAX_PHRASES_PER_1000: f64 = 0.5;

/// Constants that a line declares.
fn constant_in(line: &str) -> Option<&str> {
    let (_, rest) = line.split_once("const ").filter(|(before, _)| !before.contains('"'))?;
    let (name, _) = rest.split_once(':')?;
    name.chars().all(|c| c.is_ascii_uppercase() || c.is_ascii_digit() || c == '_').then_some(name)
}

#[test]
fn modules_and_constants_have_names_that_say_what_they_are() {
    let mut faults = Vec::new();
    for source in sources() {
        let names = source.path.iter().map(|name| name.to_string_lossy().trim_end_matches(".rs").to_owned());
        for name in names.filter(|name| EMPTY_MODULE_NAMES.contains(&name.as_str())) {
            faults.push(format!("{}: module {name}", source.name()));
        }
        for name in source.text.lines().filter_map(constant_in) {
            if name.split('_').next().is_some_and(|word| EMPTY_CONSTANT_WORDS.contains(&word)) {
                faults.push(format!("{}: constant {name}", source.name()));
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// Blocks of comments, without code examples, tables and code in backticks.
fn comments(text: &str) -> Vec<String> {
    let mut blocks = vec![String::new()];
    let mut in_example = false;
    for line in text.lines() {
        let bare = line.trim_start();
        let comment = ["///", "//!", "//"].iter().find_map(|mark| bare.strip_prefix(mark));
        let Some(comment) = comment.map(str::trim) else {
            in_example = false;
            blocks.push(String::new());
            continue;
        };
        if comment.starts_with("```") {
            in_example = !in_example;
        } else if !in_example && !comment.starts_with(['#', '|']) {
            if comment.is_empty() || comment.starts_with("- ") {
                blocks.push(String::new());
            }
            let block = blocks.last_mut().unwrap();
            block.push_str(comment.trim_start_matches("- "));
            block.push(' ');
        }
    }
    let plain = |block: String| plain_words::replace_between(&block, "`", "x");
    blocks.into_iter().filter(|block| !block.trim().is_empty()).map(plain).collect()
}

fn assert_is_plain(folder: &str, sources: &[Source]) {
    let mut all = TextStatistics::default();
    let mut worst = Vec::new();
    for source in sources {
        let mut own = TextStatistics::default();
        for block in comments(&source.text) {
            own.add_paragraph(&block);
        }
        worst.push((own.phrases + own.long, source.name()));
        all.add(own);
    }
    worst.sort_by(|a, b| b.cmp(a));
    worst.truncate(10);
    let (mean, long, phrases) = (all.mean(), all.long_share(), all.phrases_per_1000());
    assert!(all.words > 5_000, "{folder}: {} words of comments", all.words);
    assert!(
        mean <= MAX_MEAN_WORDS && long <= MAX_LONG_SHARE && phrases <= MAX_PHRASES_PER_1000,
        "comments in {folder}: {mean:.1} words per sentence, {:.1} % long sentences, {phrases:.2} hard phrases per 1,000 words; \
         worst: {worst:#?}",
        100.0 * long
    );
}

#[test]
fn comments_are_written_in_plain_words() {
    assert_is_plain("src", &sources());
    assert_is_plain("tests", &sources_in("tests"));
}

#[test]
fn comments_are_read_without_code() {
    let text = "//! One `is told` two.\n//!\n//! ```\n//! let a = so_many();\n//! ```\nfn f() {\n    // Three - four.\n    g(); }\n";
    assert_eq!(comments(text), ["One x two. ", "Three - four. "]);
    assert_eq!(constant_in("    pub(crate) const MAX_GAP_PX: f64 = 1.0;"), Some("MAX_GAP_PX"));
}
