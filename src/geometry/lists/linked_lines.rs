//! Pieces with two ends, followed from link to link into lines.

/// Calls `visit` with each line of pieces that are linked end to end: its pieces in order, each with the end
/// where it is entered.
///
/// `next` returns the piece that continues a piece past one of its ends, and the end of that piece which lies
/// there. Lines with a free end come first, then closed lines.
pub(crate) fn linked_lines(
    count: usize,
    next: impl Fn(usize, usize) -> Option<(usize, usize)>,
    mut visit: impl FnMut(&[(usize, usize)]),
) {
    let mut done = vec![false; count];
    let mut line = Vec::new();
    for closed in [false, true] {
        for first in 0..count {
            let is_start = |end: &usize| closed || next(first, *end).is_none();
            let Some(end) = (0..2).find(|end| !done[first] && is_start(end)) else { continue };
            line.clear();
            let mut at = Some((first, end));
            while let Some((piece, from)) = at {
                done[piece] = true;
                line.push((piece, from));
                at = next(piece, 1 - from).filter(|(other, _)| !done[*other]);
            }
            visit(&line);
        }
    }
}
