//! Feature lines: curves on the surface that may be drawn.
//!
//! 1. `edges` classifies mesh edges: contours, borders, creases and material boundaries. `joints` removes
//!    seams of parts.
//! 2. `intersections` finds the curves along which surfaces pass through each other.
//! 3. `zero_sets` traces smooth contours, suggestive contours, ridges and valleys through the faces.
//! 4. `isophotes` traces where the tone changes; `paint_borders` where painted colours change (`textures`).
//! 5. `image` finds lines in maps of depth and normals, for meshes without connectivity.
//!
//! Files, in reading order: [`line_kind`]; [`line_options`] the `[lines]` table; [`feature_line`] segments
//! and curves; [`prepared_surface`] a mesh with creases and normals; [`shared_points`] point ids by position;
//! [`edges`]; [`joints`]; [`intersections`]; [`zero_sets`]; [`isophotes`]; [`textures`]; [`paint_borders`];
//! [`image`].

pub(crate) mod edges;
pub(crate) mod feature_line;
pub(crate) mod image;
pub(crate) mod intersections;
pub(crate) mod isophotes;
pub(crate) mod joints;
pub(crate) mod line_kind;
pub(crate) mod line_options;
pub(crate) mod paint_borders;
pub(crate) mod prepared_surface;
mod shared_points;
pub(crate) mod textures;
mod tolerances;
pub(crate) mod zero_sets;

pub use edges::culling::edge_search::EdgeSearch;
pub(crate) use feature_line::{ContourCurve, NO_FACE, Role};
pub use feature_line::{FeatureLines, FeatureSegment};
pub(crate) use image::{ImageOptions, Source};
pub(crate) use isophotes::culling::covered_faces::{shows_inside, visible_faces_of};
pub(crate) use isophotes::lit_surface::Lit;
pub use line_kind::LineKind;
pub(crate) use line_options::HiddenLines;
pub(crate) use line_options::{Contours, LineOptions};
pub(crate) use prepared_surface::RefinedSurface;
pub use prepared_surface::Surface;
pub(crate) use textures::view_textures::Textures;
pub(crate) use zero_sets::interior::InsideOptions;

use crate::parallel::prelude::*;

use crate::light;
use crate::mesh::bvh::ToneTree;
use crate::mesh::intersect::intersection_curves::IntersectionCurves;
use crate::surface::{MeshSource, Patches};
use crate::view::View;

/// n·v as used for tracing contours, one per smooth vertex; smoothed where it is near zero.
#[must_use]
pub(crate) fn facing(surface: &Surface, view: &View) -> Vec<f64> {
    let Surface { mesh, smooth, .. } = surface;
    let mut facing = light::facing(mesh, smooth, &view.frame);
    light::smooth_near_zero(mesh, smooth, &view.frame, &mut facing);
    facing
}

/// Results that are shared by all views of a surface.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct SharedSearches<'a> {
    /// Search for lines along edges. Ignored if it does not fit the mesh.
    pub search: Option<&'a EdgeSearch>,
    /// All curves where the surface passes through itself: [`intersections::intersection_lines::all_curves`].
    pub intersections: Option<&'a IntersectionCurves>,
    /// Tree over the shading normals, for tone borders.
    pub tone_tree: Option<&'a ToneTree>,
}

/// All feature lines of a view, of the kinds in the options.
#[must_use]
pub(crate) fn extract(surface: &Surface, view: &View, options: &LineOptions) -> FeatureLines {
    extract_with(surface, SharedSearches::default(), view, options)
}

/// All feature lines of a view, using results that are shared by all views of the surface.
#[must_use]
pub(crate) fn extract_with(
    surface: &Surface,
    shared: SharedSearches,
    view: &View,
    options: &LineOptions,
) -> FeatureLines {
    let mut lines = FeatureLines::default();
    if !options.enabled || options.kinds.is_empty() {
        return lines;
    }
    let Surface { mesh, smooth, .. } = surface;
    let (requested_options, overlap) = (options, edges::coplanar_overlaps::has_overlaps(mesh));
    let with_borders = || {
        let more =
            [LineKind::Border, LineKind::Material].into_iter().filter(|kind| !options.kinds.contains(kind));
        LineOptions { kinds: options.kinds.iter().copied().chain(more).collect(), ..options.clone() }
    };
    let with_borders = overlap.then(with_borders);
    let options = with_borders.as_ref().unwrap_or(options);
    let along_edges = || match shared.search.filter(|search| search.fits(mesh)) {
        None => edges::edge_lines::find(surface, view, options),
        Some(search) => {
            let among = search.candidates(mesh, view).items;
            edges::edge_lines::find_among(&among, surface, view, options)
        }
    };
    let contours = || {
        let wanted = !smooth.is_empty() && options.kinds.contains(&LineKind::Contour);
        wanted.then(|| {
            let facing = facing(surface, view);
            (zero_sets::smooth_contours::find(mesh, view, smooth, &facing), facing)
        })
    };
    let searches_intersections =
        options.kinds.contains(&LineKind::Intersection) && shared.intersections.is_none();
    let curves = || {
        searches_intersections.then(|| intersections::intersection_lines::find(mesh, view, options.hidden))
    };
    // These three are independent of each other.
    let ((segments, contours), curves) =
        crate::parallel::join(|| crate::parallel::join(along_edges, contours), curves);
    lines.segments = segments;
    let wires = if options.kinds.contains(&LineKind::Wire) && !mesh.wires.is_empty() {
        edges::free_wires::find(mesh, &lines.segments)
    } else {
        Vec::new()
    };
    let options = requested_options;
    let overlaid = overlap
        .then(|| edges::coplanar_overlaps::classify_overlaps(mesh, view, &mut lines.segments, options));
    if let Some((contours, facing)) = contours {
        lines.append_contours(contours);
        edges::ripple_edges::mark_ripples(mesh, view, smooth, &facing, &mut lines.segments);
    }
    if options.kinds.contains(&LineKind::Intersection)
        && let Some(curves) = shared.intersections.or(curves.as_ref())
    {
        intersections::intersection_lines::add(curves, mesh, view, &mut lines);
    }
    if zero_sets::interior::has_interior_lines(options) {
        // Interior lines always need normals, contours along mesh edges do not.
        let computed_normals = smooth
            .is_empty()
            .then(|| prepared_surface::normals(mesh, &Patches::new(mesh, options.crease_deg, false), &[]));
        let smooth = computed_normals.as_ref().unwrap_or(smooth);
        let curvature = zero_sets::interior::curvature(mesh, smooth, &options.inside);
        zero_sets::interior::find(mesh, view, smooth, &curvature, options, &mut lines);
    }
    lines.segments.extend(wires.iter().map(FeatureSegment::of_wire));
    if let Some(overlaid) = overlaid {
        overlaid.append_to(mesh, &mut lines);
    }
    set_origins(surface, &mut lines);
    lines
}

/// Sets the origin of each segment from its faces.
fn set_origins(surface: &Surface, lines: &mut FeatureLines) {
    if surface.origins.iter().all(|origin| *origin == MeshSource::Constructed) {
        return;
    }
    let origin = |face: u32| surface.origins.get(face as usize).copied().unwrap_or_default();
    lines.segments.par_iter_mut().for_each(|s| s.origin = origin(s.hosts[0]).max(origin(s.hosts[1])));
}
