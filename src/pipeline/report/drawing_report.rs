//! [`Report`]: what a drawing took and what it holds, as JSON for other programs.

use kurbo::PathEl;
use serde::Serialize;

/// How long each stage took, in milliseconds; 0 for stages that did not run. Lines are linked while surfaces are painted and hatched: each
/// counts that time as its own.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct StagesMs {
    /// Reading the model file.
    pub load: f64,
    /// Welding and finding the edges.
    pub topology: f64,
    /// Posing skins and morphs.
    pub pose: f64,
    /// Finding feature lines.
    pub features: f64,
    /// Deciding what is hidden.
    pub visibility: f64,
    /// Linking, tidying, smoothing and fitting chains.
    pub chains: f64,
    /// Giving chains their ink.
    pub strokes: f64,
    /// Gathering regions.
    pub regions: f64,
    /// Filling regions with hatches.
    pub hatching: f64,
    /// Writing the drawing in its formats.
    pub write: f64,
}

impl std::ops::AddAssign for StagesMs {
    fn add_assign(&mut self, other: Self) {
        let Self { load, topology, pose, features, visibility, chains, strokes, regions, hatching, write } =
            other;
        self.load += load;
        self.topology += topology;
        self.pose += pose;
        self.features += features;
        self.visibility += visibility;
        self.chains += chains;
        self.strokes += strokes;
        self.regions += regions;
        self.hatching += hatching;
        self.write += write;
    }
}

/// How much of everything there was.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[non_exhaustive]
pub struct Counts {
    /// Triangles of the model, instances counted each.
    pub triangles: u64,
    /// Vertices after welding.
    pub vertices: u64,
    /// Edges of the mesh.
    pub edges: u64,
    /// Pieces of feature lines.
    pub feature_edges: u64,
    /// Rays that decided what is hidden.
    pub ray_tests: u64,
    /// Contours of rounded surfaces that are curves.
    pub contour_curves: u64,
    /// Pieces of the polyhedron's contour that are drawn themselves, as no curve is near.
    pub contour_bare: u64,
    /// Pieces of the polyhedron's contour that are left out as folds of a few faces.
    pub contour_folds: u64,
    /// Chains.
    pub chains: u64,
    /// Paths of the drawing.
    pub paths: u64,
    /// Points of the drawing's paths, control points counted.
    pub points: u64,
    /// Regions.
    pub regions: u64,
    /// Cells of regions in which different looks were seen.
    pub leaks: u64,
    /// Bytes of all outputs together, the report left out.
    pub bytes_out: u64,
}

impl std::ops::AddAssign for Counts {
    fn add_assign(&mut self, other: Self) {
        let Self { triangles, vertices, edges, feature_edges, ray_tests, .. } = other;
        let Self { contour_curves, contour_bare, contour_folds, chains, paths, points, .. } = other;
        let Self { regions, leaks, bytes_out, .. } = other;
        self.triangles += triangles;
        self.vertices += vertices;
        self.edges += edges;
        self.feature_edges += feature_edges;
        self.ray_tests += ray_tests;
        self.contour_curves += contour_curves;
        self.contour_bare += contour_bare;
        self.contour_folds += contour_folds;
        self.chains += chains;
        self.paths += paths;
        self.points += points;
        self.regions += regions;
        self.leaks += leaks;
        self.bytes_out += bytes_out;
    }
}

/// What a drawing took and what it holds.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct Report {
    /// Milliseconds by stage.
    pub stages_ms: StagesMs,
    /// Counts.
    pub counts: Counts,
    /// Defects that were drawn around, one line each.
    pub warnings: Vec<String>,
}

impl Report {
    /// The report as JSON, indented, with a line end.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Numbers and strings always serialise.
        let mut json = serde_json::to_string_pretty(self).unwrap_or_default();
        json.push('\n');
        json
    }
}

/// Measures stages: the only place that reads a clock, and no drawing depends on it. Where there is no clock,
/// as in a browser's bare WebAssembly, all stages take no time.
#[derive(Debug, Clone, Copy)]
pub struct Stopwatch {
    started: Moment,
    lap: Moment,
}

impl Stopwatch {
    /// A stopwatch that runs from now.
    #[must_use]
    pub fn start() -> Self {
        let now = Moment::now();
        Self { started: now, lap: now }
    }

    /// Milliseconds since the last lap (or the start), and the start of the next.
    pub fn lap_ms(&mut self) -> f64 {
        let now = Moment::now();
        let lap = now.seconds_since(self.lap);
        self.lap = now;
        (lap * 1e6).round() / 1e3
    }

    /// Seconds since the start.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        Moment::now().seconds_since(self.started)
    }
}

/// What a clock shows.
#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
#[derive(Debug, Clone, Copy)]
struct Moment(std::time::Instant);

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
impl Moment {
    fn now() -> Self {
        Self(std::time::Instant::now())
    }

    fn seconds_since(self, earlier: Self) -> f64 {
        self.0.duration_since(earlier.0).as_secs_f64()
    }
}

/// What a clock would show.
#[cfg(all(target_family = "wasm", target_os = "unknown"))]
#[derive(Debug, Clone, Copy)]
struct Moment;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
impl Moment {
    fn now() -> Self {
        Self
    }

    fn seconds_since(self, _: Self) -> f64 {
        0.0
    }
}

/// Points of a path, control points counted.
pub(crate) fn points(path: &kurbo::BezPath) -> u64 {
    let of = |element: &PathEl| match element {
        PathEl::MoveTo(_) | PathEl::LineTo(_) => 1,
        PathEl::QuadTo(..) => 2,
        PathEl::CurveTo(..) => 3,
        PathEl::ClosePath => 0,
    };
    path.elements().iter().map(of).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn json_has_the_names_other_programs_read() {
        let report = Report { warnings: vec!["3 \"odd\" faces".to_owned()], ..Report::default() };
        let json = report.to_json();
        let names = [
            "stages_ms load topology pose features visibility chains strokes regions hatching write",
            "counts triangles vertices edges feature_edges ray_tests contour_curves contour_bare contour_folds chains paths points regions leaks bytes_out",
            "warnings",
        ];
        let mut rest = json.as_str();
        for name in names.join(" ").split(' ') {
            let key = format!("\"{name}\": ");
            let (_, after) = rest.split_once(&key).unwrap_or_else(|| panic!("no {key} in order in {json}"));
            rest = after;
        }
        assert!(rest.contains(r#""3 \"odd\" faces""#));
    }

    #[test]
    fn laps_add_up_to_the_whole() {
        let mut watch = Stopwatch::start();
        let laps = watch.lap_ms() + watch.lap_ms();
        assert!(laps >= 0.0 && laps <= watch.seconds() * 1e3 + 0.002);
    }
}
