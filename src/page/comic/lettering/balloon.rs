//! [`Balloon`]: a text in an outline that includes the tail.
//!
//! 1. The text is set in an ellipse, or in a box for captions.
//! 2. The outline depends on the kind: ellipse, cloud, burst or box. Spikes and bumps vary with a hash of the
//!    text.
//! 3. The tail is part of the outline, except for thought balloons, which have bubbles.

use std::f64::consts::{PI, TAU};

use kurbo::{Affine, Arc, BezPath, Circle, Point, RoundedRect, Shape, Vec2};

use crate::colour::srgb::Colour;
use crate::drawing::{Cap, Join, Mark, Paint, Provenance, StrokePaint};
use crate::error::Error;
use crate::geometry::numbers::noise::hash;
use crate::geometry::numbers::portable_math::{atan2, cos, sin};
use crate::page::comic::comic_keys::BalloonKind;
use crate::page::layout::ConvexPolygon;
use crate::text::{Setting, TextBlock};

/// Padding between letters and outline, in ems.
const PADDING_EM: f64 = 0.55;
/// Half the width of a tail where it leaves the balloon, in ems.
const TAIL_HALF_WIDTH_EM: f64 = 0.42;
/// Height of the spikes of a burst and of the bumps of a cloud outside the ellipse, in ems.
const SPIKE_HEIGHT_EM: f64 = 1.1;
const BUMP_HEIGHT_EM: f64 = 0.75;
/// Factor of the aspect ratio for captions.
const CAPTION_ASPECT_FACTOR: f64 = 0.75;
/// Number of sides of the hull polygon.
const HULL_SIDES: usize = 24;
/// Tolerance of curves, mm.
const CURVE_TOLERANCE_MM: f64 = 0.005;

/// A text in an outline, both centred at the origin.
pub(crate) struct Balloon {
    kind: BalloonKind,
    /// The set text.
    pub block: TextBlock,
    /// Half width and half height of the ellipse or box around the text, with padding.
    half: Vec2,
    em: f64,
    seed: u64,
}

/// Colours and line width of a balloon.
pub(crate) struct BalloonPaint {
    pub fill: Colour,
    pub colour: Colour,
    /// Line width, mm.
    pub line: f64,
}

impl Balloon {
    /// Sets a text in a balloon whose height is about `aspect` times its width.
    ///
    /// # Errors
    /// Returns an error if the text is empty, or no font has a glyph.
    pub(crate) fn new(text: &str, kind: BalloonKind, setting: &Setting, aspect: f64) -> Result<Self, Error> {
        if text.trim().is_empty() {
            return Err(Error::new("this balloon has no text").remedy("write its text, or leave it out"));
        }
        let em = setting.em();
        let pad = Vec2::new(PADDING_EM, PADDING_EM) * em;
        let (block, half) = match kind {
            BalloonKind::Caption => {
                // A box holds more text in its corners and should look flatter than an ellipse.
                let (ellipse, _) =
                    TextBlock::in_ellipse(text, setting, CAPTION_ASPECT_FACTOR * aspect * aspect)?;
                // 0.1 % wider than the longest line, because widths are sums with rounding errors.
                let block = TextBlock::balanced(text, setting, ellipse.width * 1.001)?;
                let half = Vec2::new(block.width, block.height) / 2.0 + pad;
                (block, half)
            }
            _ => {
                let (block, half) = TextBlock::in_ellipse(text, setting, aspect)?;
                (block, half + pad)
            }
        };
        let words: Vec<u64> = text.chars().map(|c| u64::from(u32::from(c))).collect();
        Ok(Self { kind, block, half, em, seed: hash(0, &words) })
    }

    /// Half width and half height of the balloon with spikes or bumps.
    fn reach(&self) -> Vec2 {
        let beyond = match self.kind {
            BalloonKind::Shout => SPIKE_HEIGHT_EM,
            BalloonKind::Thought => BUMP_HEIGHT_EM,
            _ => 0.0,
        };
        self.half + Vec2::new(beyond, beyond) * self.em
    }

    /// Em size of the letters.
    pub(crate) fn em(&self) -> f64 {
        self.em
    }

