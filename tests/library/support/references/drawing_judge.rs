//! Compares a drawing with the reference lines of a polyhedron: missing, hidden and misplaced lines.
//!
//! Drawings smooth and join lines and omit short ones, so ink is compared within a tolerance. Creases must be
//! drawn above one angle and may be drawn above a smaller one.

use kurbo::Point;
use ligne::drawing::{Drawing, LayerKind, Mark, Paint};

use super::line_visibility::{LineSample, ReferenceLines, SampleVisibility};
use super::polyhedron_lines::ReferenceLineKind;
use crate::library::support::measures::line_picture::{SegmentGrid, flatten_path, sample_segments};

/// Creases with at least this angle must be drawn.
const MIN_REQUIRED_CREASE_DEG: f64 = 45.0;
/// Minimum length of creases for a meaningful share, px.
const MIN_CREASE_LENGTH_PX: f64 = 200.0;

/// A share of a length, and the longest run of samples outside it.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LengthShare {
    pub share: f64,
    /// Total length, px.
    pub of: f64,
    pub worst: Option<(Point, f64)>,
}

#[derive(Debug, Clone)]
pub(crate) struct DrawingShares {
    /// Shares with ink: of contours with background behind them, of all contours, and of sharp creases.
    pub outline: LengthShare,
    pub contour: LengthShare,
    pub crease: Option<LengthShare>,
    /// Shares of the ink: near hidden lines only, near no line, and near lines only that another component
    /// hides.
    pub leak: LengthShare,
    pub off: LengthShare,
    pub through: LengthShare,
}

/// The marks of all visible lines.
pub(crate) fn visible_line_marks(drawing: &Drawing) -> impl Iterator<Item = &Mark> {
    let lines = drawing.layers.iter().filter(|layer| layer.kind == LayerKind::Lines);
    lines.flat_map(|layer| &layer.marks).filter(|mark| mark.provenance.invisibility == 0)
}

/// The centre line of a mark, as short segments.
pub(crate) fn centre_line(mark: &Mark) -> Vec<[Point; 2]> {
    let path = if let Paint::Outline(outline) = &mark.paint { &outline.axis } else { &mark.path };
    flatten_path(path, 0.01)
}

/// Compares a drawing with the reference; ink counts within `tolerance` px of a line.
pub(crate) fn compare_with_reference(
    truth: &ReferenceLines,
    drawing: &Drawing,
    tolerance: f64,
) -> DrawingShares {
    let strokes: Vec<[Point; 2]> = visible_line_marks(drawing).flat_map(centre_line).collect();
    compare_ink_with_reference(truth, &strokes, tolerance)
}

/// Compares ink, given as segments, with the reference.
pub(crate) fn compare_ink_with_reference(
    truth: &ReferenceLines,
    strokes: &[[Point; 2]],
    tolerance: f64,
) -> DrawingShares {
    let ink = SegmentGrid::new(strokes.to_vec(), tolerance);
    let seen = |wanted: &dyn Fn(&LineSample) -> bool| {
        let sure =
            truth.samples.iter().filter(|place| place.state == SampleVisibility::Visible && wanted(place));
        share_of_right_samples(
            sure.map(|place| (place.at, place.length(), place.line, ink.distance(place.at) <= tolerance)),
        )
    };
    let is_contour = |place: &LineSample| truth.kind(place) == ReferenceLineKind::Contour;
    let is_sharp = |place: &LineSample| {
        let line = &truth.lines[place.line as usize];
        line.kind == ReferenceLineKind::Crease && line.angle_deg > MIN_REQUIRED_CREASE_DEG + 0.05
    };
    let crease = seen(&is_sharp);

    let near = |wanted: &dyn Fn(&LineSample) -> bool| {
        SegmentGrid::new(truth.segments_where(wanted), tolerance + 1e-9)
    };
    let shown = near(&|place| place.state != SampleVisibility::Hidden);
    let hidden = near(&|place| place.state == SampleVisibility::Hidden);
    let before_others = near(&|place| !place.hidden_by_other_component);
    // For each ink sample: whether visible, hidden, or not occluded by another component is near.
    let drawn: Vec<(Point, f64, [bool; 3])> = sample_segments(strokes, 1.0)
        .into_iter()
        .map(|(at, length)| {
            let finds = |lines: &SegmentGrid| lines.distance(at) <= tolerance;
            (at, length, [finds(&shown), finds(&hidden), finds(&before_others)])
        })
        .collect();
    let wrong = |is_wrong: &dyn Fn([bool; 3]) -> bool| {
        let right = share_of_right_samples(
            drawn.iter().map(|(at, length, near)| (*at, *length, 0, !is_wrong(*near))),
        );
        LengthShare { share: 1.0 - right.share, ..right }
    };
    DrawingShares {
        outline: seen(&|place| place.is_silhouette),
        contour: seen(&is_contour),
        crease: (crease.of >= MIN_CREASE_LENGTH_PX).then_some(crease),
        leak: wrong(&|[shown, hidden, _]| !shown && hidden),
        off: wrong(&|[shown, hidden, _]| !shown && !hidden),
        through: wrong(&|[shown, hidden, free]| !shown && hidden && !free),
    }
}

/// The share of samples that are right; each has a position, a length and the number of its line.
fn share_of_right_samples(places: impl Iterator<Item = (Point, f64, u32, bool)>) -> LengthShare {
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
    LengthShare { share: if all > 0.0 { right / all } else { 1.0 }, of: all, worst }
}

/// Lower limits of the drawn shares and upper limits of the wrong ones.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ShareLimits {
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
pub(crate) const FLAT_MODEL_LIMITS: ShareLimits = ShareLimits {
    outline: 0.998,
    contour: 0.985,
    crease: 0.92,
    leak: 0.002,
    off: 0.005,
    through: 0.0005,
    tolerance: 2.5,
};
/// Limits for scans and dense figures: small folds may be missing, the silhouette may not.
pub(crate) const ROUND_MODEL_LIMITS: ShareLimits =
    ShareLimits { contour: 0.80, crease: 0.0, leak: 0.005, off: 0.01, ..FLAT_MODEL_LIMITS };
/// Limits for meshes with both flat and rounded parts.
pub(crate) const MIXED_MODEL_LIMITS: ShareLimits = ShareLimits { crease: 0.92, ..ROUND_MODEL_LIMITS };
/// Limits for coarse figures whose silhouette is drawn smoother than the mesh.
pub(crate) const COARSE_MODEL_LIMITS: ShareLimits =
    ShareLimits { outline: 0.985, contour: 0.90, off: 0.02, tolerance: 15.0, ..ROUND_MODEL_LIMITS };

impl ShareLimits {
    /// A message for each limit that is violated; empty if the drawing is right.
    pub(crate) fn violations(&self, verdict: &DrawingShares) -> Vec<String> {
        let mut words = Vec::new();
        let mut say = |what: &str, share: LengthShare, limit: f64, falls: bool| {
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
