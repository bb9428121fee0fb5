//! Filled shapes of patterns, clipped to their domains.

use kurbo::{BezPath, Point, Shape as _};

use crate::geometry::plane::polyline_path::add_polygon;
use crate::geometry::plane::polylines::bounds;
use crate::hatching::clip::domain::{Domains, NO_DOMAIN, directed_border};
use crate::hatching::clip::polygon_clip::{clip_polygon, clip_reach};
use crate::regions::HatchRegions;

/// Filled shape on the page.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct FilledShape {
    /// Outlines as polygons, filled by the nonzero rule.
    pub rings: Vec<Vec<Point>>,
    /// Path that is drawn if nothing clips the shape, in place of the polygons.
    pub whole: Option<BezPath>,
}

impl FilledShape {
    fn uncut(self) -> BezPath {
        self.whole.unwrap_or_else(|| {
            let mut path = BezPath::new();
            self.rings.iter().for_each(|ring| add_polygon(&mut path, ring.iter().copied()));
            path
        })
    }
}

/// The parts of a shape in wanted domains, each with its domain.
pub(crate) fn clip_to_domains(
    ground: &HatchRegions,
    domains: &Domains,
    is_wanted: impl Fn(u32) -> bool,
    shape: FilledShape,
) -> Vec<(u32, BezPath)> {
    let Some(bounds) = bounds(shape.rings.iter().flatten().copied()) else { return Vec::new() };
    let around = clip_reach(bounds);
    let wanted_domain =
        |cell: u32| Some(domains.domain(cell)).filter(|domain| *domain != NO_DOMAIN && is_wanted(*domain));
    let nearby_pieces: Vec<u32> = ground
        .pieces_near(around.center(), around.width().max(around.height()) / 2.0)
        .into_iter()
        .filter(|number| {
            let piece = &ground.pieces[*number as usize];
            let [a, b] = piece.ends;
            let [left, right] = piece.sides.map(wanted_domain);
            let apart = a.x.max(b.x) < around.x0
                || a.x.min(b.x) > around.x1
                || a.y.max(b.y) < around.y0
                || a.y.min(b.y) > around.y1;
            left != right && !apart
        })
        .collect();
    if nearby_pieces.is_empty() {
        let cell = shape.rings.first().and_then(|ring| ring.first()).map(|p| ground.cell_at(*p));
        return cell.and_then(wanted_domain).map(|domain| (domain, shape.uncut())).into_iter().collect();
    }
    let mut domain_numbers: Vec<u32> = nearby_pieces
        .iter()
        .flat_map(|number| ground.pieces[*number as usize].sides)
        .filter_map(wanted_domain)
        .collect();
    domain_numbers.sort_unstable();
    domain_numbers.dedup();
    let signed_area = shape.clone().uncut().area();
    let of = |domain: u32| {
        let is_own = |cell: u32| wanted_domain(cell) == Some(domain);
        let edges: Vec<[Point; 2]> = nearby_pieces
            .iter()
            .filter_map(|number| Some(directed_border(&ground.pieces[*number as usize], is_own)?.0))
            .collect();
        let path = clip_polygon(&shape.rings, &edges, |p| is_own(ground.cell_at(p)))?;
        // Overlapping shapes of opposite orientation would cancel under the nonzero rule.
        let is_turned = path.area() * signed_area < 0.0;
        Some((domain, if is_turned { path.reverse_subpaths() } else { path }))
    };
    domain_numbers.into_iter().filter_map(of).collect()
}