    /// Minimum length of the tail.
    pub(crate) fn shortest_tail(&self) -> f64 {
        self.em * if self.kind == BalloonKind::Thought { 2.4 } else { 1.4 }
    }

    /// Half the width of the tail at the balloon, including its line.
    pub(crate) fn foot(&self) -> f64 {
        self.em
            * match self.kind {
                BalloonKind::Shout => 1.4,
                BalloonKind::Thought => 0.6,
                _ => TAIL_HALF_WIDTH_EM + 0.15,
            }
    }

    /// A polygon around the balloon without its tail, centred at the origin.
    pub(crate) fn hull(&self) -> ConvexPolygon {
        let reach = self.reach();
        if self.kind == BalloonKind::Caption {
            return ConvexPolygon::from(kurbo::Rect::new(-reach.x, -reach.y, reach.x, reach.y));
        }
        let grown = 1.0 / cos(PI / HULL_SIDES as f64);
        let corner = |k: usize| {
            let angle = TAU * k as f64 / HULL_SIDES as f64;
            Point::new(reach.x * cos(angle), reach.y * sin(angle)).to_vec2() * grown
        };
        ConvexPolygon((0..HULL_SIDES).map(|k| corner(k).to_point()).collect())
    }

    /// The outline and the letters of the balloon. `middle` is its centre, `tip` the end of its tail.
    pub(crate) fn marks(&self, middle: Point, tip: Option<Point>, ink: &BalloonPaint) -> Vec<Mark> {
        let place = Affine::translate(middle.to_vec2());
        let tip = tip.map(|tip| tip - middle);
        let mut outline = place * self.outline(tip);
        if let Some(tip) = tip.filter(|_| self.kind == BalloonKind::Thought) {
            outline.extend(place * self.bubbles(tip));
        }
        let provenance = |class| Provenance { classes: vec!["balloon", class], ..Provenance::default() };
        let class = match self.kind {
            BalloonKind::Speech => "speech",
            BalloonKind::Thought => "thought",
            BalloonKind::Shout => "shout",
            BalloonKind::Whisper => "whisper",
            BalloonKind::Caption => "caption",
        };
        let dash =
            if self.kind == BalloonKind::Whisper { vec![self.em * 0.5, self.em * 0.4] } else { Vec::new() };
        let stroke = StrokePaint {
            width: ink.line,
            colour: ink.colour,
            cap: if dash.is_empty() { Cap::Round } else { Cap::Butt },
            join: Join::Miter,
            dash,
            dash_offset: 0.0,
        };
        let mut marks = vec![
            Mark { path: outline.clone(), paint: Paint::Fill(ink.fill), provenance: provenance(class) },
            Mark { path: outline, paint: Paint::Stroke(stroke), provenance: provenance(class) },
        ];
        let corner = middle - Vec2::new(self.block.width, self.block.height) / 2.0;
        marks.extend(self.block.marks(corner, ink.colour));
        marks
    }

    /// The outline with its tail, centred at the origin.
    fn outline(&self, tip: Option<Vec2>) -> BezPath {
        match self.kind {
            BalloonKind::Speech | BalloonKind::Whisper => self.ellipse(tip),
            BalloonKind::Thought => self.cloud(),
            BalloonKind::Shout => self.burst(tip),
            BalloonKind::Caption => {
                let (x, y) = (self.half.x, self.half.y);
                RoundedRect::new(-x, -y, x, y, self.em * 0.12).to_path(CURVE_TOLERANCE_MM)
            }
        }
    }

    fn on_ellipse(&self, half: Vec2, angle: f64) -> Point {
        Point::new(half.x * cos(angle), half.y * sin(angle))
    }

    /// The parameter of the ellipse where the ray from the centre to a point leaves it.
    fn angle(&self, to: Vec2) -> f64 {
        atan2(to.y / self.half.y, to.x / self.half.x)
    }

