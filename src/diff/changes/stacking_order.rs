//! Changes in stacking order: unchanged marks that overlap and are painted in another order.

use kurbo::{Point, Rect, Shape as _};

use crate::diff::curves::chain::flatten;
use crate::diff::findings::finding::{Change, Finding, Verdict};
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};

/// Most pairs of marks tested.
const MAX_PAIRS: usize = 50_000_000;
/// Sample points along each side of the common box of two regions.
const OVERLAP_SAMPLES_PER_SIDE: usize = 8;

/// Findings about the stacking of unchanged marks; `stayed` holds their indexes in both pictures.
pub(crate) fn findings(before: &Picture, after: &Picture, mut stayed: Vec<(usize, usize)>) -> Vec<Finding> {
    stayed.sort_unstable();
    stayed.dedup_by_key(|pair| pair.0);
    let moved = out_of_order(&stayed);
    if moved.is_empty() || moved.len().saturating_mul(stayed.len()) > MAX_PAIRS {
        return Vec::new();
    }
    let boxes: Vec<Rect> = stayed
        .iter()
        .map(|(_, new)| after.shapes.get(*new).map_or(Rect::ZERO, |shape| shape.path.bounding_box()))
        .collect();
    let mut found = Vec::new();
    for item in moved {
        let (old, new) = stayed[item];
        let (Some(was), Some(shape)) = (before.shapes.get(old), after.shapes.get(new)) else { continue };
        let other = stayed.iter().zip(&boxes).find_map(|(&(other_old, other_new), bounds)| {
            let turned = (old < other_old) != (new < other_new) && old != other_old;
            let other = after.shapes.get(other_new)?;
            let touches = turned && bounds.overlaps(boxes[item]) && matters(shape, other);
            (touches && overlap(shape, other, bounds.intersect(boxes[item]))).then_some((other_new, other))
        });
        if let Some((other_new, other)) = other {
            let side = |over: bool| format!("{} {}", if over { "over" } else { "under" }, other.label);
            let change =
                Change { what: "order".to_owned(), old: side(new < other_new), new: side(new > other_new) };
            found.push(Finding {
                added_path: shape.path.clone(),
                ..Finding::of_shape(Verdict::Restacked, was, vec![change], boxes[item])
            });
        }
    }
    found
}

/// Whether the order of two marks is visible.
fn matters(a: &Shape, b: &Shape) -> bool {
    let clip = a.kind == ShapeKind::Clip || b.kind == ShapeKind::Clip;
    let fills = a.kind == ShapeKind::Region || b.kind == ShapeKind::Region;
    !clip && fills && a.ink.paint != b.ink.paint
}

/// Fewest marks whose move explains the new order: all except a longest increasing subsequence.
fn out_of_order(stayed: &[(usize, usize)]) -> Vec<usize> {
    // Patience sorting: the last item of the best sequence of each length, and the predecessor of each item.
    let mut tails: Vec<usize> = Vec::new();
    let mut previous = vec![usize::MAX; stayed.len()];
    for (index, (_, new)) in stayed.iter().enumerate() {
        let at = tails.partition_point(|tail| stayed[*tail].1 < *new);
        if at > 0 {
            previous[index] = tails[at - 1];
        }
        match tails.get_mut(at) {
            Some(tail) => *tail = index,
            None => tails.push(index),
        }
    }
    let mut rising = vec![false; stayed.len()];
    let mut at = tails.last().copied().unwrap_or(usize::MAX);
    while let Some(mark) = rising.get_mut(at) {
        *mark = true;
        at = previous[at];
    }
    (0..stayed.len()).filter(|index| !rising[*index]).collect()
}

/// Whether two marks overlap. At least one of them must be a region.
fn overlap(a: &Shape, b: &Shape, common: Rect) -> bool {
    let inside = |shape: &Shape, p: Point| match shape.even_odd {
        true => shape.path.winding(p) % 2 != 0,
        false => shape.path.winding(p) != 0,
    };
    match (a.kind, b.kind) {
        (ShapeKind::Region, ShapeKind::Region) => {
            let step = |index: usize| (index as f64 + 0.5) / OVERLAP_SAMPLES_PER_SIDE as f64;
            (0..OVERLAP_SAMPLES_PER_SIDE)
                .flat_map(|x| (0..OVERLAP_SAMPLES_PER_SIDE).map(move |y| (x, y)))
                .any(|(x, y)| {
                    let at = Point::new(
                        common.x0 + step(x) * common.width(),
                        common.y0 + step(y) * common.height(),
                    );
                    inside(a, at) && inside(b, at)
                })
        }
        (ShapeKind::Line, _) => on_line(a, |p| inside(b, p)),
        _ => on_line(b, |p| inside(a, p)),
    }
}

/// Whether any inner point of a line's segments satisfies a condition. End points are skipped, because they
/// often lie on borders.
fn on_line(line: &Shape, is_such: impl Fn(Point) -> bool) -> bool {
    flatten(&line.path, 0.1, false)
        .iter()
        .flat_map(|(points, _)| points.windows(2))
        .any(|pair| [0.25, 0.5, 0.75].into_iter().any(|share| is_such(pair[0].lerp(pair[1], share))))
}

#[cfg(test)]
mod tests {
    use super::out_of_order;

    #[test]
    fn out_of_order_returns_the_fewest_moved_marks() {
        assert!(out_of_order(&[(0, 3), (1, 5), (2, 9)]).is_empty());
        assert_eq!(out_of_order(&[(0, 9), (1, 0), (2, 1), (3, 2)]), [0]);
        assert_eq!(out_of_order(&[(0, 0), (1, 2), (2, 3), (3, 1)]), [3]);
    }
}
