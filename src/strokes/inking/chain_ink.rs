//! Chains with their inks and pens as the shapes that are painted.
//!
//! 1. The axis of the chain is cut at gaps.
//! 2. Each piece is extended at its ends, gets its widths, and is moved by tremor.
//! 3. The piece becomes a path, or an outline if its width varies.

use super::frame_cut;
use super::ink_pieces::{InkedPiece, split_by_ink};
use super::ink_spans::{InkSpan, SpanInk};
use super::stroke_shape::StrokeShape;
use crate::chains::Chain;
use crate::colour::srgb::Colour;
use crate::geometry::numbers::noise::{hash, unit_interval};
use crate::geometry::plane::planar_distance::length;
use crate::lines::LineKind;
use crate::strokes::axes::axis_pieces::{AxisPart, PieceEnd, split_axis};
use crate::strokes::axes::stroke_axis::StrokeAxis;
use crate::strokes::brushes::brush;
use crate::strokes::gaps::gap_origin;
use crate::strokes::gaps::hand_gaps::HandGaps;
use crate::strokes::outlines::stroke_outline::{Nib, outline};
use crate::strokes::outlines::tremor::Tremor;
use crate::strokes::pens::ink_context::InkContext;
use crate::strokes::pens::pen::Pen;
use crate::strokes::tolerances;
use crate::strokes::widths::width_profile::{WidthSettings, mean, meet, taper};

/// Distance to either side that a line must cover on the border of painted surfaces, px. On smooth surfaces
/// lines are smoothed more than borders, so the distance is greater.
const BORDER_COVER_PX: f64 = 0.3;
const SMOOTH_BORDER_COVER_PX: f64 = 0.6;

/// Least extension of an end as a share of the greatest one.
const MIN_OVERSHOOT_SHARE: f64 = 0.35;

/// Greatest extension of an end as a share of its line.
const MAX_OVERSHOOT_OF_LENGTH: f64 = 0.2;

/// Side of the squares that identify chains, px. Chains of one kind and part that start in the same square
/// share a random seed, if nothing in the model distinguishes them.
const IDENTITY_CELL_PX: f64 = 96.0;

/// Separates the random seed of widths from all others.
const WIDTH_SEED: u64 = 0x7769_6474;

/// Chain with everything needed to draw it.
pub(crate) struct ChainInk<'a> {
    pub chain: &'a Chain,
    pub axis: &'a StrokeAxis,
    pub pen: &'a Pen,
    /// Widths before the ends are tapered.
    pub thick: &'a [f64],
    /// Widths of the lines that continue from its ends.
    pub joined: [Option<f64>; 2],
    /// Gaps where nearer lines pass over it.
    pub gaps: &'a [[f64; 2]],
    /// A stable number for each part.
    pub identities: &'a [u64],
    /// Depths that count as near and far.
    pub depths: [f64; 2],
    /// Whether its width may vary. It may not on dashed lines.
    pub solid: bool,
    /// Ink from its start to its end.
    pub inks: &'a [InkSpan],
}

