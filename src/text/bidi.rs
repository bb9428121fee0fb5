//! Order of mixed left-to-right and right-to-left text, such as Latin with Hebrew or Arabic.
//!
//! Input: a line of text in reading order. Output: an embedding level per character, and the visual order of
//! runs of equal level.
//!
//! Source: Unicode Standard Annex 9 (bidirectional algorithm), simplified: no explicit marks or isolates.
//! Strong letters have the direction of their script, and numbers run to the right. Neutral characters follow
//! their neighbours on both sides if these agree, and otherwise the base direction.

/// Directional class of a character.
#[derive(Clone, Copy, PartialEq, Eq)]
enum BidiClass {
    Left,
    Right,
    Number,
    Neutral,
}

/// Class of a character, from its code block: Hebrew, Arabic and related scripts run to the left.
fn bidi_class(c: char) -> BidiClass {
    match c as u32 {
        0x660..=0x669 | 0x6f0..=0x6f9 => BidiClass::Number,
        0x590..=0x8ff | 0xfb1d..=0xfdff | 0xfe70..=0xfeff | 0x1_0800..=0x1_0fff | 0x1_e800..=0x1_efff => {
            BidiClass::Right
        }
        _ if c.is_ascii_digit() => BidiClass::Number,
        _ if c.is_alphabetic() => BidiClass::Left,
        _ => BidiClass::Neutral,
    }
}

/// Whether the base direction of a text is right to left: the direction of its first strong letter (rule P2).
pub(crate) fn runs_left(text: &str) -> bool {
    text.chars().map(bidi_class).find(|kind| matches!(kind, BidiClass::Left | BidiClass::Right))
        == Some(BidiClass::Right)
}

/// The embedding level of each character. Even levels run to the right, odd ones to the left.
///
/// `base` is the level of the paragraph: 0 if it runs to the right, 1 if to the left.
pub(crate) fn embedding_levels(text: &str, base: u8) -> Vec<u8> {
    let kinds: Vec<BidiClass> = text.chars().map(bidi_class).collect();
    if base == 0 && !kinds.contains(&BidiClass::Right) {
        return vec![0; kinds.len()];
    }
    let outer = if base == 1 { BidiClass::Right } else { BidiClass::Left };
    // Numbers count as the strong letter before them when neutral characters are resolved.
    let mut before = outer;
    let strong: Vec<BidiClass> = kinds
        .iter()
        .map(|kind| {
            if matches!(kind, BidiClass::Left | BidiClass::Right) {
                before = *kind;
            }
            if *kind == BidiClass::Number { before } else { *kind }
        })
        .collect();
    let mut after = outer;
    let mut next = vec![outer; kinds.len()];
    for (slot, kind) in next.iter_mut().zip(&strong).rev() {
        if *kind != BidiClass::Neutral {
            after = *kind;
        }
        *slot = after;
    }
    let mut last = outer;
    let mut levels = Vec::with_capacity(kinds.len());
    for ((kind, strong), next) in kinds.iter().zip(&strong).zip(&next) {
        let way = match strong {
            BidiClass::Neutral if last == *next => last,
            BidiClass::Neutral => outer,
            way => *way,
        };
        if *strong != BidiClass::Neutral {
            last = *strong;
        }
        levels.push(match (kind, way) {
            (BidiClass::Number, BidiClass::Right) => 2,
            (_, BidiClass::Right) => 1,
            _ => base * 2,
        });
    }
    levels
}

/// The indices of characters or runs in visual order from the left, from their levels (rule L2).
pub(crate) fn visual_order(levels: &[u8]) -> Vec<usize> {
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

    fn visual_text(text: &str) -> String {
        let characters: Vec<char> = text.chars().collect();
        let levels = embedding_levels(text, u8::from(runs_left(text)));
        visual_order(&levels).into_iter().map(|n| characters[n]).collect()
    }

    #[test]
    fn mixed_direction_text_is_in_visual_order() {
        assert_eq!(visual_text("abc 12, d"), "abc 12, d");
        assert_eq!(visual_text("abc אבג דה. d"), "abc הד גבא. d");
        assert_eq!(visual_text("אב 12 גד ab"), "ab דג 12 בא");
        assert_eq!(visual_text("אב (abc)"), ")abc( בא", "brackets are mirrored where letters are shaped");
    }
}
