//! Whether each end of a visible smooth contour has a reason: an occluder, a cusp, another line, the frame.
//!
//! The check reads only the finished view map, so it is independent of the code that built it.

use glam::DVec3;
use kurbo::Point;
use ligne::lines::{self, LineKind, LineOptions, Surface};
use ligne::scene::{Camera, Projection, Scene, UpAxis};
use ligne::view::View;
use ligne::visibility::{self, ViewMap, ViewVertexKind};
use rustc_hash::{FxHashMap, FxHashSet};

use crate::library::support::measures::line_picture::{SegmentGrid, nearest_parameter};
use crate::library::support::pipeline::REFINEMENT_TOLERANCE_PX;

/// Maximum distance of a reason from the end of the contour, px.
const MAX_REASON_DISTANCE_PX: f64 = 0.75;
/// The contour's own last stretch of this length gives no reason, px.
const OWN_CHAIN_PX: f64 = 2.5;

/// Maximum distance for gaps and lengths that are reported, px.
const MAX_MEASURED_PX: f64 = 8.0;
/// Isolated chains shorter than this are not drawn, px.
const MIN_DRAWN_CHAIN_PX: f64 = 4.0;

/// Counts of contour ends by reason, over one or more views.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContourEndCounts {
    pub views: usize,
    /// Number of smooth contours, and of mesh contours drawn in their place, as counted by the view map.
    pub curves: u64,
    pub mesh_contours: u64,
    /// Ends of visible contours.
    pub stops: usize,
    /// Ends at an occluding line, at a cusp, at another line, and at the frame.
    pub junctions: usize,
    pub cusps: usize,
    pub at_lines: usize,
    pub at_frame: usize,
    /// Ends within [`MAX_REASON_DISTANCE_PX`] of another end, and ends of chains too short to be drawn.
    pub slits: usize,
    pub short_chains: usize,
    /// Ends without a reason.
    pub unexplained: Vec<UnexplainedEnd>,
}

/// An end of a visible contour without a reason.
#[derive(Debug, Clone, Copy)]
pub(crate) struct UnexplainedEnd {
    pub position: Point,
    pub kind: ViewVertexKind,
    /// Whether a hidden contour continues there.
    pub goes_on: bool,
    /// Distance to the nearest other end of a visible contour; infinite above [`MAX_MEASURED_PX`].
    pub gap: f64,
    /// Length of the chain that ends, up to [`MAX_MEASURED_PX`].
    pub length: f64,
}

impl std::fmt::Display for UnexplainedEnd {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        let Self { position, kind, goes_on, gap, length } = self;
        let on = if *goes_on { "goes on hidden" } else { "nothing goes on" };
        write!(f, "({:.2}, {:.2}) {kind:?}, {on}, gap {gap:.2}, after {length:.1} px", position.x, position.y)
    }
}

impl ContourEndCounts {
    pub(crate) fn add(&mut self, other: Self) {
        self.views += other.views;
        self.curves += other.curves;
        self.mesh_contours += other.mesh_contours;
        self.stops += other.stops;
        self.junctions += other.junctions;
        self.cusps += other.cusps;
        self.at_lines += other.at_lines;
        self.at_frame += other.at_frame;
        self.slits += other.slits;
        self.short_chains += other.short_chains;
        self.unexplained.extend(other.unexplained);
    }

    /// Mean number of mesh contours drawn per view.
    pub(crate) fn mesh_contours_per_view(&self) -> f64 {
        self.mesh_contours as f64 / (self.views as f64).max(1.0)
    }

    /// Share of ends with a reason, percent.
    pub(crate) fn explained_percent(&self) -> f64 {
        100.0 * (1.0 - self.unexplained.len() as f64 / (self.stops as f64).max(1.0))
    }

    pub(crate) fn header() -> String {
        format!(
            "{:24} {:>5} {:>7} {:>6} {:>8} {:>7} {:>6} {:>6} {:>6} {:>6} {:>6} {:>6} {:>7} {:>8}",
            "model",
            "views",
            "curves",
            "bare",
            "a view",
            "stops",
            "under",
            "cusps",
            "lines",
            "frame",
            "slits",
            "crumbs",
            "unexpl.",
            "expl. %"
        )
    }