impl ChainInk<'_> {
    /// The shapes of the line and their colours, pass by pass.
    pub(crate) fn shapes(&self, context: &InkContext) -> Vec<(StrokeShape, Colour)> {
        let (hand, px) = (&self.pen.hand, context.px());
        let seed = hash(context.seed, &[identity(self.chain, self.identities, context)]);
        let in_unit = |length: crate::drawing::Length| length.in_unit(context.unit);
        let lifts = hand.overshoot.value > 0.0;
        let leaving = frame_cut::leaving(self.chain, self.axis, context.frame, px);
        let leaving = [0, 1].map(|side| leaving[side].filter(|_| self.joined[side].is_none()));
        let past = frame_cut::past(leaving, self.axis.length(), self.pen, context.unit);
        let ends = [0, 1].map(|side| PieceEnd {
            tapers: self.joined[side].is_none(),
            runs_on: self.joined[side].is_none() && !self.chain.covered[side],
            past: past[side],
        });
        let setting = setting(self.chain, self.pen, self.depths, self.identities, context);
        let mut axis = self.axis.clone();
        let mut thick = self.thick.to_vec();
        if self.pen.swell.is_on() && !axis.closed {
            meet(&axis, &mut thick, self.joined, px);
        }
        // From here on, `strength` carries the width; the strengths themselves have been used.
        axis.samples.iter_mut().zip(&thick).for_each(|(sample, width)| sample.strength = *width);
        let breaks = HandGaps { mean: in_unit(hand.breaks), gap: in_unit(hand.break_gap), seed };
        let moored = gap_origin::gap_origin(self.chain, self.axis.length());
        let pieces: Vec<AxisPart> = split_axis(&axis, self.gaps, lifts, ends, px)
            .into_iter()
            .enumerate()
            .flat_map(|(k, piece)| breaks.split_at_gaps(piece, k, moored, px))
            .collect();
        let mut shapes = Vec::new();
        for pass in 0..u64::from(hand.passes.max(1)) {
            let pass_seed = hash(seed, &[1, pass]);
            let mut pins = axis.corner_arcs();
            if !axis.closed {
                pins.extend([0.0, axis.length()]);
            }
            let tremor = Tremor {
                amplitude: in_unit(hand.tremor),
                wave: in_unit(hand.tremor_length),
                stray: if pass > 0 { in_unit(hand.stray) } else { 0.0 },
                seed: pass_seed,
                pins,
                round: axis.closed.then(|| axis.length()),
                solid: hash(context.seed, &[part(self.chain, self.identities), pass]),
            };
            for (k, piece) in pieces.iter().enumerate() {
                let mut piece = piece.clone();
                let long = piece.axis.length();
                for side in 0..2 {
                    if piece.ends[side].past > 0.0 {
                        piece.axis.extend(side, piece.ends[side].past, px);
                    } else if piece.ends[side].runs_on && !piece.axis.closed {
                        let chance = unit_interval(hash(pass_seed, &[2, k as u64, side as u64]));
                        let part = MIN_OVERSHOOT_SHARE + (1.0 - MIN_OVERSHOOT_SHARE) * chance;
                        let most = in_unit(hand.overshoot).min(MAX_OVERSHOOT_OF_LENGTH * long);
                        piece.axis.extend(side, most * part, px);
                    }
                }
                shapes.extend(self.shapes_of(piece, &tremor, pass, &setting, context));
            }
        }
        shapes
    }

    fn shapes_of(
        &self,
        piece: AxisPart,
        tremor: &Tremor,
        pass: u64,
        setting: &WidthSettings,
        context: &InkContext,
    ) -> Vec<(StrokeShape, Colour)> {
        let swell = &self.pen.swell;
        let AxisPart { axis, ends } = piece;
        let mut axis = axis.subdivided();
        let mut thick: Vec<f64> = axis.samples.iter().map(|sample| sample.strength).collect();
        if !axis.closed && swell.taper.value > 0.0 {
            let over = swell.taper.in_unit(context.unit);
            let ends = ends.map(|end| end.tapers);
            taper(&axis, &mut thick, ends, over, swell.taper_to, setting.least());
        }
        let limits: Vec<f64> = match setting.covers {
            Some(to_side) if pass == 0 => {
                let own = |width: &f64| (width / 2.0 - to_side).max(0.0);
                if self.solid {
                    thick.iter().map(own).collect()
                } else {
                    vec![own(&setting.width); thick.len()]
                }
            }
            _ => vec![f64::INFINITY; thick.len()],
        };
        let before = axis.points.clone();
        tremor.shake(&mut axis, &limits);
        // A brush must still reach the border of the paint after its axis has moved.
        let covers = setting.covers.filter(|_| pass == 0 && self.pen.brush.is_some());
        let moved = before.iter().zip(&axis.points).map(|(from, to)| length(*to - *from));
        let reach: Vec<f64> = moved.map(|way| covers.map_or(0.0, |to_side| to_side + way)).collect();
        let drawn = InkedPiece { axis, thick, reach, caps: [self.pen.cap; 2] };
        let frame = context.frame.filter(|_| ends.iter().any(|end| end.past > 0.0));
        let cut = |shape: StrokeShape| match frame {
            Some(frame) => frame_cut::cut(shape, frame, context.px()),
            None => Some(shape),
        };
        if let [InkSpan { tint, .. }] = self.inks {
            let shape = self.shape(&drawn.times(tint.width), tint.colour, setting, context).and_then(cut);
            return shape.map(|shape| (shape, tint.colour)).into_iter().collect();
        }
        let round = self.chain.closed.then(|| self.axis.length());
        let parts = split_by_ink(&drawn, self.inks, round);
        let shape = |(part, tint): &(InkedPiece, SpanInk)| {
            Some((self.shape(part, tint.colour, setting, context).and_then(cut)?, tint.colour))
        };
        parts.iter().filter_map(shape).collect()
    }

    /// The shape of a piece with one ink.
    fn shape(
        &self,
        drawn: &InkedPiece,
        colour: Colour,
        setting: &WidthSettings,
        context: &InkContext,
    ) -> Option<StrokeShape> {
        let (InkedPiece { axis, thick, reach, caps }, px) = (drawn, context.px());
        let path = axis.path(px);
        if path.elements().len() < 2 {
            return None;
        }
        let nib = Nib { caps: *caps, join: self.pen.join, px };
        if let (true, Some(brush)) = (self.solid, &self.pen.brush) {
            let brushed = brush::brush_outline(brush, axis, thick, reach, &nib, (context.unit, colour))?;
            return Some(match brushed.image {
                Some((strip, pixels, pieces)) => {
                    StrokeShape::Image { path: brushed.path, strip, pixels, pieces }
                }
                None => StrokeShape::Outline { path: brushed.path, axis: path, width: brushed.width },
            });
        }
        let (low, high) = thick.iter().fold((f64::INFINITY, 0.0_f64), |(l, h), w| (l.min(*w), h.max(*w)));
        let varies = high - low > tolerances::MAX_WIDTH_DIFFERENCE_OF_PEN * setting.width
            || (high - setting.width).abs() > tolerances::MAX_WIDTH_DIFFERENCE_OF_PEN * setting.width;
        // A stroked path has equal caps at both ends.
        let is_cut = *caps != [self.pen.cap; 2];
        if !(self.solid && (varies || is_cut)) {
            return Some(StrokeShape::Path(path, axis.closed));
        }
        let halves: Vec<f64> = thick.iter().map(|width| width / 2.0).collect();
        let width = mean(axis, thick);
        outline(axis, [&halves, &halves], &nib).map(|outline| StrokeShape::Outline {
            path: outline,
            axis: path,
            width,
        })
    }
}

