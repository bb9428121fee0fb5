//! [`LineKind`]: the kinds of feature lines, from strong to weak.

use serde::{Deserialize, Serialize};

/// Kind of a feature line. Earlier kinds are stronger: where two lines coincide, the stronger one is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
#[non_exhaustive]
pub enum LineKind {
    /// Where the surface turns from facing to averted.
    Contour,
    /// An edge with one face.
    Border,
    /// An edge where the surface turns by more than an angle.
    Crease,
    /// An edge between two materials.
    Material,
    /// Where two surfaces pass through each other.
    Intersection,
    /// A contour that would appear from a nearby viewpoint.
    Suggestive,
    /// Where the larger curvature has a maximum along its direction.
    Ridge,
    /// Where the smaller curvature has a minimum along its direction.
    Valley,
    /// Where painted colours change.
    Artist,
    /// Where the tone changes.
    Isophote,
    /// Found in the image, not on the surface.
    Image,
    /// A line of the model that belongs to no face.
    Wire,
    /// Trail of a moving vertex.
    Motion,
}

impl LineKind {
    /// All kinds, strongest first.
    pub const ALL: [Self; 13] = [
        Self::Contour,
        Self::Border,
        Self::Crease,
        Self::Material,
        Self::Intersection,
        Self::Suggestive,
        Self::Ridge,
        Self::Valley,
        Self::Artist,
        Self::Isophote,
        Self::Image,
        Self::Wire,
        Self::Motion,
    ];

    /// Whether lines of this kind lie inside the surface's contours and may be weak.
    #[must_use]
    pub const fn is_inside(self) -> bool {
        matches!(self, Self::Suggestive | Self::Ridge | Self::Valley)
    }

    /// The class name in SVG and style sheets.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Contour => "contour",
            Self::Border => "border",
            Self::Crease => "crease",
            Self::Material => "material",
            Self::Intersection => "intersection",
            Self::Suggestive => "suggestive",
            Self::Ridge => "ridge",
            Self::Valley => "valley",
            Self::Artist => "artist",
            Self::Isophote => "isophote",
            Self::Image => "image",
            Self::Wire => "wire",
            Self::Motion => "motion",
        }
    }
}
