//! Documents and help are in plain language: sentence length and hard phrases stay below the limits.
//!
//! `docs/dev/style-guide.md` explains the rules. A failing test names the worst documents or help line.

#[path = "../../library/support/plain_words.rs"]
mod plain_words;

use std::fs;
use std::path::{Path, PathBuf};

use self::plain_words::{
    MAX_SENTENCE_WORDS, TextStatistics, hard_phrases, replace_between, sentences, words,
};
use crate::folder::TestFolder;

/// Limits for all documents together.
const MAX_MEAN_WORDS: f64 = 15.0;
const MAX_LONG_SHARE: f64 = 0.04;
const MAX_PHRASES_PER_1000: f64 = 1.0;

/// Pages directly in `docs/` that are measured.
const TOP_PAGES: [&str; 4] = ["index.md", "gallery.md", "troubleshooting.md", "glossary.md"];

/// The paragraphs, list items and table cells of a page, without code, pictures and link targets.
fn paragraphs(markdown: &str) -> Vec<String> {
    let text = replace_between(&replace_between(markdown, "```", ""), "`", "x");
    // The target of a link is between `](` and `)`.
    let mut plain = String::new();
    for (number, part) in text.split("](").enumerate() {
        plain.push_str(if number == 0 { part } else { part.split_once(')').map_or("", |(_, rest)| rest) });
    }
    let mut paragraphs = vec![String::new()];
    for line in plain.lines() {
        let line = line.trim();
        let item = line.strip_prefix(['-', '*']).or_else(|| {
            let rest = line.trim_start_matches(|c: char| c.is_ascii_digit());
            rest.strip_prefix(". ").filter(|_| rest.len() < line.len())
        });
        if line.starts_with(['#', '<']) || line.starts_with("![") {
            paragraphs.push(String::new());
        } else if let Some(row) = line.strip_prefix('|') {
            paragraphs.extend(row.split('|').map(str::to_owned));
            paragraphs.push(String::new());
        } else if line.is_empty() || item.is_some() {
            paragraphs.push(item.unwrap_or_default().to_owned());
        } else if let Some(last) = paragraphs.last_mut() {
            last.push(' ');
            last.push_str(line);
        }
    }
    paragraphs
}

/// Counts of a Markdown page.
fn measure(markdown: &str) -> TextStatistics {
    let mut all = TextStatistics::default();
    for paragraph in paragraphs(markdown) {
        all.add_paragraph(&paragraph);
    }
    all
}

/// Adds all Markdown pages under a folder.
fn pages_in(folder: &Path, pages: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).into_iter().flatten().flatten() {
        let path = entry.path();
        if path.is_dir() {
            pages_in(&path, pages);
        } else if path.extension().is_some_and(|ending| ending == "md") {
            pages.push(path);
        }
    }
}

/// README, CHANGELOG and the measured pages in `docs/`.
fn documents() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let docs = root.join("docs");
    let mut pages = Vec::new();
    pages_in(&docs, &mut pages);
    pages.retain(|page| {
        let is_top = TOP_PAGES.iter().any(|name| page.file_name().is_some_and(|own| own == *name));
        page.parent() != Some(&docs) || is_top
    });
    pages.extend(["README.md", "CHANGELOG.md"].map(|name| root.join(name)));
    pages.sort();
    pages
}

#[test]
fn documents_are_written_in_plain_words() {
    let mut all = TextStatistics::default();
    let mut worst = Vec::new();
    for page in documents() {
        let own = measure(&fs::read_to_string(&page).expect("a document"));
        all.add(own);
        let name = page.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap_or(&page).display().to_string();
        worst.push((
            own.phrases + own.long,
            format!("{name}: {} phrases, {} long sentences", own.phrases, own.long),
        ));
    }
    worst.sort_by(|(a, _), (b, _)| b.cmp(a));
    let worst: Vec<&str> = worst.iter().take(5).map(|(_, line)| line.as_str()).collect();
    let (mean, long, phrases) = (all.mean(), all.long_share(), all.phrases_per_1000());
    let is_plain = mean <= MAX_MEAN_WORDS && long <= MAX_LONG_SHARE && phrases <= MAX_PHRASES_PER_1000;
    assert!(
        is_plain,
        "{mean:.1} words per sentence (at most {MAX_MEAN_WORDS}), {:.1} % of sentences over {MAX_SENTENCE_WORDS} words (at most {:.0} %), \
         {phrases:.1} phrases per 1,000 words (at most {MAX_PHRASES_PER_1000}); worst:\n{}",
        100.0 * long,
        100.0 * MAX_LONG_SHARE,
        worst.join("\n")
    );
}

#[test]
fn help_is_written_in_plain_words() {
    let folder = TestFolder::new("language");
    let program = folder.run(&["--help"]).expect_success().out.clone();
    let (_, list) = program.split_once("Commands:\n").expect("a list of commands");
    let commands =
        list.lines().take_while(|line| !line.is_empty()).filter_map(|line| line.split_whitespace().next());
    let mut texts = vec![program.clone()];
    texts.extend(
        commands
            .filter(|name| *name != "help")
            .map(|name| folder.run(&[name, "--help"]).expect_success().out.clone()),
    );
    assert!(texts.len() > 10, "{} texts", texts.len());
    for line in texts.iter().flat_map(|text| text.lines()) {
        assert!(hard_phrases(line).is_empty(), "{:?} in: {line}", hard_phrases(line));
        let longest = sentences(line).into_iter().map(|sentence| words(sentence).len()).max();
        assert!(longest.is_none_or(|count| count <= MAX_SENTENCE_WORDS), "too long: {line}");
    }
}

#[test]
fn text_statistics_count_sentences_and_phrases() {
    let page = "# A heading is not counted at all\n\nOne two three. Four five `code, is told`.\n\n- Six seven eight\n\n\
                | a | What it hides is nobody's business |\n| --- | --- |\n\n```sh\nligne tells so many\n```\n[a link](beyond.md) here\n";
    let measure = measure(page);
    assert_eq!(
        (measure.sentences, measure.words_in_sentences, measure.long),
        (5, 3 + 3 + 3 + 6 + 3, 0),
        "{measure:?}"
    );
    assert_eq!(measure.phrases, 2, "{measure:?}");
    let long = "word ".repeat(MAX_SENTENCE_WORDS + 1);
    assert_eq!(self::measure(&long).long, 1);
    assert_eq!(hard_phrases("What is a crease?"), Vec::<String>::new());
    assert_eq!(hard_phrases("The file tells its format."), ["tells"]);
}
