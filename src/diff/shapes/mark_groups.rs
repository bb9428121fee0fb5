//! Labels and inks as group numbers, so that each combination is compared once instead of once per pair of
//! segments.

use std::sync::Arc;

use rustc_hash::FxHashMap;

use super::ignore_options::Ignore;
use super::ink::ShapeInk;
use super::label::Label;
use super::picture::{Picture, Shape, ShapeKind};
use super::tolerance_table::{Tolerances, default_px};

/// Difference of two marks except for geometry, in increasing order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum Likeness {
    /// Same label and same ink.
    Same,
    /// Another ink.
    Ink,
    /// Another part, class or layer.
    Label,
    /// Another label and another ink.
    Both,
}

/// Properties shared by all shapes of one label and one ink.
#[derive(Debug, Clone)]
pub(crate) struct MarkGroup {
    pub kind: ShapeKind,
    /// Part of the model.
    part: Option<Arc<str>>,
    label: usize,
    ink: ShapeInk,
    /// Largest distance in px between marks that count as equal.
    pub tolerance: f64,
}

/// Groups of two pictures.
#[derive(Debug)]
pub(crate) struct MarkGroups {
    pub groups: Vec<MarkGroup>,
    /// Group number of each shape of each picture.
    pub of_shape: [Vec<usize>; 2],
}

impl MarkGroups {
    /// Assigns group numbers to the shapes of two pictures.
    pub(crate) fn new(pictures: [&Picture; 2], tolerances: &Tolerances, ignore: Ignore) -> Self {
        let fallback = default_px(pictures[0], pictures[1]);
        // Drawings grouped by part have no layers; then layers are not compared.
        let layered = pictures.map(|p| p.shapes.iter().any(|shape| !shape.label.layer.is_empty()));
        let by_layer = layered[0] == layered[1];
        let mut labels: FxHashMap<Label, usize> = FxHashMap::default();
        let mut known: FxHashMap<(usize, ShapeKind, InkKey), usize> = FxHashMap::default();
        let mut groups = Vec::new();
        let mut group_of = |shape: &Shape| {
            let mut label = ignore.label(&shape.label);
            let ink = ignore.ink(&shape.ink);
            if !by_layer {
                label.layer = "".into();
            }
            let count = labels.len();
            let label = *labels.entry(label).or_insert(count);
            *known.entry((label, shape.kind, key(&ink))).or_insert_with(|| {
                let tolerance = tolerances.px(&shape.label, shape.ink.tone, shape.kind, fallback);
                let part = shape.label.part.clone().filter(|_| !ignore.labels);
                groups.push(MarkGroup { kind: shape.kind, part, label, ink, tolerance });
                groups.len() - 1
            })
        };
        let of_shape = pictures.map(|picture| picture.shapes.iter().map(&mut group_of).collect());
        Self { groups, of_shape }
    }

    /// Largest distance in px between marks of a group that count as equal.
    pub(crate) fn tolerance(&self, group: usize) -> f64 {
        self.groups.get(group).map_or(0.01, |group| group.tolerance)
    }

    /// Whether two groups belong to the same part.
    pub(crate) fn same_part(&self, a: usize, b: usize) -> bool {
        self.groups.get(a).map(|group| &group.part) == self.groups.get(b).map(|group| &group.part)
    }

    /// Difference of two groups; `None` for marks of different kinds, such as a line and a region.
    pub(crate) fn likeness(&self, a: usize, b: usize) -> Option<Likeness> {
        if a == b {
            return Some(Likeness::Same);
        }
        let (a, b) = (self.groups.get(a)?, self.groups.get(b)?);
        if a.kind != b.kind {
            return None;
        }
        Some(match (a.label == b.label, a.ink.is_like(&b.ink)) {
            (true, true) => Likeness::Same,
            (true, false) => Likeness::Ink,
            (false, true) => Likeness::Label,
            (false, false) => Likeness::Both,
        })
    }
}

/// An ink as a hash key, with numbers by their bits.
type InkKey = (
    super::ink::ShapePaint,
    u64,
    Vec<u64>,
    [u8; 4],
    Option<u16>,
    u16,
    Option<Arc<super::placeholder::Details>>,
);

fn key(ink: &ShapeInk) -> InkKey {
    let dash = ink.dash.iter().map(|length| length.to_bits()).collect();
    let forms = [ink.cap as u8, ink.join as u8, u8::from(ink.outlined), u8::from(ink.is_crisp)];
    (ink.paint.clone(), ink.width.to_bits(), dash, forms, ink.tone, ink.invisibility, ink.details.clone())
}