    pub(crate) fn row(&self, name: &str) -> String {
        format!(
            "{name:24} {:5} {:7} {:6} {:8.3} {:7} {:6} {:6} {:6} {:6} {:6} {:6} {:7} {:8.3}",
            self.views,
            self.curves,
            self.mesh_contours,
            self.mesh_contours_per_view(),
            self.stops,
            self.junctions,
            self.cusps,
            self.at_lines,
            self.at_frame,
            self.slits,
            self.short_chains,
            self.unexplained.len(),
            self.explained_percent()
        )
    }
}

/// Cameras from the 26 directions to a cube's faces, edges and corners, alternately perspective and
/// orthographic.
pub(crate) fn cube_cameras(scene: &Scene) -> Vec<Camera> {
    let mut cameras = Vec::new();
    for code in (0..27).filter(|code| *code != 13) {
        let way = DVec3::new(f64::from(code % 3), f64::from(code / 3 % 3), f64::from(code / 9)) - DVec3::ONE;
        let own_up = if scene.up == UpAxis::Y { DVec3::Y } else { DVec3::Z };
        let up = if way.cross(own_up) == DVec3::ZERO { DVec3::X } else { own_up };
        let projection = match code % 2 {
            0 => Projection::Perspective { fov_y_deg: 35.0 },
            _ => Projection::Orthographic { height: 1.0 },
        };
        let eye = way.normalize();
        let camera =
            Camera { eye, target: DVec3::ZERO, up, projection, width: 1000.0, height: 1000.0, near: None };
        cameras.push(camera.fit(scene));
    }
    cameras
}

/// The view map of a surface, refined for the camera.
pub(crate) fn build_view_map(surface: &Surface, camera: &Camera, options: &LineOptions) -> ViewMap {
    let surface = surface.clone().finer_for(camera, REFINEMENT_TOLERANCE_PX);
    let view = View::new(&surface.mesh, camera);
    let lines = lines::extract(&surface, &view, options);
    visibility::build(&surface.mesh, &view, &lines, options)
}

