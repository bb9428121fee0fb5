//! [`Inked`]: lines of a frame, sampled as points a few px apart.

use std::collections::BTreeMap;

use ligne::drawing::{Drawing, LayerKind, Mark, Paint};
use ligne::kurbo::{self, ParamCurveArclen, PathEl, Point, Vec2};

use super::seen::Seen;

/// Sample of a line: position, direction, and identity of its stroke.
#[derive(Clone, Copy)]
pub struct Bit {
    pub at: Point,
    pub along: Vec2,
    pub identity: u64,
}

/// Samples in a grid.
#[derive(Default)]
pub struct Bits {
    pub all: Vec<Bit>,
    cells: BTreeMap<[i64; 2], Vec<usize>>,
}

/// Frame with its lines, its hatching, and its depth buffer.
pub struct Inked {
    pub lengths: BTreeMap<u64, f64>,
    pub length: f64,
    pub lines: Bits,
    pub hatching: Bits,
    pub seen: Seen,
}

impl Inked {
    pub fn new(drawing: &Drawing, seen: Seen) -> Self {
        let marks = |kind: LayerKind| {
            drawing.layers.iter().filter(move |layer| layer.kind == kind).flat_map(|layer| &layer.marks)
        };
        let mut inked = Self {
            lengths: BTreeMap::new(),
            length: 0.0,
            lines: Bits::default(),
            hatching: Bits::default(),
            seen,
        };
        for mark in marks(LayerKind::Lines) {
            let length: f64 = axis(mark).segments().map(|segment| segment.arclen(0.1)).sum();
            *inked.lengths.entry(mark.provenance.identity).or_default() += length;
            inked.length += length;
            inked.lines.add(mark);
        }
        marks(LayerKind::Hatching).for_each(|mark| inked.hatching.add(mark));
        inked
    }
}

fn axis(mark: &Mark) -> &kurbo::BezPath {
    match &mark.paint {
        Paint::Outline(outline) => &outline.axis,
        _ => &mark.path,
    }
}

impl Bits {
    /// Maximum distance of samples that belong together, px.
    pub const REACH_PX: f64 = 3.0;

    /// Distance between samples along a line, px.
    pub const STEP_PX: f64 = 2.0;

    fn add(&mut self, mark: &Mark) {
        let mut last = Point::ZERO;
        kurbo::flatten(axis(mark).iter(), 0.1, |element| {
            if let PathEl::LineTo(to) = element {
                let count = (last.distance(to) / Self::STEP_PX).ceil().max(1.0) as usize;
                let along = (to - last).normalize();
                for step in 0..count {
                    let at = last.lerp(to, (step as f64 + 0.5) / count as f64);
                    self.cells.entry(cell(at)).or_default().push(self.all.len());
                    self.all.push(Bit { at, along, identity: mark.provenance.identity });
                }
            }
            if let PathEl::MoveTo(to) | PathEl::LineTo(to) = element {
                last = to;
            }
        });
    }

    /// Samples within [`Bits::REACH_PX`] of a point.
    pub fn near(&self, at: Point) -> impl Iterator<Item = &Bit> {
        let [x, y] = cell(at);
        let around = (-1..=1).flat_map(move |dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
        let bits = around.filter_map(|cell| self.cells.get(&cell)).flatten().map(|bit| &self.all[*bit]);
        bits.filter(move |bit| bit.at.distance(at) <= Self::REACH_PX)
    }
}

fn cell(at: Point) -> [i64; 2] {
    [(at.x / Bits::REACH_PX).floor() as i64, (at.y / Bits::REACH_PX).floor() as i64]
}
