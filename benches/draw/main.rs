//! Compares the process `ligne draw` with its floor: reading the file, edge adjacency, projection and one
//! depth raster, on one thread. Ratios can be compared between machines, times cannot.
//!
//! `cargo bench --bench draw [-- NAME…]` draws all models, or those whose names contain one of the words.
//! Missing models are skipped. `LIGNE_MODELS` names their folder.

mod floor;
mod process;
#[allow(dead_code)]
#[path = "../../examples/make_stress/scenes.rs"]
mod scenes;

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use floor::Floor;
use process::Threads;
use scenes::Triangles;

/// Models, with the maximum ratio of drawing time to floor, if defined.
const MODELS: [(&str, Option<f64>); 11] = [
    ("organic/stanford-bunny.obj", Some(1.8)),
    ("cad/drive.obj", Some(1.3)),
    ("cad/conveyor.glb", Some(2.0)),
    ("mechanical/2CylinderEngine.glb", Some(2.0)),
    ("organic/dragon-202k.ply", Some(2.5)),
    ("organic/dragon-871k.ply", Some(2.0)),
    ("cad/knot_1k.glb", None),
    ("cad/knot_10k.glb", None),
    ("cad/knot_50k.glb", None),
    ("cad/knot_100k.glb", None),
    ("cad/drive.glb", None),
];

/// Generator of a model of a given size.
type Make = fn(u32) -> Triangles;

/// Generated models: name, generator, size and maximum ratio.
const MADE: [(&str, Make, u32, f64); 6] = [
    ("nested", scenes::nested, 224, 3.0),
    ("printed", scenes::printed, 39, 4.0),
    ("doubled", scenes::doubled, 18, 3.0),
    ("menger", scenes::menger, 4, 4.0),
    ("city", scenes::city, 300, 6.0),
    (TEN_MILLION, scenes::knot, 1118, 2.5),
];

/// Model that takes minutes. It is drawn only if it is named.
const TEN_MILLION: &str = "knot_10m";

/// Options for contours along mesh edges, to measure the cost of smooth ones.
const ALONG_EDGES: [&str; 2] = ["--set", "lines.contours=mesh"];

const MIB: f64 = 1024.0 * 1024.0;

/// Rounds per model: at least `MIN_ROUNDS`, then more until `MAX_TIME_PER_MODEL` has passed, at most `MAX_ROUNDS`.
const MIN_ROUNDS: usize = 3;
const MAX_ROUNDS: usize = 25;
const MAX_TIME_PER_MODEL: Duration = Duration::from_secs(6);

