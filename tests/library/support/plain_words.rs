//! Measures of plain English: sentence length, and phrases that are hard to read.

/// Longer sentences count as long.
pub(crate) const MAX_SENTENCE_WORDS: usize = 30;

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

/// Counts of a text.
#[derive(Debug, Default, Clone, Copy)]
pub(crate) struct TextStatistics {
    pub words: usize,
    pub sentences: usize,
    pub words_in_sentences: usize,
    pub long: usize,
    pub phrases: usize,
}

impl TextStatistics {
    /// Adds the sentences of a paragraph.
    pub(crate) fn add_paragraph(&mut self, paragraph: &str) {
        for sentence in sentences(paragraph) {
            let count = words(sentence).len();
            self.words += count;
            self.phrases += hard_phrases(sentence).len();
            if count >= MIN_SENTENCE_WORDS {
                self.sentences += 1;
                self.words_in_sentences += count;
                self.long += usize::from(count > MAX_SENTENCE_WORDS);
            }
        }
    }

    pub(crate) fn add(&mut self, other: Self) {
        self.words += other.words;
        self.sentences += other.sentences;
        self.words_in_sentences += other.words_in_sentences;
        self.long += other.long;
        self.phrases += other.phrases;
    }

    pub(crate) fn mean(&self) -> f64 {
        self.words_in_sentences as f64 / self.sentences.max(1) as f64
    }

    pub(crate) fn long_share(&self) -> f64 {
        self.long as f64 / self.sentences.max(1) as f64
    }

    pub(crate) fn phrases_per_1000(&self) -> f64 {
        1000.0 * self.phrases as f64 / self.words.max(1) as f64
    }
}

/// Replaces every text between two marks with `with`.
pub(crate) fn replace_between(text: &str, mark: &str, with: &str) -> String {
    let parts = text.split(mark).enumerate();
    parts.map(|(number, part)| if number % 2 == 0 { part } else { with }).collect()
}

/// The words of a text, in lower case.
pub(crate) fn words(text: &str) -> Vec<String> {
    let is_part = |c: char| c.is_alphabetic() || matches!(c, '\'' | '’' | '-');
    let words = text.split(|c| !is_part(c)).filter(|word| word.starts_with(char::is_alphabetic));
    words.map(str::to_lowercase).collect()
}

/// The sentences of a paragraph.
pub(crate) fn sentences(paragraph: &str) -> Vec<&str> {
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
pub(crate) fn hard_phrases(sentence: &str) -> Vec<String> {
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
