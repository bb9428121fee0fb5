//! Findings that no picture shows: names, classes, tones, and marks drawn over equal marks.

use kurbo::Shape as _;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::diff::findings::finding::{Change, Finding, FindingBox, FindingBoxKey, Verdict};
use crate::diff::shapes::ignore_options::Ignore;
use crate::diff::shapes::ink::ShapePaint;
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};

/// Changed properties that are invisible.
const INVISIBLE_CHANGES: [&str; 6] = ["part", "class", "layer", "tone", "hidden by", "edges"];

/// Whether a finding changes the look of the drawing.
pub(crate) fn is_seen(finding: &Finding) -> bool {
    match finding.verdict {
        Verdict::Page | Verdict::Relabelled | Verdict::Picture => false,
        Verdict::Restyled => {
            finding.changes.iter().any(|change| !is_unseen(change)) || finding.changes.is_empty()
        }
        _ => true,
    }
}

fn is_unseen(change: &Change) -> bool {
    INVISIBLE_CHANGES.contains(&change.what.as_str())
}

/// Removes the visible findings of two drawings that look the same. These invisible ones stay, because users
/// test them:
///
/// 1. another part, class, layer or tone;
/// 2. another order of marks, reported as relabelled, so that `--ignore labels` drops it;
/// 3. a mark drawn over an equal one, because pen plotters draw it twice;
/// 4. a mark of a part that the other drawing lacks, unless labels are ignored.
pub(crate) fn without_picture(
    findings: Vec<Finding>,
    pictures: [&Picture; 2],
    ignore: Ignore,
) -> Vec<Finding> {
    let mut kept = MarkInventory::default();
    let mut left = Vec::new();
    for mut finding in findings {
        match finding.verdict {
            Verdict::Page | Verdict::Relabelled => left.push(finding),
            Verdict::Restacked if !ignore.labels => {
                finding.verdict = Verdict::Relabelled;
                left.push(finding);
            }
            Verdict::Removed | Verdict::Added => {
                let side = usize::from(finding.verdict == Verdict::Added);
                if kept.is_copy(&finding, pictures, side)
                    || !ignore.labels && kept.belongs_to_missing_part(&finding, pictures, side)
                {
                    left.push(finding);
                }
            }
            _ => {
                finding.changes.retain(is_unseen);
                let relabelled =
                    finding.changes.iter().any(|c| matches!(c.what.as_str(), "part" | "class" | "layer"));
                if !finding.changes.is_empty() {
                    finding.verdict = if relabelled { Verdict::Relabelled } else { Verdict::Restyled };
                    left.push(finding);
                }
            }
        }
    }
    left
}

/// Paints of all marks of one box, label and kind.
type Inks<'a> = FxHashMap<(FindingBoxKey, &'a Label, ShapeKind), Vec<PaintCount<'a>>>;

/// Lookup tables of both pictures, built on first use.
#[derive(Default)]
struct MarkInventory<'a> {
    parts: Option<[FxHashSet<&'a str>; 2]>,
    inks: Option<Inks<'a>>,
}

/// Number of marks of each picture with one paint.
struct PaintCount<'a> {
    paint: &'a ShapePaint,
    width: f64,
    count: [usize; 2],
}

impl<'a> MarkInventory<'a> {
    /// Whether a mark belongs to a part that the other picture lacks.
    fn belongs_to_missing_part(
        &mut self,
        finding: &Finding,
        pictures: [&'a Picture; 2],
        side: usize,
    ) -> bool {
        let parts = self.parts.get_or_insert_with(|| {
            pictures.map(|picture| {
                picture.shapes.iter().filter_map(|shape| shape.label.part.as_deref()).collect()
            })
        });
        let is_mark = finding.kind != ShapeKind::Clip;
        is_mark && finding.label.part.as_deref().is_some_and(|part| !parts[1 - side].contains(part))
    }

    /// Whether a mark duplicates one that exists in both pictures with the same paint.
    fn is_copy(&mut self, finding: &Finding, pictures: [&'a Picture; 2], side: usize) -> bool {
        if finding.kind == ShapeKind::Clip {
            return false;
        }
        let inks = self.inks.get_or_insert_with(|| {
            let mut inks: Inks = FxHashMap::default();
            for (side, picture) in pictures.into_iter().enumerate() {
                for shape in picture.shapes.iter() {
                    let Shape { path, label, kind, ink, .. } = shape;
                    let place = FindingBox::of(path.bounding_box()).key();
                    let list: &mut Vec<PaintCount> = inks.entry((place, &**label, *kind)).or_default();
                    match list
                        .iter_mut()
                        .find(|c| *c.paint == ink.paint && c.width.to_bits() == ink.width.to_bits())
                    {
                        Some(counted) => counted.count[side] += 1,
                        None => {
                            let mut count = [0; 2];
                            count[side] = 1;
                            list.push(PaintCount { paint: &ink.paint, width: ink.width, count });
                        }
                    }
                }
            }
            inks
        });
        let list = inks.get(&(finding.place.key(), &finding.label, finding.kind));
        list.is_some_and(|list| {
            list.iter().any(|c| c.count[1 - side] > 0 && c.count[side] > c.count[1 - side])
        })
    }
}
