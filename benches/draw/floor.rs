//! Floor: the minimum work of any program that draws a model, implemented plainly on one thread.

use std::hint::black_box;
use std::path::Path;
use std::time::Instant;

use glam::DVec3;
use ligne::internals::mesh::{Edges, Soup};
use ligne::internals::view::Frame;
use ligne::scene::{Camera, Scene};

/// Side length of the depth raster, pixels.
const SIDE: usize = 1024;

/// Input of the floor, prepared without timing.
pub struct Floor {
    soup: Soup,
    frame: Frame,
    pool: rayon::ThreadPool,
}

/// Time of each step of the floor, seconds.
#[derive(Debug, Clone, Copy)]
pub struct FloorTimes {
    pub parse: f64,
    pub edges: f64,
    pub project: f64,
    pub raster: f64,
    /// CPU time of all steps; wall time if the system does not report it.
    pub cpu: f64,
}

impl FloorTimes {
    /// Sum of all steps.
    pub fn total(&self) -> f64 {
        self.parse + self.edges + self.project + self.raster
    }

    /// Minimum of two measurements, step by step.
    pub fn least(self, other: Self) -> Self {
        Self {
            parse: self.parse.min(other.parse),
            edges: self.edges.min(other.edges),
            project: self.project.min(other.project),
            raster: self.raster.min(other.raster),
            cpu: self.cpu.min(other.cpu),
        }
    }
}

impl Floor {
    /// Prepares the floor of a model in the default view and framing.
    pub fn new(model: &Path) -> Result<Self, ligne::Error> {
        let scene = Scene::open(model)?;
        let side = SIDE as f64;
        let camera = Camera::three_quarter().with_frame(side, side).fit(&scene);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        let pool = pool.map_err(|error| ligne::Error::new(error.to_string()))?;
        Ok(Self { soup: ligne::internals::soup(&scene), frame: Frame::new(&camera, DVec3::ZERO), pool })
    }

    /// Number of triangles.
    pub fn triangles(&self) -> usize {
        self.soup.triangles.len()
    }

    /// Runs all steps once.
    pub fn run(&self, model: &Path) -> FloorTimes {
        let soup = &self.soup;
        let mut cpu = 0.0;
        let (parse, scene) = self.timed(&mut cpu, || Scene::open(model));
        drop(black_box(scene));
        let (edges, found) = self.timed(&mut cpu, || Edges::build(soup.positions.len(), &soup.triangles));
        drop(black_box(found));
        let (project, points) = self.timed(&mut cpu, || project(&soup.positions, &self.frame));
        let (raster, depths) = self.timed(&mut cpu, || raster(&points, &soup.triangles));
        black_box(depths);
        FloorTimes { parse, edges, project, raster, cpu }
    }

    /// Wall time of some work on one thread. Its CPU time is added to `cpu`.
    fn timed<T: Send>(&self, cpu: &mut f64, work: impl FnOnce() -> T + Send) -> (f64, T) {
        self.pool.install(|| {
            let (start, before) = (Instant::now(), thread_cpu());
            let made = work();
            let wall = start.elapsed().as_secs_f64();
            *cpu += before.zip(thread_cpu()).map_or(wall, |(before, after)| after - before);
            (wall, made)
        })
    }
}

/// CPU time of this thread so far, seconds, if the system reports it.
fn thread_cpu() -> Option<f64> {
    // The system updates the counter when the thread yields.
    std::thread::yield_now();
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? / 1e9)
}

/// Points in pixels, with inverse depth as the third coordinate.
fn project(positions: &[DVec3], frame: &Frame) -> Vec<[f32; 3]> {
    positions.iter().map(|p| frame.image_from_local(*p).as_vec3().to_array()).collect()
}

/// Largest inverse depth at the centre of each pixel.
fn raster(points: &[[f32; 3]], triangles: &[[u32; 3]]) -> Vec<f32> {
    let mut depths = vec![f32::NEG_INFINITY; SIDE * SIDE];
    let last = (SIDE - 1) as f32;
    for triangle in triangles {
        let [a, b, c] = triangle.map(|corner| points[corner as usize]);
        let left = (a[0].min(b[0]).min(c[0]) - 0.5).ceil().max(0.0);
        let right = (a[0].max(b[0]).max(c[0]) - 0.5).floor().min(last);
        let top = (a[1].min(b[1]).min(c[1]) - 0.5).ceil().max(0.0);
        let bottom = (a[1].max(b[1]).max(c[1]) - 0.5).floor().min(last);
        // Most triangles of a fine mesh lie between pixel centres.
        if left > right || top > bottom {
            continue;
        }
        let area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if area == 0.0 || area.is_nan() {
            continue;
        }
        // Barycentric weights of b and c, and the inverse depth, are linear in x and y.
        let (bx, by) = ((c[1] - a[1]) / area, (a[0] - c[0]) / area);
        let (cx, cy) = ((a[1] - b[1]) / area, (b[0] - a[0]) / area);
        let (qb, qc) = (b[2] - a[2], c[2] - a[2]);
        let (left, right) = (left as usize, right as usize);
        for y in top as usize..=bottom as usize {
            let (dx, dy) = (left as f32 + 0.5 - a[0], y as f32 + 0.5 - a[1]);
            let (wb, wc) = (bx * dx + by * dy, cx * dx + cy * dy);
            for (step, depth) in depths[y * SIDE + left..=y * SIDE + right].iter_mut().enumerate() {
                let (wb, wc) = (wb + step as f32 * bx, wc + step as f32 * cx);
                let q = a[2] + wb * qb + wc * qc;
                // Without branches, because the ends of small triangles cannot be predicted.
                let shows = (wb >= 0.0) & (wc >= 0.0) & (wb + wc <= 1.0) & (q > *depth);
                *depth = if shows { q } else { *depth };
            }
        }
    }
    depths
}
