//! [`Domains`]: groups of cells that marks fill without crossing their borders.

use std::collections::BTreeMap;

use kurbo::Point;

use crate::regions::HatchRegions;
use crate::regions::hatch_regions::border_piece::BorderPiece;

/// Stands for no domain: paper, and cells that stay blank.
pub(crate) const NO_DOMAIN: u32 = u32::MAX;

/// The domain of each cell.
#[derive(Debug, Clone, Default)]
pub(crate) struct Domains {
    domain_of_cell: Vec<u32>,
}

impl Domains {
    /// Joins the inked cells of each facet.
    pub(crate) fn of_facets(ground: &HatchRegions, inked: &[bool]) -> Self {
        let of =
            |(cell, inked): (_, &bool)| if *inked { ground.cells[cell as usize].facet } else { NO_DOMAIN };
        Self { domain_of_cell: (0u32..).zip(inked).map(of).collect() }
    }

    /// Makes each inked cell its own domain.
    pub(crate) fn of_cells(inked: &[bool]) -> Self {
        Self {
            domain_of_cell: (0u32..)
                .zip(inked)
                .map(|(cell, inked)| if *inked { cell } else { NO_DOMAIN })
                .collect(),
        }
    }

    /// Joins the inked cells of one part, material and tone.
    pub(crate) fn by_label(ground: &HatchRegions, inked: &[bool]) -> Self {
        let mut numbers = BTreeMap::new();
        let of = |(cell, inked): (u32, &bool)| {
            let look = ground.cells[cell as usize].look;
            if *inked {
                *numbers.entry((look.part, look.material, look.tone)).or_insert(cell)
            } else {
                NO_DOMAIN
            }
        };
        Self { domain_of_cell: (0u32..).zip(inked).map(of).collect() }
    }

    /// The domain of a cell, or [`NO_DOMAIN`].
    pub(crate) fn domain(&self, cell: u32) -> u32 {
        self.domain_of_cell.get(cell as usize).copied().unwrap_or(NO_DOMAIN)
    }

    /// The domains on the two sides of a border piece, if they differ.
    pub(crate) fn differing_domains(&self, piece: &BorderPiece) -> Option<[u32; 2]> {
        let sides = piece.sides.map(|cell| self.domain(cell));
        (sides[0] != sides[1]).then_some(sides)
    }
}

/// A border piece of the cells that are `within`, and the cell on that side. The piece is directed so that
/// the cell lies to its right on the page (y down). `None` if both sides or neither are within.
pub(crate) fn directed_border(
    piece: &BorderPiece,
    within: impl Fn(u32) -> bool,
) -> Option<([Point; 2], u32)> {
    let [right, left] = piece.sides.map(within);
    let [a, b] = piece.ends;
    match (right, left) {
        (true, false) => Some(([a, b], piece.sides[0])),
        (false, true) => Some(([b, a], piece.sides[1])),
        _ => None,
    }
}

/// The point of a segment closest to a point.
pub(crate) fn nearest([a, b]: [Point; 2], p: Point) -> Point {
    let way = b - a;
    let length2 = way.hypot2();
    if length2 > 0.0 { a + way * ((p - a).dot(way) / length2).clamp(0.0, 1.0) } else { a }
}
