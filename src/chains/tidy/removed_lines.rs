//! [`Removed`]: what tidying leaves out and why, kept for those who ask.

use kurbo::Point;

use super::raw_line::{Degrees, Raw};
use crate::lines::LineKind;
use crate::surface::Origin;

/// Why a line was left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum Reason {
    /// Short, and hangs on nothing.
    Crumb,
    /// Short, and hangs on another line by one end.
    Spur,
    /// The stub of a line beyond the place where it is sewn to another.
    Stub,
    /// A short ring.
    Loop,
    /// Runs beside a longer line.
    Double,
    /// A crease of a scan that may be noise.
    Noise,
    /// A line inside that is too short for how weak it is.
    Weak,
    /// Less than a dot of the pen.
    Point,
}

impl Reason {
    /// All reasons.
    pub const ALL: [Self; 8] =
        [Self::Crumb, Self::Spur, Self::Stub, Self::Loop, Self::Double, Self::Noise, Self::Weak, Self::Point];

    /// The class name in SVG.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Crumb => "crumb",
            Self::Spur => "spur",
            Self::Stub => "stub",
            Self::Loop => "loop",
            Self::Double => "double",
            Self::Noise => "noise",
            Self::Weak => "weak",
            Self::Point => "point",
        }
    }

    /// Why a line is a crumb that was found to be one.
    pub(crate) fn of_crumb(raw: &Raw, degrees: &Degrees) -> Self {
        let ends = [0, 1].map(|side| raw.covered[side] || degrees.is_free(raw.ends[side]));
        match raw.class.kind {
            kind if kind.is_inside() => Self::Weak,
            LineKind::Crease if raw.class.origin == Origin::Scanned => Self::Noise,
            _ if raw.is_ring() => Self::Loop,
            _ if ends[0] && ends[1] => Self::Crumb,
            _ => Self::Spur,
        }
    }
}

/// A line or a part of one that was left out.
#[derive(Debug, Clone, PartialEq)]
pub struct Removed {
    /// Points in user units of the page.
    pub points: Vec<Point>,
    /// Whether the last point joins the first.
    pub closed: bool,
    /// What line it was.
    pub kind: LineKind,
    /// Why it went.
    pub reason: Reason,
}

/// Where tidying puts what it leaves out; costs nothing where nobody asks.
#[derive(Debug, Default)]
pub(crate) struct Bin(Option<Vec<Removed>>);

impl Bin {
    /// A bin that keeps what is put into it.
    pub fn kept() -> Self {
        Self(Some(Vec::new()))
    }

    /// Takes a whole line.
    pub fn put(&mut self, raw: &Raw, reason: impl FnOnce() -> Reason) {
        if let Some(kept) = &mut self.0 {
            let (points, closed) = (raw.line.points.clone(), raw.line.closed);
            kept.push(Removed { points, closed, kind: raw.class.kind, reason: reason() });
        }
    }

    /// Takes a part of a line.
    pub fn put_part(&mut self, raw: &Raw, reason: Reason, points: impl FnOnce() -> Vec<Point>) {
        if let Some(kept) = &mut self.0 {
            kept.push(Removed { points: points(), closed: false, kind: raw.class.kind, reason });
        }
    }

    /// Takes a piece that became part of no line.
    pub fn put_piece(&mut self, kind: LineKind, reason: Reason, ends: [Point; 2]) {
        if let Some(kept) = &mut self.0 {
            kept.push(Removed { points: ends.to_vec(), closed: false, kind, reason });
        }
    }

    /// All that was put into it.
    pub fn emptied(self) -> Vec<Removed> {
        self.0.unwrap_or_default()
    }
}
