//! Parser of panel layouts such as `30 [30 | 20 | *] / *`.
//!
//! Grammar:
//!
//! - `stack = item (separator item)*`, with equal separators
//! - `separator = ("/" | "|") [number ("°" | "deg")]`, for rows or columns, with the slant of the gutter
//! - `item = share | [share] "[" stack "]"`, a panel or a divided item
//! - `share = number | "*"`

use std::ops::Range;

/// Maximum number of panels.
pub(crate) const MAX_PANELS: usize = 10_000;

/// Maximum nesting depth of brackets.
const MAX_BRACKET_DEPTH: usize = 32;

/// An error in a layout.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct LayoutFault {
    /// Position in the text, bytes.
    pub span: Range<usize>,
    /// Description of the error.
    pub message: String,
    /// How to correct it.
    pub advice: String,
}

/// Direction of a stack.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum StackAxis {
    /// Items below each other.
    Rows,
    /// Items side by side.
    Columns,
}

/// The share of a stack that an item takes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PanelShare {
    /// Percent if another item takes the rest, otherwise a proportion.
    Number(f64),
    /// The rest that other items leave.
    Rest,
}

/// A stack of rows or columns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Stack {
    /// Direction of the stack.
    pub axis: StackAxis,
    /// The items in reading order.
    pub items: Vec<StackItem>,
    /// Slant of the gutter after each item except the last, in degrees; it leans or rises to the right if
    /// positive.
    pub slants: Vec<f64>,
}

/// A row or column of a stack.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StackItem {
    /// Share of the stack.
    pub share: PanelShare,
    /// The stack inside; `None` for a panel.
    pub within: Option<Stack>,
    /// Position in the text, bytes.
    pub span: Range<usize>,
}

/// Parses a layout.
///
/// # Errors
/// Returns an error at the position of the wrong character.
pub(crate) fn parse(text: &str) -> Result<Stack, LayoutFault> {
    let mut parser = LayoutParser { text, at: 0, panels: 0 };
    let stack = parser.stack(0)?;
    match parser.peek() {
        None => Ok(stack),
        Some(other) => {
            let message = format!("`{other}` does not belong here");
            Err(parser.fault(message, "write such as 30 [30 | 20 | *] / *"))
        }
    }
}

struct LayoutParser<'a> {
    text: &'a str,
    at: usize,
    panels: usize,
}

