//! [`Sheet`]: what of a drawing DXF is made of, and in which lengths.

use kurbo::{Affine, Point};

use crate::drawing::{Drawing, LayerKind, Mark, Paint, Unit};

/// Which release of DXF is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DxfVersion {
    /// Release 12 of 1992, which every program reads. It knows neither fills nor widths of lines.
    #[default]
    R12,
    /// Release 2000: with fills as solid hatches, widths of lines, and the unit of lengths.
    R2000,
}

/// What a unit of length in the file is.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum DxfLength {
    /// A millimetre of the page; a px is 1/96 inch.
    #[default]
    Page,
    /// A unit of the model, of which one is so many user units of the drawing. Only parallel views have such a number.
    Model(f64),
}

/// How DXF is written.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct DxfOptions {
    /// Default: release 12.
    pub version: DxfVersion,
    /// Default: millimetres of the page.
    pub length: DxfLength,
    /// The point of the page that is (0, 0) in the file, user units, y down. Default: the lower left corner.
    pub origin: Option<[f64; 2]>,
}

impl DxfOptions {
    /// With another release.
    #[must_use]
    pub const fn with_version(mut self, version: DxfVersion) -> Self {
        self.version = version;
        self
    }

    /// With another unit of length.
    #[must_use]
    pub const fn with_length(mut self, length: DxfLength) -> Self {
        self.length = length;
        self
    }

    /// With another point of the page at (0, 0), in user units, y down.
    #[must_use]
    pub const fn with_origin(mut self, origin: [f64; 2]) -> Self {
        self.origin = Some(origin);
        self
    }
}

/// Largest distance of lines and arcs from their curves, mm. The curves themselves take the rest of 0.02 mm ([`Style::to_scale`]).
///
/// [`Style::to_scale`]: crate::Style::to_scale
const TOLERANCE_MM: f64 = 0.008;

const MM_PER_PX: f64 = 25.4 / 96.0;

/// What of a drawing DXF is made of.
pub(crate) struct Sheet<'a> {
    pub(crate) version: DxfVersion,
    /// From the drawing to the file.
    pub(crate) place: Affine,
    /// Lengths of the file in a user unit.
    pub(crate) scale: f64,
    /// How far a curve may be from its own, in lengths of the file.
    pub(crate) tolerance: f64,
    /// The lower left and the upper right corner of the page in the file.
    pub(crate) corners: [[f64; 2]; 2],
    /// Millimetres in a user unit, for widths of pens.
    pub(crate) mm_per_unit: f64,
    /// Whether a length of the file is a millimetre.
    pub(crate) in_mm: bool,
    pub(crate) marks: Vec<(LayerKind, &'a Mark)>,
}

impl<'a> Sheet<'a> {
    pub(crate) fn new(drawing: &'a Drawing, options: &DxfOptions) -> Self {
        let page = &drawing.page;
        let mm_per_unit = match page.unit {
            Unit::Px => MM_PER_PX,
            Unit::Mm => 1.0,
        };
        let tolerance = TOLERANCE_MM / mm_per_unit;
        let (scale, in_mm) = match options.length {
            DxfLength::Page => (mm_per_unit, true),
            DxfLength::Model(per_unit) if per_unit.is_finite() && per_unit > 0.0 => (1.0 / per_unit, false),
            DxfLength::Model(_) => (mm_per_unit, true),
        };
        let [left, bottom] =
            options.origin.filter(|at| at.iter().all(|x| x.is_finite())).unwrap_or([0.0, page.height]);
        let place = Affine::new([scale, 0.0, 0.0, -scale, -left * scale, bottom * scale]);
        let drawn = drawing.layers.iter().filter(|layer| is_drawn(layer.kind));
        let marks = drawn.flat_map(|layer| layer.marks.iter().map(|mark| (layer.kind, mark)));
        let marks = marks.filter(|(_, mark)| is_told(mark, options.version)).collect();
        let corners = [[0.0, page.height], [page.width, 0.0]].map(|[x, y]| {
            let corner = place * Point::new(x, y);
            [corner.x, corner.y]
        });
        let version = options.version;
        Self { version, place, scale, tolerance: tolerance * scale, corners, mm_per_unit, in_mm, marks }
    }
}

/// Paper and its texture are none of a plan.
pub(crate) fn is_drawn(kind: LayerKind) -> bool {
    !matches!(kind, LayerKind::Paper | LayerKind::Tooth)
}

/// Whether a mark has a place in the file.
pub(crate) fn is_told(mark: &Mark, version: DxfVersion) -> bool {
    match &mark.paint {
        Paint::Stroke(_) | Paint::Outline(_) => true,
        Paint::Fill(_) | Paint::Gradient(_) => version == DxfVersion::R2000,
        Paint::Image(_) => false,
    }
}