/// Counts the ends of the visible smooth contours of a view map by reason.
pub(crate) fn count_contour_ends(map: &ViewMap) -> ContourEndCounts {
    let mut tally = ContourEndCounts {
        views: 1,
        curves: map.contours.curves,
        mesh_contours: map.contours.unmatched,
        ..ContourEndCounts::default()
    };
    let place = |v: u32| map.vertices[v as usize].position;
    let seen: Vec<usize> = (0..map.edges.len()).filter(|e| map.edges[*e].invisibility == 0).collect();
    let ends = |e: usize| [map.edges[e].start.0, map.edges[e].end.0];
    let mut at: FxHashMap<u32, Vec<usize>> = FxHashMap::default();
    let mut hidden_at: FxHashSet<u32> = FxHashSet::default();
    for (e, edge) in map.edges.iter().enumerate() {
        for v in ends(e) {
            if edge.invisibility == 0 {
                at.entry(v).or_default().push(e);
            } else if edge.kind == LineKind::Contour {
                hidden_at.insert(v);
            }
        }
    }
    let ink = SegmentGrid::new(seen.iter().map(|e| ends(*e).map(place)).collect(), MAX_REASON_DISTANCE_PX);
    let is_smooth = |e: &&usize| map.edges[**e].kind == LineKind::Contour && map.edges[**e].smooth;
    // A vertex shared with another visible edge is no end.
    let stops: Vec<(usize, u32)> = seen
        .iter()
        .filter(is_smooth)
        .flat_map(|e| ends(*e).map(|v| (*e, v)))
        .filter(|(_, v)| at[v].len() == 1)
        .collect();
    let others = SegmentGrid::new(stops.iter().map(|(_, v)| [place(*v); 2]).collect(), MAX_MEASURED_PX);
    tally.stops = stops.len();
    for (stop, &(e, v)) in stops.iter().enumerate() {
        let vertex = map.vertices[v as usize];
        let (own, _) = chain_before_end(v, e, OWN_CHAIN_PX, &at, &ends, &place);
        let lines: Vec<(usize, f64)> = ink
            .segments_near(vertex.position)
            .map(|(i, s)| (seen[i], nearest_parameter(vertex.position, s), s))
            .filter(|(_, t, s)| (vertex.position - s[0].lerp(s[1], *t)).hypot() <= MAX_REASON_DISTANCE_PX)
            .filter(|(e, _, _)| !own.contains(e))
            .map(|(e, t, _)| (e, t))
            .collect();
        let depth = |e: usize, t: f64| {
            let [a, b] = ends(e).map(|v| map.vertices[v as usize].depth);
            a + (b - a) * t
        };
        let bounds = |e: usize| matches!(map.edges[e].kind, LineKind::Contour | LineKind::Border);
        let nearer = lines.iter().any(|(o, t)| bounds(*o) && depth(*o, *t) < vertex.depth);
        let line = lines.iter().any(|(o, _)| map.edges[*o].kind != LineKind::Contour);
        let from = |(i, [p, _]): (usize, [Point; 2])| {
            if i == stop { f64::INFINITY } else { (p - vertex.position).hypot() }
        };
        let gap = others.segments_near(vertex.position).map(from).fold(f64::INFINITY, f64::min);
        let (_, length) = chain_before_end(v, e, MAX_MEASURED_PX, &at, &ends, &place);
        let kind = vertex.kind;
        if kind == ViewVertexKind::Frame {
            tally.at_frame += 1;
        } else if kind == ViewVertexKind::TJunction && nearer {
            tally.junctions += 1;
        } else if line {
            tally.at_lines += 1;
        } else if kind == ViewVertexKind::Cusp || turns_back(map, v, e, &ends) {
            tally.cusps += 1;
        } else if gap <= MAX_REASON_DISTANCE_PX {
            tally.slits += 1;
        } else if length < MIN_DRAWN_CHAIN_PX {
            tally.short_chains += 1;
        } else {
            let (position, goes_on) = (vertex.position, hidden_at.contains(&v));
            tally.unexplained.push(UnexplainedEnd { position, kind, goes_on, gap, length });
        }
    }
    tally
}

/// The visible edges that lead to `v` by edge `e`, for at least `reach` px, and their total length.
fn chain_before_end(
    v: u32,
    e: usize,
    reach: f64,
    at: &FxHashMap<u32, Vec<usize>>,
    ends: &impl Fn(usize) -> [u32; 2],
    place: &impl Fn(u32) -> Point,
) -> (FxHashSet<usize>, f64) {
    let mut own = FxHashSet::default();
    let (mut from, mut edge, mut length) = (v, e, 0.0);
    loop {
        own.insert(edge);
        let [a, b] = ends(edge);
        let to = if a == from { b } else { a };
        length += (place(b) - place(a)).hypot();
        let next = at[&to].iter().copied().find(|o| !own.contains(o));
        match next {
            Some(next) if length < reach => (from, edge) = (to, next),
            _ => return (own, length),
        }
    }
}

/// Whether a contour edge continues at `v` and turns back in the image: a cusp.
fn turns_back(map: &ViewMap, v: u32, e: usize, ends: &impl Fn(usize) -> [u32; 2]) -> bool {
    let place = |v: u32| map.vertices[v as usize].position;
    let other = |e: usize, v: u32| {
        let [a, b] = ends(e);
        if a == v { b } else { a }
    };
    let here = place(v);
    let came = here - place(other(e, v));
    // Edges follow the order of their segments along the curve, so the continuation has a nearby number.
    let window = e.saturating_sub(64)..(e + 65).min(map.edges.len());
    let goes = |o: &usize| *o != e && map.edges[*o].kind == LineKind::Contour && ends(*o).contains(&v);
    window.filter(goes).any(|o| came.dot(place(other(o, v)) - here) < 0.0)
}