impl LayoutParser<'_> {
    /// The next character after blanks.
    fn peek(&mut self) -> Option<char> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        self.at += rest.len() - rest.trim_start().len();
        self.text.get(self.at..).unwrap_or_default().chars().next()
    }

    fn takes(&mut self, wanted: char) -> bool {
        let is_there = self.peek() == Some(wanted);
        if is_there {
            self.at += wanted.len_utf8();
        }
        is_there
    }

    fn fault(&self, message: impl Into<String>, advice: &str) -> LayoutFault {
        let width = self.text.get(self.at..).and_then(|rest| rest.chars().next()).map_or(0, char::len_utf8);
        LayoutFault { span: self.at..self.at + width, message: message.into(), advice: advice.to_owned() }
    }

    fn stack(&mut self, depth: usize) -> Result<Stack, LayoutFault> {
        if depth > MAX_BRACKET_DEPTH {
            return Err(self.fault(format!("brackets are more than {MAX_BRACKET_DEPTH} deep"), "nest less"));
        }
        let mut stack = Stack { axis: StackAxis::Rows, items: vec![self.item(depth)?], slants: Vec::new() };
        let mut axis = None;
        loop {
            let next = match self.peek() {
                Some('/') => StackAxis::Rows,
                Some('|') => StackAxis::Columns,
                _ => break,
            };
            if axis.is_some_and(|axis| axis != next) {
                let advice = "put what belongs together in brackets, such as 1 / 1 [1 | 1]";
                return Err(self.fault("rows and columns are mixed here", advice));
            }
            axis = Some(next);
            self.at += 1;
            let slant = self.slant()?;
            stack.slants.push(slant);
            let item = self.item(depth)?;
            stack.items.push(item);
        }
        stack.axis = axis.unwrap_or(StackAxis::Rows);
        Ok(stack)
    }

    /// The slant of a gutter in degrees, right after its separator; 0 if none is written.
    fn slant(&mut self) -> Result<f64, LayoutFault> {
        let before = self.at;
        self.peek();
        let from = self.at;
        let Some(number) = self.number() else { return Ok(0.0) };
        let rest = self.text.get(self.at..).unwrap_or_default();
        let sign = ["°", "deg"].into_iter().find(|sign| rest.starts_with(sign));
        let Some(sign) = sign else {
            // The number is the share of the next item.
            self.at = before;
            return Ok(0.0);
        };
        self.at += sign.len();
        if number.abs() > 60.0 {
            let fault = LayoutFault {
                span: from..self.at,
                message: "this is not a slant for a gutter".to_owned(),
                advice: "write degrees from -60 to 60".to_owned(),
            };
            return Err(fault);
        }
        Ok(number)
    }

    fn number(&mut self) -> Option<f64> {
        let rest = self.text.get(self.at..).unwrap_or_default();
        let length =
            rest.find(|c: char| !(c.is_ascii_digit() || matches!(c, '.' | '-'))).unwrap_or(rest.len());
        let number = rest.get(..length)?.parse().ok().filter(|number: &f64| number.is_finite())?;
        self.at += length;
        Some(number)
    }

    fn item(&mut self, depth: usize) -> Result<StackItem, LayoutFault> {
        let wanted = "write a share: a number, or * for the rest; or brackets around rows or columns";
        let next = self.peek();
        let from = self.at;
        let share = match next {
            Some('*') => {
                self.at += 1;
                PanelShare::Rest
            }
            Some('[') => PanelShare::Rest,
            Some(c) if c.is_ascii_digit() || matches!(c, '.' | '-') => {
                let number = self.number();
                if number.is_none_or(|share| share <= 0.0) {
                    let span = from..self.at.max(from + 1);
                    let message = "this share leaves no panel".to_owned();
                    return Err(LayoutFault { span, message, advice: "write a number above 0".to_owned() });
                }
                PanelShare::Number(number.unwrap_or(1.0))
            }
            None => return Err(self.fault("the layout ends where a panel is due", wanted)),
            Some(other) => return Err(self.fault(format!("`{other}` is not a share"), wanted)),
        };
        let mut span = from..self.at;
        let within = if self.takes('[') {
            let stack = self.stack(depth + 1)?;
            if !self.takes(']') {
                return Err(self.fault("a bracket is not closed here", "write ] behind the last panel in it"));
            }
            span.end = self.at;
            Some(stack)
        } else {
            self.panels += 1;
            if self.panels > MAX_PANELS {
                let message = format!("a page can hold at most {MAX_PANELS} panels");
                return Err(LayoutFault {
                    span,
                    message,
                    advice: "spread them over several pages".to_owned(),
                });
            }
            None
        };
        Ok(StackItem { share, within, span })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layouts_are_parsed() {
        let stack = parse(" 30 [30 | 20 |-8.5° *] / * ").unwrap();
        assert_eq!((stack.axis, stack.items.len()), (StackAxis::Rows, 2));
        let row = stack.items[0].within.as_ref().unwrap();
        assert_eq!((row.axis, row.slants.as_slice()), (StackAxis::Columns, &[0.0, -8.5][..]));
        assert_eq!(row.items[2].share, PanelShare::Rest);
        assert_eq!(parse("1").unwrap().items.len(), 1);
    }

    #[test]
    fn invalid_layouts_are_refused_at_their_position() {
        for (text, at, message) in [
            ("", 0, "ends"),
            ("1 / ", 4, "ends"),
            ("1 | 2 / 3", 6, "mixed"),
            ("1 [2 | 3", 8, "not closed"),
            ("1 ]", 2, "does not belong"),
            ("0 | 1", 0, "leaves no panel"),
            ("-2", 0, "leaves no panel"),
            ("1 |80° 1", 3, "slant"),
            ("a", 0, "not a share"),
        ] {
            let fault = parse(text).unwrap_err();
            assert!(fault.span.start == at && fault.message.contains(message), "{text}: {fault:?}");
        }
        let many = format!("1{}", " | 1".repeat(MAX_PANELS));
        assert!(parse(&many).unwrap_err().message.contains("10000 panels"));
        assert!(parse(&"[".repeat(1000)).unwrap_err().message.contains("deep"));
    }
}
