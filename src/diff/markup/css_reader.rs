//! Reader of CSS text: white space, comments, strings, brackets and words, in one pass.

/// Reader of CSS text.
pub(crate) struct CssReader<'a> {
    pub text: &'a str,
    /// Byte offset of the next character.
    pub at: usize,
}

impl<'a> CssReader<'a> {
    /// Text that is not yet read.
    pub(crate) fn rest(&self) -> &'a str {
        self.text.get(self.at..).unwrap_or_default()
    }

    /// The next byte, which stays unread.
    pub(crate) fn peek(&self) -> Option<u8> {
        self.text.as_bytes().get(self.at).copied()
    }

    /// Skips white space and comments.
    pub(crate) fn blanks(&mut self) {
        while let Some(next) = self.peek() {
            if next.is_ascii_whitespace() {
                self.at += 1;
            } else if self.rest().starts_with("/*") {
                self.comment();
            } else {
                return;
            }
        }
    }

    /// Skips a comment, or the rest of the text if it does not end.
    fn comment(&mut self) {
        let length = self.rest().get(2..).and_then(|rest| rest.find("*/")).map(|at| at + 4);
        self.at = length.map_or(self.text.len(), |length| self.at + length);
    }

    /// Text before the first of these bytes outside strings, comments and parentheses. The reader stops at
    /// that byte.
    pub(crate) fn until(&mut self, ends: &[u8]) -> &'a str {
        let start = self.at.min(self.text.len());
        let mut depth = 0usize;
        while let Some(next) = self.peek() {
            match next {
                _ if depth == 0 && ends.contains(&next) => break,
                b'"' | b'\'' => self.string(next),
                b'/' if self.rest().starts_with("/*") => {
                    self.comment();
                    continue;
                }
                b'(' => depth += 1,
                b')' => depth = depth.saturating_sub(1),
                _ => {}
            }
            self.at += 1;
        }
        self.text.get(start..self.at).unwrap_or_default()
    }

    /// Moves to the closing quote of a string.
    fn string(&mut self, quote: u8) {
        self.at += 1;
        while self.peek().is_some_and(|next| next != quote) {
            self.at += 1 + usize::from(self.peek() == Some(b'\\'));
        }
    }

    /// Text between braces, which may be nested. The reader stops at the closing brace.
    pub(crate) fn block(&mut self) -> &'a str {
        self.at += 1;
        let start = self.at.min(self.text.len());
        let mut depth = 0usize;
        loop {
            self.until(b"{}");
            match self.peek() {
                Some(b'{') => depth += 1,
                Some(_) if depth > 0 => depth -= 1,
                _ => break,
            }
            self.at += 1;
        }
        self.text.get(start..self.at.min(self.text.len())).unwrap_or_default()
    }

    /// Reads a name in letters, digits, hyphens and underscores; `None` if there is none.
    pub(crate) fn word(&mut self) -> Option<&'a str> {
        let is_of_word = |b: &u8| b.is_ascii_alphanumeric() || matches!(b, b'-' | b'_') || *b >= 0x80;
        let length = self.rest().bytes().take_while(is_of_word).count();
        let word = self.rest().get(..length).filter(|word| !word.is_empty())?;
        self.at += length;
        Some(word)
    }
}
