//! Tolerances of this area, each as a fraction of a named quantity, in px of the page or in user units.

/// Borders that cross a grid row within this distance (grid steps) cross it at one point.
pub(crate) const CROSSING_MERGE_OF_STEP: f64 = 1e-6;

/// Maximum deviation (px) of a dot's outline from its circle and from the borders that clip it.
pub(crate) const MAX_DOT_OUTLINE_ERROR_PX: f64 = 0.01;

/// A clipped dot is dropped if its area is less than that of a square with this side (px).
pub(crate) const MIN_DOT_PIECE_PX: f64 = 0.1;

/// Shrinkage of a dot that a border is tangent to, as a fraction.
pub(crate) const DOT_SHRINK_OF_RADIUS: f64 = 1e-5;

/// Overlap of dots that cover the whole page, in steps of their lattice. Exceeds rounding, so no paper shows
/// where four dots meet.
pub(crate) const FULL_COVER_MARGIN_STEPS: f64 = 1e-4;

/// Distance of a moved dot from the border, as a fraction of its radius. Keeps the dot clear of the border in
/// spite of rounding.
pub(crate) const BORDER_GAP_OF_RADIUS: f64 = 1e-3;

/// Margin of the search radius for sites, in squares of the ink grid. Exceeds rounding of the
/// distances; a larger radius only costs time.
pub(crate) const SITE_SEARCH_MARGIN_SQUARES: f64 = 1e-3;

/// Rounding error of a number of arcs. A turn that exceeds a whole number of arcs by less gets no further
/// arc.
pub(crate) const ARC_COUNT_ROUNDING: f64 = 1e-9;

/// Minimum difference of two positions on a polyline, in sides of it. Positions that are closer are one
/// position that was rounded differently.
pub(crate) const MIN_POSITION_DIFFERENCE_SIDES: f64 = 1e-9;

/// Minimum length of a stroke, page units, however short strokes the layer allows. Shorter ones have no
/// direction.
pub(crate) const MIN_STROKE_LENGTH_UNITS: f64 = 1e-6;

/// Weight added to that of each lattice point, so that weights of zero still count a little. It does not
/// change the direction where any weight is larger.
pub(crate) const MIN_SAMPLE_WEIGHT: f64 = 1e-9;

/// Minimum ratio of height to width of a pattern tile. Not a tolerance, but the range of valid input.
pub(crate) const MIN_TILE_ASPECT: f64 = 1e-3;

/// Maximum ratio of height to width of a pattern tile.
pub(crate) const MAX_TILE_ASPECT: f64 = 1e3;

/// Distance from the middle of a ring's side to the points that are tested for being inside the ring, as a
/// fraction of the side.
pub(crate) const INSIDE_PROBE_OF_SIDE: f64 = 1e-3;
