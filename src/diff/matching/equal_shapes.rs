//! Shapes that are equal point for point. Most shapes of two versions of a drawing are, and need no further
//! work.

use std::hash::{Hash, Hasher};

use rustc_hash::{FxHashMap, FxHasher};

use crate::diff::curves::segment::points;
use crate::diff::shapes::mark_groups::MarkGroups;
use crate::diff::shapes::picture::{Picture, Shape};

/// Equal and unequal shapes of two pictures.
pub(crate) struct ShapeMatching {
    /// Index pairs of equal shapes.
    pub equal: Vec<(usize, usize)>,
    /// Indexes of the shapes of each picture that have no equal.
    pub unequal_shapes: [Vec<usize>; 2],
}

/// Matches equal shapes one to one. If a line is drawn twice in one picture and once in the other, one copy
/// remains unmatched.
pub(crate) fn part(before: &Picture, after: &Picture, groups: &MarkGroups) -> ShapeMatching {
    let hash = |shape: &Shape, group: usize| {
        let mut hasher = FxHasher::default();
        group.hash(&mut hasher);
        for p in points(&shape.path) {
            (p.x.to_bits(), p.y.to_bits()).hash(&mut hasher);
        }
        hasher.finish()
    };
    let mut waiting: FxHashMap<u64, Vec<usize>> = FxHashMap::default();
    for (index, (shape, group)) in before.shapes.iter().zip(&groups.of_shape[0]).enumerate().rev() {
        waiting.entry(hash(shape, *group)).or_default().push(index);
    }
    let mut gone = vec![true; before.shapes.len()];
    let (mut equal_pairs, mut new) = (Vec::new(), Vec::new());
    for (index, (shape, group)) in after.shapes.iter().zip(&groups.of_shape[1]).enumerate() {
        let equal = |other: &usize| {
            groups.of_shape[0].get(*other) == Some(group)
                && before
                    .shapes
                    .get(*other)
                    .is_some_and(|o| o.path == shape.path && o.outline == shape.outline)
        };
        let candidates = waiting.get_mut(&hash(shape, *group));
        let found = candidates.and_then(|list| list.iter().rposition(equal).map(|at| list.remove(at)));
        match found {
            Some(other) => {
                gone[other] = false;
                equal_pairs.push((other, index));
            }
            None => new.push(index),
        }
    }
    ShapeMatching {
        equal: equal_pairs,
        unequal_shapes: [(0..gone.len()).filter(|index| gone[*index]).collect(), new],
    }
}
