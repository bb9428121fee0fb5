//! [`Domains`]: the parts of the page that marks fill and do not leave.

use std::collections::BTreeMap;

use kurbo::Point;

use crate::regions::Ground;
use crate::regions::hatch_regions::hatch_map::BorderPiece;

/// No domain: paper, and cells that stay blank.
pub(crate) const BLANK: u32 = u32::MAX;

/// To which domain each cell belongs.
#[derive(Debug, Clone, Default)]
pub(crate) struct Domains {
    of: Vec<u32>,
}

impl Domains {
    /// The inked cells of each facet are one domain.
    pub fn of_facets(ground: &Ground, inked: &[bool]) -> Self {
        let of = |(cell, inked): (_, &bool)| if *inked { ground.cells[cell as usize].facet } else { BLANK };
        Self { of: (0u32..).zip(inked).map(of).collect() }
    }

    /// Each inked cell is a domain of its own.
    pub fn of_cells(inked: &[bool]) -> Self {
        Self { of: (0u32..).zip(inked).map(|(cell, inked)| if *inked { cell } else { BLANK }).collect() }
    }

    /// The inked cells of one part, material and tone are one domain.
    pub fn of_looks(ground: &Ground, inked: &[bool]) -> Self {
        let mut numbers = BTreeMap::new();
        let of = |(cell, inked): (u32, &bool)| {
            let look = ground.cells[cell as usize].look;
            if *inked { *numbers.entry((look.part, look.material, look.tone)).or_insert(cell) } else { BLANK }
        };
        Self { of: (0u32..).zip(inked).map(of).collect() }
    }

    /// The domain of a cell.
    pub fn of(&self, cell: u32) -> u32 {
        self.of.get(cell as usize).copied().unwrap_or(BLANK)
    }

    /// The domains on the two sides of a piece, if they differ.
    pub fn parted(&self, piece: &BorderPiece) -> Option<[u32; 2]> {
        let sides = piece.sides.map(|cell| self.of(cell));
        (sides[0] != sides[1]).then_some(sides)
    }
}

/// A piece of border of what is `within`, directed so that this lies to the right as the page is seen
/// (y down), with the cell there; none if it lies on both sides or neither.
pub(crate) fn border(piece: &BorderPiece, within: impl Fn(u32) -> bool) -> Option<([Point; 2], u32)> {
    let [right, left] = piece.sides.map(within);
    let [a, b] = piece.ends;
    match (right, left) {
        (true, false) => Some(([a, b], piece.sides[0])),
        (false, true) => Some(([b, a], piece.sides[1])),
        _ => None,
    }
}

/// The point of a segment nearest to a point.
pub(crate) fn nearest([a, b]: [Point; 2], p: Point) -> Point {
    let way = b - a;
    let length2 = way.hypot2();
    if length2 > 0.0 { a + way * ((p - a).dot(way) / length2).clamp(0.0, 1.0) } else { a }
}