/// The stable number of a chain's part.
fn part(chain: &Chain, identities: &[u64]) -> u64 {
    identities.get(chain.part.index()).copied().unwrap_or_default()
}

/// Stable identity of a chain while the camera moves.
///
/// The chain's own number is used if it has one. Otherwise kind and part are combined with the mesh edge of
/// the chain, or with the page square where it starts. `identities` holds a stable number for each part.
fn identity(chain: &Chain, identities: &[u64], context: &InkContext) -> u64 {
    if chain.identity != 0 {
        return chain.identity;
    }
    let known = context.names.get(chain.segment as usize).copied().unwrap_or(0);
    let begins = || {
        let cell = |x: f64| ((x / (IDENTITY_CELL_PX * context.px())).floor() as i64).cast_unsigned();
        let p = chain.points.first().copied().unwrap_or_default();
        hash(1, &[cell(p.x), cell(p.y)])
    };
    let place = if known == 0 { begins() } else { known };
    hash(place, &[chain.kind as u64, part(chain, identities)])
}

/// Inputs of a chain's widths.
pub(crate) fn setting(
    chain: &Chain,
    pen: &Pen,
    depths: [f64; 2],
    identities: &[u64],
    context: &InkContext,
) -> WidthSettings {
    let chance = if pen.swell.chance > 0.0 {
        1.0 - pen.swell.chance
            * unit_interval(hash(context.seed, &[identity(chain, identities, context), WIDTH_SEED]))
    } else {
        1.0
    };
    let covers = context.painted && chain.invisibility == 0 && bounds(chain.kind);
    let to_side = if chain.smooth { SMOOTH_BORDER_COVER_PX } else { BORDER_COVER_PX };
    WidthSettings {
        width: pen.width.in_unit(context.unit),
        fade: pen.fade,
        swell: pen.swell,
        px: context.px(),
        depths,
        bend_radius: pen.swell.bend_radius.in_unit(context.unit),
        chance,
        covers: covers.then_some(context.px() * to_side),
    }
}

/// Whether painted surfaces may end at lines of a kind.
fn bounds(kind: LineKind) -> bool {
    use LineKind::{Border, Contour, Crease, Intersection, Isophote, Material};
    matches!(kind, Contour | Border | Crease | Material | Intersection | Isophote)
}
