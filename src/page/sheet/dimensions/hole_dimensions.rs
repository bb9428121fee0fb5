//! [`find_hole_dimensions`]: automatic diameters of whole cylinders that a view sees end-on and unobstructed.
//!
//! 1. Whole cylinders of the mesh are found by their arc.
//! 2. A face-id buffer of each side view shows whether the front rim of a cylinder is visible.
//! 3. Visible cylinders with the same written diameter form one dimension, such as `4× ⌀5`.
//! 4. Three or more equally spaced axes form a pitch circle.

use glam::DVec3;

use crate::mesh::{FaceId, Mesh};
use crate::page::sheet::arrangement::view_arrangement::ViewPlacement;
use crate::page::sheet::arrangement::view_plan::ViewPlan;
use crate::page::sheet::lengths::length_precision::LengthPrecision;
use crate::page::sheet::view::sheet_view::SheetView;
use crate::page::tolerances::{MAX_OFFSET_OF_RADIUS, MAX_RIM_DEPTH_OF_VIEW, MIN_END_ON_COSINE};
use crate::surface::{Cylinder, cylinders};
use crate::view::View;
use crate::view::raster::{FaceBuffer, PixelGrid};

/// Cylinders of one radius in a view that are dimensioned together.
#[derive(Debug, Clone)]
pub(crate) struct HoleDimension {
    /// Number of the view.
    pub view: usize,
    pub radius: f64,
    /// Precision of the radius and the positions.
    pub precision: LengthPrecision,
    pub is_hole: bool,
    /// Points on the axes, projected along the viewing direction, world.
    pub centres: Vec<DVec3>,
    /// Centre and radius of the pitch circle of three or more equally spaced axes.
    pub pitch: Option<(DVec3, f64)>,
}

/// Minimum arc of a whole cylinder, radians.
const MIN_WHOLE_ARC_RAD: f64 = 5.8;

/// Pixels along the longer side of the view for the visibility test.
const LONGER_SIDE_PX: f64 = 900.0;

/// Maximum number of different diameters per view.
const MAX_DIAMETERS_PER_VIEW: usize = 8;

/// The whole cylinders of a mesh.
pub(crate) fn whole_cylinders(mesh: &Mesh) -> Vec<Cylinder> {
    cylinders(mesh).into_iter().filter(|cylinder| cylinder.arc > MIN_WHOLE_ARC_RAD).collect()
}

/// The diameters of all side views, each in the first view that shows it, largest first.
pub(crate) fn find_hole_dimensions(plan: &ViewPlan) -> Vec<HoleDimension> {
    let mesh = Mesh::build(plan.sets[0].scene.to_soup());
    let mut left = whole_cylinders(&mesh);
    let mut found: Vec<HoleDimension> = Vec::new();
    for (view, placed) in plan.views.iter().enumerate() {
        let is_side =
            matches!(placed.placement, ViewPlacement::Projected(_)) && plan.scene_of_view[view] == 0;
        if !is_side {
            continue;
        }
        let forward = placed.sight.axes()[2];
        let (along, others): (Vec<Cylinder>, Vec<Cylinder>) =
            left.into_iter().partition(|cylinder| cylinder.axis.dot(forward).abs() > MIN_END_ON_COSINE);
        let (shown, hidden): (Vec<Cylinder>, Vec<Cylinder>) = split_visible(&mesh, &placed.sight, along);
        left = others.into_iter().chain(hidden).collect();
        let mut own: Vec<HoleDimension> = Vec::new();
        for cylinder in shown {
            let flat = cylinder.point - forward * cylinder.point.dot(forward);
            let precision = LengthPrecision::of_cylinder(&cylinder);
            let written = plan.values.written(2.0 * cylinder.radius, precision);
            let is_same = |round: &&mut HoleDimension| {
                round.is_hole == cylinder.is_hole
                    && plan.values.written(2.0 * round.radius, round.precision) == written
            };
            match own.iter_mut().find(is_same) {
                None => own.push(HoleDimension {
                    view,
                    radius: cylinder.radius,
                    precision,
                    is_hole: cylinder.is_hole,
                    centres: vec![flat],
                    pitch: None,
                }),
                Some(known) => {
                    known.precision = known.precision.coarser(precision);
                    if known
                        .centres
                        .iter()
                        .all(|at| at.distance(flat) > MAX_OFFSET_OF_RADIUS * cylinder.radius)
                    {
                        known.centres.push(flat);
                    }
                }
            }
        }
        own.sort_by(|a, b| b.radius.total_cmp(&a.radius));
        own.truncate(MAX_DIAMETERS_PER_VIEW);
        own.iter_mut().for_each(|round| round.pitch = pitch_circle(&round.centres));
        found.extend(own);
    }
    found
}

