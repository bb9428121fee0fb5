//! The marks of a drawing that DXF contains, with units and options.

use kurbo::{Affine, Point};

use crate::drawing::{Drawing, LayerKind, Mark, Paint};

/// Release of DXF to write.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum DxfVersion {
    /// Release 12 of 1992, which every program reads. It has no fills and no line widths.
    #[default]
    R12,
    /// Release 2000, with fills as solid hatches, line widths and a unit of length.
    R2000,
}

/// Unit of length in the file.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub enum DxfLength {
    /// A millimetre of the page; a px is 1/96 inch.
    #[default]
    Page,
    /// A unit of the model, which measures this many user units of the drawing. Defined for parallel views
    /// only.
    Model(f64),
}

/// Options of DXF.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct DxfOptions {
    /// Release. Default: release 12.
    pub version: DxfVersion,
    /// Unit of length. Default: millimetres of the page.
    pub length: DxfLength,
    /// The page point that becomes (0, 0) in the file, in user units, y down. Default: the lower left corner.
    pub origin: Option<[f64; 2]>,
}

impl DxfOptions {
    /// Sets the release.
    #[must_use]
    pub const fn with_version(mut self, version: DxfVersion) -> Self {
        self.version = version;
        self
    }

    /// Sets the unit of length.
    #[must_use]
    pub const fn with_length(mut self, length: DxfLength) -> Self {
        self.length = length;
        self
    }

    /// Sets the page point that becomes (0, 0), in user units, y down.
    #[must_use]
    pub const fn with_origin(mut self, origin: [f64; 2]) -> Self {
        self.origin = Some(origin);
        self
    }
}

/// Largest distance of lines and arcs from their curves, in mm. The curves take the rest of 0.02 mm
/// ([`Style::to_scale`]).
///
/// [`Style::to_scale`]: crate::Style::to_scale
const TOLERANCE_MM: f64 = 0.008;

/// The marks and units of a DXF file.
pub(crate) struct DxfSource<'a> {
    pub(crate) version: DxfVersion,
    /// Transform from the drawing to the file.
    pub(crate) place: Affine,
    /// File units per user unit.
    pub(crate) scale: f64,
    /// Tolerance of curves in file units.
    pub(crate) tolerance: f64,
    /// Lower left and upper right corner of the page in the file.
    pub(crate) corners: [[f64; 2]; 2],
    /// Millimetres per user unit, for pen widths.
    pub(crate) mm_per_unit: f64,
    /// Whether a file unit is a millimetre.
    pub(crate) in_mm: bool,
    pub(crate) marks: Vec<(LayerKind, &'a Mark)>,
}

impl<'a> DxfSource<'a> {
    pub(crate) fn new(drawing: &'a Drawing, options: &DxfOptions) -> Self {
        let page = &drawing.page;
        let mm_per_unit = page.unit.mm();
        let tolerance = TOLERANCE_MM / mm_per_unit;
        let (scale, in_mm) = match options.length {
            DxfLength::Page => (mm_per_unit, true),
            DxfLength::Model(per_unit) if per_unit.is_finite() && per_unit > 0.0 => (1.0 / per_unit, false),
            DxfLength::Model(_) => (mm_per_unit, true),
        };
        let [left, bottom] =
            options.origin.filter(|at| at.iter().all(|x| x.is_finite())).unwrap_or([0.0, page.height]);
        let place = Affine::new([scale, 0.0, 0.0, -scale, -left * scale, bottom * scale]);
        let drawn = drawing.layers.iter().filter(|layer| is_exported_layer(layer.kind));
        let marks = drawn.flat_map(|layer| layer.marks.iter().map(|mark| (layer.kind, mark)));
        let marks = marks.filter(|(_, mark)| is_exported(mark, options.version)).collect();
        let corners = [[0.0, page.height], [page.width, 0.0]].map(|[x, y]| {
            let corner = place * Point::new(x, y);
            [corner.x, corner.y]
        });
        let version = options.version;
        Self { version, place, scale, tolerance: tolerance * scale, corners, mm_per_unit, in_mm, marks }
    }
}

/// Whether a layer is written. Paper and its texture are not.
pub(crate) fn is_exported_layer(kind: LayerKind) -> bool {
    !matches!(kind, LayerKind::Paper | LayerKind::Tooth)
}

/// Whether a mark is written.
pub(crate) fn is_exported(mark: &Mark, version: DxfVersion) -> bool {
    match &mark.paint {
        Paint::Stroke(_) | Paint::Outline(_) => true,
        Paint::Fill(_) | Paint::Gradient(_) => version == DxfVersion::R2000,
        Paint::Image(_) => false,
    }
}
