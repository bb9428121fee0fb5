//! Findings about what is no picture: names, classes, tones, and marks that lie on their equals.

use kurbo::Shape as _;
use rustc_hash::{FxHashMap, FxHashSet};

use crate::diff::findings::finding::{Change, Finding, Place, PlaceKey, Verdict};
use crate::diff::shapes::ignore_options::Ignore;
use crate::diff::shapes::ink::Paint;
use crate::diff::shapes::label::Label;
use crate::diff::shapes::picture::{Picture, Shape, ShapeKind};

/// Changes that no picture shows.
const UNSEEN: [&str; 6] = ["part", "class", "layer", "tone", "hidden by", "edges"];

/// Whether a finding says that the picture is another one.
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
    UNSEEN.contains(&change.what.as_str())
}

/// What stays of findings where both pictures look the same: what people keep under test though it is not seen.
///
/// 1. Another part, class, layer or tone of a mark stays.
/// 2. Another order of marks is told as another label: `--ignore labels` leaves it out.
/// 3. A mark that lies on its equal stays: pens draw it twice.
/// 4. A mark of a part that the other drawing has not at all stays, unless labels are ignored.
pub(crate) fn without_picture(
    findings: Vec<Finding>,
    pictures: [&Picture; 2],
    ignore: Ignore,
) -> Vec<Finding> {
    let mut kept = Kept::default();
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
                    || !ignore.labels && kept.is_of_lost_part(&finding, pictures, side)
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

/// The paints of the marks of one place, label and kind.
type Inks<'a> = FxHashMap<(PlaceKey, &'a Label, ShapeKind), Vec<Counted<'a>>>;

/// What both pictures have, found when it is asked for.
#[derive(Default)]
struct Kept<'a> {
    parts: Option<[FxHashSet<&'a str>; 2]>,
    inks: Option<Inks<'a>>,
}

/// How many marks of either picture have one paint.
struct Counted<'a> {
    paint: &'a Paint,
    width: f64,
    count: [usize; 2],
}

impl<'a> Kept<'a> {
    /// Whether a mark is of a part that the other picture has not.
    fn is_of_lost_part(&mut self, finding: &Finding, pictures: [&'a Picture; 2], side: usize) -> bool {
        let parts = self.parts.get_or_insert_with(|| {
            pictures.map(|picture| {
                picture.shapes.iter().filter_map(|shape| shape.label.part.as_deref()).collect()
            })
        });
        let is_mark = finding.kind != ShapeKind::Clip;
        is_mark && finding.label.part.as_deref().is_some_and(|part| !parts[1 - side].contains(part))
    }

    /// Whether a mark lies on one that is in both pictures, and is painted alike.
    fn is_copy(&mut self, finding: &Finding, pictures: [&'a Picture; 2], side: usize) -> bool {
        if finding.kind == ShapeKind::Clip {
            return false;
        }
        let inks = self.inks.get_or_insert_with(|| {
            let mut inks: Inks = FxHashMap::default();
            for (side, picture) in pictures.into_iter().enumerate() {
                for shape in picture.shapes.iter() {
                    let Shape { path, label, kind, ink, .. } = shape;
                    let place = Place::of(path.bounding_box()).key();
                    let list: &mut Vec<Counted> = inks.entry((place, &**label, *kind)).or_default();
                    match list
                        .iter_mut()
                        .find(|c| *c.paint == ink.paint && c.width.to_bits() == ink.width.to_bits())
                    {
                        Some(counted) => counted.count[side] += 1,
                        None => {
                            let mut count = [0; 2];
                            count[side] = 1;
                            list.push(Counted { paint: &ink.paint, width: ink.width, count });
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