/// The circle through equally spaced points, if there are at least three.
fn pitch_circle(centres: &[DVec3]) -> Option<(DVec3, f64)> {
    let count = centres.len();
    if count < 3 {
        return None;
    }
    let middle = centres.iter().sum::<DVec3>() / count as f64;
    let radius = centres[0].distance(middle);
    let even =
        2.0 * radius * crate::geometry::numbers::portable_math::sin(std::f64::consts::PI / count as f64);
    let stands = |at: &DVec3| {
        let far = |other: &&DVec3| *other != at;
        let nearest =
            centres.iter().filter(far).map(|other| other.distance(*at)).fold(f64::INFINITY, f64::min);
        (at.distance(middle) - radius).abs() < MAX_OFFSET_OF_RADIUS * radius
            && (nearest - even).abs() < MAX_OFFSET_OF_RADIUS * even
    };
    (radius > 0.0 && centres.iter().all(stands)).then_some((middle, radius))
}

/// Splits cylinders along the viewing direction into visible and hidden ones, by sampling 8 points of their
/// front rims.
fn split_visible(mesh: &Mesh, sight: &SheetView, cylinders: Vec<Cylinder>) -> (Vec<Cylinder>, Vec<Cylinder>) {
    if cylinders.is_empty() {
        return (Vec::new(), Vec::new());
    }
    let camera = sight.view_camera();
    let view = View::new(mesh, &camera);
    let screen = PixelGrid::of_side(mesh, &view, LONGER_SIDE_PX);
    let buffer = FaceBuffer::new(&screen);
    let [right, up, forward] = sight.axes();
    let inner = sight.frame_to_page().inverse();
    let size = (sight.high - sight.low).length();
    let is_free = |p: DVec3, part: Option<crate::mesh::PartId>| {
        let at = inner * sight.to_page(p);
        let (x, y) = (at.x * screen.scale(), at.y * screen.scale());
        if x < 0.0 || y < 0.0 || x as usize >= screen.columns || y as usize >= screen.rows {
            return false;
        }
        let Some(face) = buffer.front(y as usize * screen.columns + x as usize) else {
            return part.is_none();
        };
        let [a, b, c] = mesh.corners(FaceId(face)).map(|corner| corner + mesh.origin);
        let normal = (b - a).cross(c - a);
        let ahead = (a - p).dot(normal) / forward.dot(normal);
        let is_own = part.is_none_or(|part| mesh.face_part[face as usize] == part);
        is_own && (ahead.is_nan() || ahead > -MAX_RIM_DEPTH_OF_VIEW * size)
    };
    let is_seen = |cylinder: &Cylinder| {
        let towards = if cylinder.axis.dot(forward) < 0.0 { cylinder.ends[1] } else { cylinder.ends[0] };
        let end = cylinder.point + cylinder.axis * towards;
        let part = (!cylinder.is_hole).then_some(cylinder.part);
        let free = (0..8).filter(|k| {
            let turn = std::f64::consts::TAU * (f64::from(*k) + 0.37) / 8.0;
            let out = right * crate::geometry::numbers::portable_math::cos(turn)
                + up * crate::geometry::numbers::portable_math::sin(turn);
            is_free(end + out * (0.94 * cylinder.radius), part)
        });
        free.count() >= 6
    };
    cylinders.into_iter().partition(is_seen)
}
