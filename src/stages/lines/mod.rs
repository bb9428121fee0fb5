//! Feature lines: curves on the surface that may be drawn.

mod colour_cells;
mod contacts;
mod covered;
mod drawn;
mod edge_fans;
pub mod edge_lines;
pub mod edge_search;
mod folds;
mod free_wires;
pub mod image;
mod in_faces;
pub mod inside;
pub mod intersections;
pub mod isophotes;
pub mod joints;
pub mod kind;
mod levels;
pub mod line;
pub mod lit;
pub mod options;
mod overlaid;
mod painted_face;
pub mod smooth_contours;
mod strides;
pub mod surface;
pub mod texture_borders;
mod texture_scale;
mod textured;
pub mod textures;
mod tint_borders;
pub mod tone_changes;
pub mod tone_edges;
pub mod zero_set;

pub(crate) use covered::{in_sight, shows_inside};
pub use edge_search::EdgeSearch;
pub use image::{ImageOptions, Source};
pub use inside::InsideOptions;
pub use kind::LineKind;
pub use line::{ContourCurve, FeatureLines, FeatureSegment, NO_FACE, Role};
pub use lit::Lit;
pub use options::{Contours, HiddenLines, LineOptions, Normals};
pub use surface::{Finer, Surface};
pub use textures::Textures;

use crate::parallel::prelude::*;

use crate::field;
use crate::shape::{Origin, Patches};
use crate::trees::intersect::IntersectionCurves;
use crate::view::View;

/// n·v as contours are traced from it, one per smooth vertex: averaged where it is near zero.
#[must_use]
pub fn facing(surface: &Surface, view: &View) -> Vec<f64> {
    let Surface { mesh, smooth, .. } = surface;
    let mut facing = field::facing(mesh, smooth, &view.frame);
    field::smooth_near_zero(mesh, smooth, &view.frame, &mut facing);
    facing
}

/// What was made once for all views of a surface.
#[derive(Debug, Clone, Copy, Default)]
pub struct Known<'a> {
    /// A search for lines along edges; one that does not fit the mesh is left alone.
    pub search: Option<&'a EdgeSearch>,
    /// All curves along which the surface passes through itself: [`intersections::all_curves`].
    pub intersections: Option<&'a IntersectionCurves>,
}

/// All feature lines of a view of a surface that the options ask for.
#[must_use]
pub fn extract(surface: &Surface, view: &View, options: &LineOptions) -> FeatureLines {
    extract_with(surface, Known::default(), view, options)
}

/// All feature lines of a view, found with the help of what was made once for all views of the surface.
#[must_use]
pub fn extract_with(surface: &Surface, known: Known, view: &View, options: &LineOptions) -> FeatureLines {
    let mut lines = FeatureLines::default();
    if !options.enabled || options.kinds.is_empty() {
        return lines;
    }
    let Surface { mesh, smooth, .. } = surface;
    let (asked, overlap) = (options, overlaid::is_asked(mesh));
    let with_borders = || {
        let more =
            [LineKind::Border, LineKind::Material].into_iter().filter(|kind| !options.kinds.contains(kind));
        LineOptions { kinds: options.kinds.iter().copied().chain(more).collect(), ..options.clone() }
    };
    let with_borders = overlap.then(with_borders);
    let options = with_borders.as_ref().unwrap_or(options);
    let along_edges = || match known.search.filter(|search| search.fits(mesh)) {
        None => edge_lines::find(surface, view, options),
        Some(search) => {
            let among = search.candidates(mesh, view).items;
            edge_lines::find_among(&among, surface, view, options)
        }
    };
    let contours = || {
        let wanted = !smooth.is_empty() && options.kinds.contains(&LineKind::Contour);
        wanted.then(|| {
            let facing = facing(surface, view);
            (smooth_contours::find(mesh, view, smooth, &facing), facing)
        })
    };
    let sought = options.kinds.contains(&LineKind::Intersection) && known.intersections.is_none();
    let curves = || sought.then(|| intersections::find(mesh, view, options.hidden));
    // None of them needs another.
    let ((segments, contours), curves) =
        crate::parallel::join(|| crate::parallel::join(along_edges, contours), curves);
    lines.segments = segments;
    let wires = if options.kinds.contains(&LineKind::Wire) && !mesh.wires.is_empty() {
        free_wires::find(mesh, &lines.segments)
    } else {
        Vec::new()
    };
    let options = asked;
    let overlaid = overlap.then(|| overlaid::settle(mesh, view, &mut lines.segments, options));
    if let Some((contours, facing)) = contours {
        lines.append_contours(contours);
        folds::tell(mesh, view, smooth, &facing, &mut lines.segments);
    }
    if options.kinds.contains(&LineKind::Intersection)
        && let Some(curves) = known.intersections.or(curves.as_ref())
    {
        intersections::add(curves, mesh, view, &mut lines);
    }
    if inside::wanted(options) {
        // Contours along edges of the mesh need no normals, lines inside always do.
        let own = smooth
            .is_empty()
            .then(|| surface::normals(mesh, &Patches::new(mesh, options.crease_deg, false), &[]));
        let smooth = own.as_ref().unwrap_or(smooth);
        let curvature = inside::curvature(mesh, smooth, &options.inside);
        inside::find(mesh, view, smooth, &curvature, options, &mut lines);
    }
    lines.segments.extend(wires.iter().map(FeatureSegment::of_wire));
    if let Some(overlaid) = overlaid {
        overlaid.append_to(mesh, &mut lines);
    }
    tell_origins(surface, &mut lines);
    lines
}

/// Tells how the surfaces came about that lines lie on.
fn tell_origins(surface: &Surface, lines: &mut FeatureLines) {
    if surface.origins.iter().all(|origin| *origin == Origin::Constructed) {
        return;
    }
    let origin = |face: u32| surface.origins.get(face as usize).copied().unwrap_or_default();
    lines.segments.par_iter_mut().for_each(|s| s.origin = origin(s.hosts[0]).max(origin(s.hosts[1])));
}
