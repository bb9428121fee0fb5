//! Compares a drawing with the reference lines of a polyhedron: missing, hidden and misplaced lines.
//!
//! Drawings smooth and join lines and omit short ones, so ink is compared within a tolerance. Creases must be
//! drawn above one angle and may be drawn above a smaller one.

use kurbo::Point;
use ligne::drawing::{Drawing, LayerKind, Mark, Paint};

use super::line_visibility::{Place, State, Truth};
use super::polyhedron_lines::Kind;
use crate::support::measures::line_picture::{Ink, flattened, samples};

/// Creases with at least this angle must be drawn.
const MUST_CREASE_DEG: f64 = 45.0;
/// Minimum length of creases for a meaningful share, px.
const LEAST_CREASE_PX: f64 = 200.0;

/// A share of a length, and the longest run of samples outside it.
#[derive(Debug, Clone, Copy)]
pub struct Share {
    pub share: f64,
    /// Total length, px.
    pub of: f64,
    pub worst: Option<(Point, f64)>,
}

#[derive(Debug, Clone)]
pub struct Verdict {
    /// Shares with ink: of contours with background behind them, of all contours, and of sharp creases.
    pub outline: Share,
    pub contour: Share,
    pub crease: Option<Share>,
    /// Shares of the ink: near hidden lines only, near no line, and near lines only that another component
    /// hides.
    pub leak: Share,
    pub off: Share,
    pub through: Share,
}

/// The marks of all visible lines.
pub fn ink_marks(drawing: &Drawing) -> impl Iterator<Item = &Mark> {
    let lines = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines);
    lines.flat_map(|layer| &layer.marks).filter(|mark| mark.provenance.invisibility == 0)
}

/// The centre line of a mark, as short segments.
pub fn axis(mark: &Mark) -> Vec<[Point; 2]> {
    let path = if let Paint::Outline(outline) = &mark.paint { &outline.axis } else { &mark.path };
    flattened(path, 0.01)
}

/// Compares a drawing with the reference; ink counts within `tolerance` px of a line.
pub fn judge(truth: &Truth, drawing: &Drawing, tolerance: f64) -> Verdict {
    let strokes: Vec<[Point; 2]> = ink_marks(drawing).flat_map(axis).collect();
    judge_ink(truth, &strokes, tolerance)
}

/// Compares ink, given as segments, with the reference.
pub fn judge_ink(truth: &Truth, strokes: &[[Point; 2]], tolerance: f64) -> Verdict {
    let ink = Ink::new(strokes.to_vec(), tolerance);
    let seen = |wanted: &dyn Fn(&Place) -> bool| {
        let sure = truth.places.iter().filter(|place| place.state == State::Visible && wanted(place));
        share(sure.map(|place| (place.at, place.length(), place.line, ink.distance(place.at) <= tolerance)))
    };
    let is_contour = |place: &Place| truth.kind(place) == Kind::Contour;
    let is_sharp = |place: &Place| {
        let line = &truth.lines[place.line as usize];
        line.kind == Kind::Crease && line.turn_deg > MUST_CREASE_DEG + 0.05
    };
    let crease = seen(&is_sharp);

    let near = |wanted: &dyn Fn(&Place) -> bool| Ink::new(truth.stretches(wanted), tolerance + 1e-9);
    let shown = near(&|place| place.state != State::Hidden);
    let hidden = near(&|place| place.state == State::Hidden);
    let before_others = near(&|place| !place.behind_others);
    // For each ink sample: whether visible, hidden, or not occluded by another component is near.
    let drawn: Vec<(Point, f64, [bool; 3])> = samples(strokes, 1.0)
        .into_iter()
        .map(|(at, length)| {
            let finds = |lines: &Ink| lines.distance(at) <= tolerance;
            (at, length, [finds(&shown), finds(&hidden), finds(&before_others)])
        })
        .collect();
    let wrong = |is_wrong: &dyn Fn([bool; 3]) -> bool| {
        let right = share(drawn.iter().map(|(at, length, near)| (*at, *length, 0, !is_wrong(*near))));
        Share { share: 1.0 - right.share, ..right }
    };
    Verdict {
        outline: seen(&|place| place.is_outline),
        contour: seen(&is_contour),
        crease: (crease.of >= LEAST_CREASE_PX).then_some(crease),
        leak: wrong(&|[shown, hidden, _]| !shown && hidden),
        off: wrong(&|[shown, hidden, _]| !shown && !hidden),
        through: wrong(&|[shown, hidden, free]| !shown && hidden && !free),
    }
}