    /// An ellipse with a tail: the arc outside the tail, then two curves to the tip and back.
    fn ellipse(&self, tip: Option<Vec2>) -> BezPath {
        let half = self.half;
        let Some(tip) = tip else {
            return kurbo::Ellipse::new((0.0, 0.0), half, 0.0).to_path(CURVE_TOLERANCE_MM);
        };
        let middle = self.angle(tip);
        let along = Vec2::new(-half.x * sin(middle), half.y * cos(middle)).hypot();
        let wide = (TAIL_HALF_WIDTH_EM * self.em / along).min(PI / 6.0);
        let arc = Arc::new((0.0, 0.0), half, middle + wide, TAU - 2.0 * wide, 0.0);
        let mut path = BezPath::new();
        let (from, to) = (self.on_ellipse(half, middle + wide), self.on_ellipse(half, middle - wide));
        path.move_to(from);
        path.extend(arc.append_iter(CURVE_TOLERANCE_MM));
        // Both sides of the tail bend slightly in the same direction.
        let aside = Vec2::new(tip.y, -tip.x) * 0.06 * if tip.x < 0.0 { -1.0 } else { 1.0 };
        let tip = tip.to_point();
        let bend = |foot: Point| foot.lerp(tip, 0.5) + aside;
        path.quad_to(bend(to), tip);
        path.quad_to(bend(from), from);
        path.close_path();
        path
    }

    /// An ellipse of bumps.
    fn cloud(&self) -> BezPath {
        let girth = PI * (self.half.x + self.half.y);
        let count = (girth / (2.6 * self.em)).round().max(6.0) as u64;
        let mut path = BezPath::new();
        let angle = |k: u64| {
            let stray = (hash(self.seed, &[k % count]) % 1000) as f64 / 1000.0 - 0.5;
            TAU * (k as f64 + 0.35 * stray) / count as f64
        };
        for k in 0..=count {
            let at = self.on_ellipse(self.half, angle(k));
            if k == 0 {
                path.move_to(at);
                continue;
            }
            let before = self.on_ellipse(self.half, angle(k - 1));
            let out = self.on_ellipse(self.half, (angle(k - 1) + angle(k)) / 2.0).to_vec2().normalize();
            // A cubic reaches three quarters of the distance to its handles.
            let out = out * (BUMP_HEIGHT_EM * self.em);
            path.curve_to(before + out, at + out, at);
        }
        path.close_path();
        path
    }

    /// Bubbles of decreasing size towards the tip of the tail.
    fn bubbles(&self, tip: Vec2) -> BezPath {
        let angle = self.angle(tip);
        let reach = self.on_ellipse(self.reach(), angle).to_vec2();
        let mut path = BezPath::new();
        for (share, radius) in [(0.18, 0.5), (0.58, 0.36), (0.92, 0.24)] {
            let at = reach.lerp(tip, share).to_point();
            path.extend(Circle::new(at, radius * self.em).to_path(CURVE_TOLERANCE_MM));
        }
        path
    }

    /// A star of spikes; the first spike is the tail.
    fn burst(&self, tip: Option<Vec2>) -> BezPath {
        let girth = PI * (self.half.x + self.half.y);
        let count = (girth / (2.1 * self.em)).round().max(9.0) as u64;
        let towards = tip.map(|tip| self.angle(tip));
        let step = TAU / count as f64;
        let first = towards.unwrap_or(0.0);
        let mut path = BezPath::new();
        for k in 0..count {
            let chance = |n: u64| (hash(self.seed, &[k, n]) % 1000) as f64 / 1000.0;
            let middle = first + step * k as f64;
            // Letters end at the ellipse; spikes reach up to `SPIKE_HEIGHT_EM` ems outside it.
            let out = SPIKE_HEIGHT_EM * self.em * (0.55 + 0.45 * chance(0));
            let spike = match tip.filter(|_| k == 0) {
                Some(tip) => tip.to_point(),
                None => {
                    self.on_ellipse(self.half + Vec2::new(out, out), middle + step * 0.25 * (chance(1) - 0.5))
                }
            };
            let valley =
                |at: f64| self.on_ellipse(self.half + Vec2::new(PADDING_EM, PADDING_EM) * 0.2 * self.em, at);
            if k == 0 {
                path.move_to(valley(middle - step / 2.0));
            }
            path.line_to(spike);
            path.line_to(valley(middle + step / 2.0));
        }
        path.close_path();
        path
    }
}
