//! [`unions`]: outlines of several regions together, along the borders that they share with others.

use kurbo::{Affine, BezPath, Point, Vec2};
use rustc_hash::FxHashMap;

use super::region_paint::append;
use crate::regions::Regions;

/// Outline of all regions of each class, exactly along their borders with others, and moved by `offset`.
///
/// `class` returns the class of a region, below `count`.
pub(crate) fn unions(
    regions: &Regions,
    count: usize,
    class: impl Fn(u32) -> Option<u32>,
    offset: Vec2,
) -> Vec<BezPath> {
    let classes: Vec<Option<u32>> = (0..regions.regions.len() as u32).map(class).collect();
    let of = |side: Option<u32>| side.and_then(|region| classes.get(region as usize).copied().flatten());
    // For each class, its borders with others, passed with the class on the right on the page.
    let mut around: Vec<Vec<(usize, bool)>> = vec![Vec::new(); count];
    for (number, border) in regions.borders.iter().enumerate() {
        let [right, left] = border.sides.map(of);
        if right != left {
            for (class, along) in [(right, true), (left, false)] {
                if let Some(list) = class.and_then(|class| around.get_mut(class as usize)) {
                    list.push((number, along));
                }
            }
        }
    }
    around.iter().map(|borders| Affine::translate(offset) * joined(regions, borders)).collect()
}

/// Borders joined end to end.
fn joined(regions: &Regions, borders: &[(usize, bool)]) -> BezPath {
    let pieces: Vec<BezPath> = borders
        .iter()
        .map(|(number, along)| {
            let path = &regions.borders[*number].path;
            if *along { path.clone() } else { path.reverse_subpaths() }
        })
        .collect();
    let key = |p: Point| [p.x.to_bits(), p.y.to_bits()];
    let ends = |piece: &BezPath| {
        let points = || piece.elements().iter().filter_map(kurbo::PathEl::end_point);
        Some([key(points().next()?), key(points().next_back()?)])
    };
    let ends: Vec<Option<[[u64; 2]; 2]>> = pieces.iter().map(ends).collect();
    let mut starts: FxHashMap<[u64; 2], Vec<usize>> = FxHashMap::default();
    for (k, own) in ends.iter().enumerate().rev() {
        if let Some([start, _]) = own {
            starts.entry(*start).or_default().push(k);
        }
    }
    let mut done = vec![false; pieces.len()];
    let mut path = BezPath::new();
    for first in 0..pieces.len() {
        let mut begun = false;
        let mut next = (!done[first]).then_some(first);
        while let Some(k) = next {
            done[k] = true;
            append(&mut path, &pieces[k], &mut begun);
            next = match ends[k].filter(|_| !regions.borders[borders[k].0].closed) {
                Some([_, end]) => starts.get_mut(&end).and_then(|starts| {
                    while let Some(k) = starts.pop() {
                        if !done[k] {
                            return Some(k);
                        }
                    }
                    None
                }),
                None => None,
            };
        }
        if begun {
            path.close_path();
        }
    }
    path
}

#[cfg(test)]
mod tests {
    use kurbo::Shape;

    use super::*;
    use crate::mesh::{MaterialId, PaintId, PartId};
    use crate::regions::{Region, RegionBorder, SurfaceLabel};

    #[test]
    fn region_union_of_two_halves_is_the_whole_square() {
        let line = |points: &[[f64; 2]]| {
            let mut path = BezPath::new();
            path.move_to((points[0][0], points[0][1]));
            points[1..].iter().for_each(|p| path.line_to((p[0], p[1])));
            path
        };
        let (part, material, paint) = (PartId(0), MaterialId(0), PaintId(0));
        let region = |tone| Region {
            ramp: None,
            label: SurfaceLabel { part, material, paint, tone, bin: 0, cast: false },
            area: 50.0,
            loops: vec![],
        };
        // The right half, clockwise on the page, the left half, and the line between them.
        let right = line(&[[5.0, 0.0], [10.0, 0.0], [10.0, 10.0], [5.0, 10.0]]);
        let left = line(&[[5.0, 0.0], [0.0, 0.0], [0.0, 10.0], [5.0, 10.0]]);
        let middle = line(&[[5.0, 0.0], [5.0, 10.0]]);
        let border = |path, sides| RegionBorder { path, sides, closed: false };
        let borders = vec![
            border(right, [Some(0), None]),
            border(left, [None, Some(1)]),
            border(middle, [Some(1), Some(0)]),
        ];
        let regions = Regions { regions: vec![region(0), region(1)], borders, leaks: 0 };
        let both = unions(&regions, 1, |_| Some(0), Vec2::new(3.0, 0.0));
        assert_eq!((both.len(), both[0].area()), (1, 100.0));
        assert_eq!(both[0].elements().iter().filter(|e| matches!(e, kurbo::PathEl::MoveTo(_))).count(), 1);
        assert_eq!(both[0].bounding_box(), kurbo::Rect::new(3.0, 0.0, 13.0, 10.0));
        let each = unions(&regions, 2, Some, Vec2::ZERO);
        assert_eq!(each.iter().map(Shape::area).collect::<Vec<_>>(), [50.0, 50.0]);
    }
}