/// The share of samples that are right; each has a position, a length and the number of its line.
fn share(places: impl Iterator<Item = (Point, f64, u32, bool)>) -> Share {
    let (mut right, mut all) = (0.0, 0.0);
    let mut worst: Option<(Point, f64)> = None;
    let mut run: Option<(u32, Point, f64)> = None;
    for (at, length, line, is_right) in places {
        all += length;
        if is_right {
            right += length;
            run = None;
            continue;
        }
        let before =
            run.filter(|(of, last, _)| *of == line && (*last - at).hypot2() < 9.0).map_or(0.0, |r| r.2);
        run = Some((line, at, before + length));
        if worst.is_none_or(|(_, longest)| before + length > longest) {
            worst = Some((at, before + length));
        }
    }
    Share { share: if all > 0.0 { right / all } else { 1.0 }, of: all, worst }
}

/// Lower limits of the drawn shares and upper limits of the wrong ones.
#[derive(Debug, Clone, Copy)]
pub struct Limits {
    pub outline: f64,
    pub contour: f64,
    pub crease: f64,
    pub leak: f64,
    pub off: f64,
    pub through: f64,
    /// Maximum distance of ink from its line, px.
    pub tolerance: f64,
}

/// Limits for machined and low-poly models with flat faces: the drawing matches the mesh.
pub const EXACT: Limits = Limits {
    outline: 0.998,
    contour: 0.985,
    crease: 0.92,
    leak: 0.002,
    off: 0.005,
    through: 0.0005,
    tolerance: 2.5,
};
/// Limits for scans and dense figures: small folds may be missing, the silhouette may not.
pub const ROUND: Limits = Limits { contour: 0.80, crease: 0.0, leak: 0.005, off: 0.01, ..EXACT };
/// Limits for meshes with both flat and rounded parts.
pub const MIXED: Limits = Limits { crease: 0.92, ..ROUND };
/// Limits for coarse figures whose silhouette is drawn smoother than the mesh.
pub const COARSE: Limits = Limits { outline: 0.985, contour: 0.90, off: 0.02, tolerance: 15.0, ..ROUND };

impl Limits {
    /// A message for each limit that is violated; empty if the drawing is right.
    pub fn short(&self, verdict: &Verdict) -> Vec<String> {
        let mut words = Vec::new();
        let mut say = |what: &str, share: Share, limit: f64, falls: bool| {
            if falls {
                let place = share.worst.map_or(String::new(), |(at, run)| {
                    format!(", {run:.0} px at ({:.0}, {:.0})", at.x, at.y)
                });
                words.push(format!("{what} {:.4} (limit {limit}{place})", share.share));
            }
        };
        let least = [
            ("outline", Some(verdict.outline), self.outline),
            ("contour", Some(verdict.contour), self.contour),
            ("crease", verdict.crease, self.crease),
        ];
        for (what, share, limit) in least {
            if let Some(share) = share {
                say(what, share, limit, share.share < limit);
            }
        }
        let most = [
            ("leak", verdict.leak, self.leak),
            ("off", verdict.off, self.off),
            ("through", verdict.through, self.through),
        ];
        for (what, share, limit) in most {
            say(what, share, limit, share.share > limit);
        }
        words
    }
}
