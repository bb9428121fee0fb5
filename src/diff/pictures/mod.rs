//! [`decide`]: whether two drawings look different, by their pictures.
//!
//! 1. Both drawings are rasterised once with exact coverage (`canvas`), at a scale that keeps the work within bounds (`cost`).
//! 2. Each pixel is compared (`likeness`). Its threshold follows from how much colour an edge that goes by less than the
//!    tolerance adds to a pixel. What `--ignore` leaves out is not painted.
//! 3. Pixels near a finding of geometry are explained (`places`). Those that are not are candidates.
//! 4. A candidate is rasterised again without smooth edges, at four pixels to the tolerance. It differs if a spot as wide as the
//!    tolerance has no pixel of like colour within the tolerance in the other picture.
//! 5. Candidates that differ become findings (`places`): place, area, colours.
//! 6. Where there are none, the pixels near findings are rasterised again likewise, the most different first. If none of them
//!    differs, one picture was written in two ways: only findings about what is no picture stay (`kept`).

mod canvas;
mod cost;
mod drawn;
mod kept;
mod likeness;
mod places;
mod scans;
pub(super) mod stand_in;
mod unread;

use self::canvas::{Canvas, Spot};
pub(super) use self::drawn::Drawn;
pub(super) use self::kept::without_picture;
use self::likeness::Fine;
use self::places::Places;
pub(super) use self::unread::unread;
use super::finding::Finding;
use super::groups::Groups;
use super::ignore::Ignore;
use super::picture::Picture;
use crate::math::tolerance::{COARSEST_VETO_PX, FINEST_SEEN_PX};

/// Pixels that are rasterised anew to look closely, at most, for each of both questions.
const MAX_CLOSE_PIXELS: usize = 64_000_000;
/// Spots that were found to differ before the other candidates are believed.
const MAX_PROOFS: usize = 48;

/// What the pictures say.
pub(super) enum Decision {
    /// They look the same.
    Same,
    /// They differ; with findings about what geometry has not explained.
    Differs(Vec<Finding>),
    /// They cannot be compared: one of them takes too long to rasterise.
    Unknown,
}

/// Compares the pictures of two drawings, given what geometry found.
pub(super) fn decide(
    pictures: [&Picture; 2],
    findings: &[Finding],
    groups: &Groups,
    ignore: Ignore,
) -> Decision {
    let [width, height] =
        [pictures[0].width.min(pictures[1].width), pictures[0].height.min(pictures[1].height)];
    let outlined = pictures.iter().any(|picture| picture.shapes.iter().any(|shape| shape.ink.outlined));
    if ignore.widths && outlined {
        // Lines of varying width have no other picture than with their width.
        return Decision::Unknown;
    }
    let Some(scale) = cost::scale(pictures, [width, height]) else { return Decision::Unknown };
    let canvases = pictures.map(|picture| Canvas::new(picture, ignore));
    let (columns, rows) = ((width * scale).ceil() as usize, (height * scale).ceil() as usize);
    let (a, b) = crate::parallel::join(
        || canvases[0].coarse(columns, rows, scale),
        || canvases[1].coarse(columns, rows, scale),
    );
    let (Some(a), Some(b)) = (a, b) else { return Decision::Unknown };
    // Marks with tolerances of their own may have gone as far as the widest of these.
    let tolerances = || groups.groups.iter().map(|group| group.tolerance);
    let widest = tolerances().fold(FINEST_SEEN_PX, f64::max);
    let finest = tolerances().fold(COARSEST_VETO_PX, f64::min);
    let coarse = likeness::coarse([&a, &b], columns, widest * scale);
    // A colour of another number is another colour, however little it differs.
    let faint = places::is_recoloured(findings, &coarse, columns, scale);
    if !coarse.has_any() {
        return if faint { Decision::Differs(Vec::new()) } else { Decision::Same };
    }
    let places = Places::new(findings, pictures, columns, rows, scale);
    let mut unexplained = Vec::new();
    let mut close = Close { canvases: &canvases, scale, pixels: 0 };
    for tile in places.candidates(&coarse, false) {
        let believed = unexplained.len() >= MAX_PROOFS;
        if believed || tile.pixels.iter().any(|at| close.differs(*at, widest, true).unwrap_or(true)) {
            unexplained.push(tile);
        }
    }
    if !unexplained.is_empty() {
        return Decision::Differs(places.findings(&unexplained, [&a, &b]));
    }
    if faint {
        return Decision::Differs(Vec::new());
    }
    if !places.has_claims() {
        return Decision::Same;
    }
    close.pixels = 0;
    let claimed = places.candidates(&coarse, true);
    let differs = |tile: &places::Tile, close: &mut Close| {
        tile.pixels.iter().any(|at| close.differs(*at, finest, false).unwrap_or(true))
    };
    match claimed.iter().any(|tile| differs(tile, &mut close)) {
        true => Decision::Differs(Vec::new()),
        false => Decision::Same,
    }
}

/// Looks closely at pixels of the coarse pictures.
struct Close<'a> {
    canvases: &'a [Canvas<'a>; 2],
    scale: f64,
    /// Pixels that were rasterised so far.
    pixels: usize,
}

impl Close<'_> {
    /// Whether a pixel differs; `None` if too many were looked at. `spots`: whether only spots as wide as the tolerance count.
    fn differs(&mut self, [column, row]: [usize; 2], tolerance: f64, spots: bool) -> Option<bool> {
        let fine = Fine::new(self.scale, tolerance);
        let size = fine.core + 2 * fine.reach;
        self.pixels += size * size * 2;
        if self.pixels > MAX_CLOSE_PIXELS {
            return None;
        }
        let margin = fine.reach as f64 / fine.scale;
        let spot = Spot {
            x: column as f64 / self.scale - margin,
            y: row as f64 / self.scale - margin,
            size,
            scale: fine.scale,
        };
        let [a, b] = [0, 1].map(|side: usize| self.canvases[side].spot(spot));
        let (a, b) = (a?, b?);
        Some(fine.differs([&a, &b], spots))
    }
}
