//! [`Report`]: times and counts of a drawing, as JSON for other programs.

use kurbo::PathEl;
use serde::Serialize;

/// Time of each stage in milliseconds; 0 for stages that did not run. Linking runs in parallel with painting
/// and hatching, and each counts its own time.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct StagesMs {
    /// Reading the model file.
    pub load: f64,
    /// Welding and finding edges.
    pub topology: f64,
    /// Posing skins and morphs.
    pub pose: f64,
    /// Finding feature lines.
    pub features: f64,
    /// Deciding visibility.
    pub visibility: f64,
    /// Linking, tidying, smoothing and fitting chains.
    pub chains: f64,
    /// Drawing strokes.
    pub strokes: f64,
    /// Gathering regions.
    pub regions: f64,
    /// Hatching.
    pub hatching: f64,
    /// Writing the drawing in its file formats.
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

/// Counts of a drawing and its model.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[non_exhaustive]
pub struct Counts {
    /// Triangles of the model, with each instance counted.
    pub triangles: u64,
    /// Vertices after welding.
    pub vertices: u64,
    /// Edges of the mesh.
    pub edges: u64,
    /// Segments of feature lines.
    pub feature_edges: u64,
    /// Rays cast to decide visibility.
    pub ray_tests: u64,
    /// Contours of rounded surfaces that are smooth curves.
    pub contour_curves: u64,
    /// Pieces of the mesh contour that are drawn themselves, because no smooth curve is near.
    pub contour_bare: u64,
    /// Pieces of the mesh contour that are omitted as folds of a few faces.
    pub contour_folds: u64,
    /// Chains.
    pub chains: u64,
    /// Paths of the drawing.
    pub paths: u64,
    /// Points of the drawing's paths, control points counted.
    pub points: u64,
    /// Regions.
    pub regions: u64,
    /// Region cells where different looks were seen.
    pub leaks: u64,
    /// Bytes of all outputs together, without the report.
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

/// Times, counts and warnings of a drawing.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
#[non_exhaustive]
pub struct Report {
    /// Milliseconds by stage.
    pub stages_ms: StagesMs,
    /// Counts.
    pub counts: Counts,
    /// Defects and other problems, one line each.
    pub warnings: Vec<String>,
}

impl Report {
    /// The report as indented JSON with a final newline.
    #[must_use]
    pub fn to_json(&self) -> String {
        // Numbers and strings always serialise.
        let mut json = serde_json::to_string_pretty(self).unwrap_or_default();
        json.push('\n');
        json
    }
}

/// Stopwatch for stages. It is the only reader of a clock, and no drawing depends on it. Without a clock, as
/// in bare WebAssembly in a browser, all times are 0.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stopwatch {
    started: ClockReading,
    lap: ClockReading,
}

impl Stopwatch {
    /// A stopwatch that starts now.
    #[must_use]
    pub(crate) fn start() -> Self {
        let now = ClockReading::now();
        Self { started: now, lap: now }
    }

    /// Milliseconds since the last lap or the start. Starts the next lap.
    pub(crate) fn lap_ms(&mut self) -> f64 {
        let now = ClockReading::now();
        let lap = now.seconds_since(self.lap);
        self.lap = now;
        (lap * 1e6).round() / 1e3
    }

    /// Seconds since the start.
    #[must_use]
    pub(crate) fn seconds(&self) -> f64 {
        ClockReading::now().seconds_since(self.started)
    }
}

/// Reading of a clock.
#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
#[derive(Debug, Clone, Copy)]
struct ClockReading(std::time::Instant);

#[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
impl ClockReading {
    fn now() -> Self {
        Self(std::time::Instant::now())
    }

    fn seconds_since(self, earlier: Self) -> f64 {
        self.0.duration_since(earlier.0).as_secs_f64()
    }
}

/// Reading of a clock on platforms without one.
#[cfg(all(target_family = "wasm", target_os = "unknown"))]
#[derive(Debug, Clone, Copy)]
struct ClockReading;

#[cfg(all(target_family = "wasm", target_os = "unknown"))]
impl ClockReading {
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
    fn report_json_has_all_keys_in_order() {
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
    fn stopwatch_laps_add_up_to_the_total() {
        let mut watch = Stopwatch::start();
        let laps = watch.lap_ms() + watch.lap_ms();
        assert!(laps >= 0.0 && laps <= watch.seconds() * 1e3 + 0.002);
    }
}