/// Measurements of one model.
struct Row {
    name: String,
    /// Seconds per triangle on one thread; CPU time if known.
    per_triangle: f64,
}

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let wanted: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with("--")).collect();
    let is_wanted = |name: &str| wanted.is_empty() || wanted.iter().any(|word| name.contains(word.as_str()));
    let folder = std::env::temp_dir().join(format!("ligne-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder)?;

    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    println!(
        "Least times in ms. `all` is a drawing on {cores} threads, `one` on one; `fl` the floor; `cpu` the CPU of"
    );
    println!(
        "`one`, over that of the floor, which a busy machine disturbs least; `edge` is `all` with contours along the"
    );
    println!("edges of the mesh; `2/1` the CPU on all threads over that on one. Load: {}", load());
    println!(
        "{:<15} {:>9} {:>8} {:>8} {:>8} {:>7} {:>7} {:>6} {:>7} {:>7} {:>6} {:>7} {:>6} {:>7}",
        "model",
        "triangles",
        "floor",
        "all",
        "one",
        "all/fl",
        "edge/fl",
        "limit",
        "one/fl",
        "cpu/fl",
        "2/1",
        "MiB",
        "B/tri",
        "ns/tri"
    );
    let mut rows = Vec::new();
    for (path, limit) in MODELS {
        let model = models().join(path);
        if !is_wanted(path) {
            continue;
        }
        if model.exists() {
            rows.push(measure(&model, limit, &folder)?);
        } else {
            println!("{path}: not there, passed over");
        }
    }
    for (name, make, count, limit) in MADE {
        let asked = wanted.iter().any(|word| name.contains(word.as_str()));
        if is_wanted(name) && (asked || name != TEN_MILLION) {
            let model = folder.join(name).with_extension("obj");
            write_obj(&model, &make(count))?;
            rows.push(measure(&model, Some(limit), &folder)?);
            std::fs::remove_file(&model)?;
        }
    }
    print_growth(&rows);
    println!("Load of the machine: {}", load());
    std::fs::remove_dir_all(folder)?;
    Ok(())
}

/// Measures the floor and the drawings of a model in turn, and prints its row.
fn measure(model: &Path, limit: Option<f64>, folder: &Path) -> Result<Row, Box<dyn std::error::Error>> {
    let floor = Floor::new(model)?;
    let drawing = folder.join("drawing.svg");
    let mut least_floor = floor.run(model);
    let (mut all, mut alone, mut along) = (f64::INFINITY, f64::INFINITY, f64::INFINITY);
    let start = Instant::now();
    for round in 0..MAX_ROUNDS {
        if round >= MIN_ROUNDS && start.elapsed() > MAX_TIME_PER_MODEL {
            break;
        }
        least_floor = least_floor.least(floor.run(model));
        all = all.min(process::draw(model, &drawing, Threads::All, &[])?);
        alone = alone.min(process::draw(model, &drawing, Threads::One, &[])?);
        along = along.min(process::draw(model, &drawing, Threads::All, &ALONG_EDGES)?);
    }
    let cpu = |threads: Threads| {
        (0..MIN_ROUNDS).filter_map(|_| process::cpu(model, &drawing, threads)).reduce(f64::min)
    };
    let (cpu, cpu_of_all) = (cpu(Threads::One), cpu(Threads::All));
    let memory = process::memory(model, &drawing, Threads::All);

    let name = model.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    let triangles = floor.triangles() as f64;
    let total = least_floor.total();
    let ms = |seconds: f64| format!("{:.1}", seconds * 1e3);
    let known = |number: Option<f64>, decimals| number.map_or("-".to_owned(), |n| format!("{n:.decimals$}"));
    let per_triangle = cpu.unwrap_or(alone) / triangles;
    println!(
        "{name:<15} {triangles:>9} {:>8} {:>8} {:>8} {:>7.2} {:>7.2} {:>6} {:>7.2} {:>7} {:>6} {:>7} {:>6} {:>7.0}",
        ms(total),
        ms(all),
        ms(alone),
        all / total,
        along / total,
        known(limit, 1),
        alone / total,
        known(cpu.map(|cpu| cpu / least_floor.cpu), 2),
        known(cpu_of_all.zip(cpu).map(|(all, one)| all / one), 2),
        known(memory.map(|bytes| bytes / MIB), 0),
        known(memory.map(|bytes| bytes / triangles), 0),
        per_triangle * 1e9,
    );
    let stages = process::stages(model, &drawing)?;
    let shares: Vec<String> = stages.iter().map(|(name, ms)| format!("{name} {ms:.1}")).collect();
    println!(
        "  floor: parse {}, edges {}, project {}, raster {}; drawing: {}",
        ms(least_floor.parse),
        ms(least_floor.edges),
        ms(least_floor.project),
        ms(least_floor.raster),
        shares.join(", ")
    );
    Ok(Row { name, per_triangle })
}

/// Prints the growth of the time per triangle for models of one kind. 1 or less means linear or better.
fn print_growth(rows: &[Row]) {
    let names = ["knot_1k", "knot_10k", "knot_50k", "knot_100k", "dragon-871k"];
    let chosen: Vec<&Row> =
        names.iter().filter_map(|name| rows.iter().find(|row| row.name == *name)).collect();
    for pair in chosen.windows(2) {
        let [from, to] = pair else { continue };
        let growth = to.per_triangle / from.per_triangle;
        println!("time a triangle, {} to {}: times {growth:.2}", from.name, to.name);
    }
}

/// Folder of the shared models.
fn models() -> PathBuf {
    let beside = || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models");
    std::env::var_os("LIGNE_MODELS").map_or_else(beside, PathBuf::from)
}

fn write_obj(path: &Path, scene: &Triangles) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    for [x, y, z] in &scene.points {
        writeln!(file, "v {x:.6} {y:.6} {z:.6}")?;
    }
    let mut objects = scene.objects.iter().enumerate().peekable();
    for (number, face) in scene.faces.iter().enumerate() {
        if let Some((object, _)) = objects.next_if(|(_, first)| **first == number) {
            writeln!(file, "o object{object}")?;
        }
        let [a, b, c] = face.map(|corner| corner + 1);
        writeln!(file, "f {a} {b} {c}")?;
    }
    file.flush()
}

/// Load averages of the machine, if known. Times are unreliable on a busy machine.
fn load() -> String {
    std::fs::read_to_string("/proc/loadavg")
        .map_or_else(|_| "unknown".to_owned(), |text| text.trim().to_owned())
}
