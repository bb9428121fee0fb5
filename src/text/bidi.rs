//! Text direction: the embedding levels of characters, and their visual order.
//!
//! Source: Unicode Standard Annex 9, without explicit directional marks. Strong letters have the direction of
//! their script, and numbers run to the right. Neutral characters follow their neighbours on both sides if
//! these agree.

/// Directional class of a character.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    Left,
    Right,
    Number,
    Neutral,
}

fn kind(c: char) -> Kind {
    match c as u32 {
        0x660..=0x669 | 0x6f0..=0x6f9 => Kind::Number,
        0x590..=0x8ff | 0xfb1d..=0xfdff | 0xfe70..=0xfeff | 0x1_0800..=0x1_0fff | 0x1_e800..=0x1_efff => {
            Kind::Right
        }
        _ if c.is_ascii_digit() => Kind::Number,
        _ if c.is_alphabetic() => Kind::Left,
        _ => Kind::Neutral,
    }
}

/// Whether the base direction is right to left, as that of the first strong letter.
pub(crate) fn runs_left(text: &str) -> bool {
    text.chars().map(kind).find(|kind| matches!(kind, Kind::Left | Kind::Right)) == Some(Kind::Right)
}

/// The embedding level of each character; even levels run to the right, odd ones to the left.
pub(crate) fn levels(text: &str, base: u8) -> Vec<u8> {
    let kinds: Vec<Kind> = text.chars().map(kind).collect();
    if base == 0 && !kinds.contains(&Kind::Right) {
        return vec![0; kinds.len()];
    }
    let outer = if base == 1 { Kind::Right } else { Kind::Left };
    // Numbers count as the strong letter before them when neutral characters are resolved.
    let mut before = outer;
    let strong: Vec<Kind> = kinds
        .iter()
        .map(|kind| {
            if matches!(kind, Kind::Left | Kind::Right) {
                before = *kind;
            }
            if *kind == Kind::Number { before } else { *kind }
        })
        .collect();
    let mut after = outer;
    let mut next = vec![outer; kinds.len()];
    for (slot, kind) in next.iter_mut().zip(&strong).rev() {
        if *kind != Kind::Neutral {
            after = *kind;
        }
        *slot = after;
    }
    let mut last = outer;
    let mut levels = Vec::with_capacity(kinds.len());
    for ((kind, strong), next) in kinds.iter().zip(&strong).zip(&next) {
        let way = match strong {
            Kind::Neutral if last == *next => last,
            Kind::Neutral => outer,
            way => *way,
        };
        if *strong != Kind::Neutral {
            last = *strong;
        }
        levels.push(match (kind, way) {
            (Kind::Number, Kind::Right) => 2,
            (_, Kind::Right) => 1,
            _ => base * 2,
        });
    }
    levels
}

/// The indices of runs in visual order from the left, for their levels (rule L2).
pub(crate) fn seen_order(levels: &[u8]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..levels.len()).collect();
    let level = |number: &usize| levels.get(*number).copied().unwrap_or(0);
    let highest = levels.iter().copied().max().unwrap_or(0);
    for limit in (1..=highest).rev() {
        let mut begin = 0;
        while begin < order.len() {
            let stretch = order[begin..].iter().take_while(|n| level(n) >= limit).count();
            order[begin..begin + stretch].reverse();
            begin += stretch.max(1);
        }
    }
    order
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seen(text: &str) -> String {
        let characters: Vec<char> = text.chars().collect();
        let levels = levels(text, u8::from(runs_left(text)));
        seen_order(&levels).into_iter().map(|n| characters[n]).collect()
    }

    #[test]
    fn lines_are_seen_as_they_are_read() {
        assert_eq!(seen("abc 12, d"), "abc 12, d");
        assert_eq!(seen("abc אבג דה. d"), "abc הד גבא. d");
        assert_eq!(seen("אב 12 גד ab"), "ab דג 12 בא");
        assert_eq!(seen("אב (abc)"), ")abc( בא", "brackets are mirrored where letters are shaped");
    }
}
