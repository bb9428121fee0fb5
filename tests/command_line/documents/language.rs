//! Documents and help are in plain language: sentence length and hard phrases stay below the limits.
//!
//! `docs/dev/style-guide.md` explains the rules. A failing test names the worst documents or help line.

use std::fs;
use std::path::{Path, PathBuf};

use crate::folder::TestFolder;

/// Limits for all documents together.
const MAX_MEAN_WORDS: f64 = 15.0;
const MAX_LONG_SHARE: f64 = 0.04;
const MAX_PHRASES_PER_1000: f64 = 1.0;

/// Longer sentences count as long.
const MAX_SENTENCE_WORDS: usize = 30;

/// Shorter sentences are labels and do not count.
const MIN_SENTENCE_WORDS: usize = 3;

/// Phrases that have a plain equivalent. Words are separated by single spaces.
const HARD_PHRASES: [&str; 52] = [
    "is told",
    "are told",
    "was told",
    "be told",
    "is asked",
    "are asked",
    "was asked",
    "be asked",
    "tells",
    "asks",
    "so many",
    "so much",
    "as many",
    "as much",
    "of which",
    "by which",
    "over which",
    "at which",
    "in which",
    "from which",
    "to which",
    "with which",
    "but for",
    "beside",
    "beyond",
    "by itself",
    "by themselves",
    "of its own",
    "of their own",
    "as it is",
    "as they are",
    "as it stands",
    "nobody",
    "somebody",
    "no one",
    "a person",
    "by chance",
    "in vain",
    "is meant",
    "are meant",
    "what is left",
    "what lies",
    "what was",
    "what another",
    "what they",
    "what it",
    "whoever",
    "whatever",
    "wherever",
    "whichever",
    "the hand",
    "most of it",
];

/// Words that may follow `What` at the start of a sentence, because they form a question.
const QUESTION_WORDS: [&str; 9] = ["is", "are", "does", "do", "happens", "if", "to", "can", "should"];

/// Pages directly in `docs/` that are measured.
const TOP_PAGES: [&str; 4] = ["index.md", "gallery.md", "troubleshooting.md", "glossary.md"];

/// Counts of a text.
#[derive(Debug, Default, Clone, Copy)]
struct TextStatistics {
    words: usize,
    sentences: usize,
    words_in_sentences: usize,
    long: usize,
    phrases: usize,
}

impl TextStatistics {
    fn add(&mut self, other: Self) {
        self.words += other.words;
        self.sentences += other.sentences;
        self.words_in_sentences += other.words_in_sentences;
        self.long += other.long;
        self.phrases += other.phrases;
    }

    fn mean(&self) -> f64 {
        self.words_in_sentences as f64 / self.sentences.max(1) as f64
    }

    fn long_share(&self) -> f64 {
        self.long as f64 / self.sentences.max(1) as f64
    }

    fn phrases_per_1000(&self) -> f64 {
        1000.0 * self.phrases as f64 / self.words.max(1) as f64
    }
}

/// Replaces every text between two marks with `with`.
fn replace_between(text: &str, mark: &str, with: &str) -> String {
    let parts = text.split(mark).enumerate();
    parts.map(|(number, part)| if number % 2 == 0 { part } else { with }).collect()
}

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

/// The words of a text, in lower case.
fn words(text: &str) -> Vec<String> {
    let is_part = |c: char| c.is_alphabetic() || matches!(c, '\'' | '’' | '-');
    let words = text.split(|c| !is_part(c)).filter(|word| word.starts_with(char::is_alphabetic));
    words.map(str::to_lowercase).collect()
}

/// The sentences of a paragraph.
fn sentences(paragraph: &str) -> Vec<&str> {
    let mut sentences = Vec::new();
    let mut from = 0;
    for (at, _) in paragraph.match_indices(['.', '!', '?']) {
        let rest = &paragraph[at + 1..];
        let begins = rest
            .trim_start()
            .starts_with(|c: char| c.is_uppercase() || matches!(c, '`' | '"' | '(' | '*' | '['));
        if rest.starts_with(char::is_whitespace) && begins {
            sentences.push(&paragraph[from..=at]);
            from = at + 1;
        }
    }
    sentences.push(&paragraph[from..]);
    sentences
}

/// The hard phrases in a sentence.
fn hard_phrases(sentence: &str) -> Vec<String> {
    let words = words(sentence);
    let text = format!(" {} ", words.join(" "));
    let mut found: Vec<String> = HARD_PHRASES
        .iter()
        .filter(|phrase| text.contains(&format!(" {phrase} ")))
        .map(|phrase| (*phrase).to_owned())
        .collect();
    let is_capital = sentence.trim_start().starts_with("What ");
    if let [_, second, ..] = words.as_slice()
        && is_capital
        && !QUESTION_WORDS.contains(&second.as_str())
    {
        found.push("What as the subject".to_owned());
    }
    found
}

fn measure(markdown: &str) -> TextStatistics {
    let mut all = TextStatistics::default();
    for paragraph in paragraphs(markdown) {
        for sentence in sentences(&paragraph) {
            let count = words(sentence).len();
            all.words += count;
            all.phrases += hard_phrases(sentence).len();
            if count >= MIN_SENTENCE_WORDS {
                all.sentences += 1;
                all.words_in_sentences += count;
                all.long += usize::from(count > MAX_SENTENCE_WORDS);
            }
        }
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
