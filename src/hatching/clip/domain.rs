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
        Self::grouped(inked, |cell| ground.cells[cell as usize].facet)
    }

    /// Makes each inked cell its own domain.
    pub(crate) fn of_cells(inked: &[bool]) -> Self {
        Self::grouped(inked, |cell| cell)
    }

    /// Joins the inked cells of one part, material and tone.
    pub(crate) fn by_label(ground: &HatchRegions, inked: &[bool]) -> Self {
        let mut numbers = BTreeMap::new();
        Self::grouped(inked, |cell| {
            let look = ground.cells[cell as usize].look;
            *numbers.entry((look.part, look.material, look.tone)).or_insert(cell)
        })
    }

    /// Assigns each inked cell the domain that `of` returns.
    fn grouped(inked: &[bool], mut of: impl FnMut(u32) -> u32) -> Self {
        let cells = (0u32..).zip(inked);
        Self {
            domain_of_cell: cells.map(|(cell, inked)| if *inked { of(cell) } else { NO_DOMAIN }).collect(),
        }
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
