//! Writes scenes for timing: `cargo run --release --example make_stress -- DIR [SCENE [N]]`.
//!
//! Without a scene it writes `city.obj` (1.08 million triangles) and `menger4.obj` (673 thousand).
//! Scenes are `city` (N houses a side), `menger` (N levels), `sphere` (12 N² triangles) and
//! `terrain` (2 N²).

mod scenes;

use std::fs::File;
use std::io::{BufWriter, Error, ErrorKind, Write};
use std::path::Path;

use scenes::Triangles;

fn write(path: &Path, scene: &Triangles) -> std::io::Result<()> {
    let mut file = BufWriter::new(File::create(path)?);
    for [x, y, z] in &scene.points {
        writeln!(file, "v {x:.6} {y:.6} {z:.6}")?;
    }
    for [a, b, c] in scene.faces.iter().map(|face| face.map(|corner| corner + 1)) {
        writeln!(file, "f {a} {b} {c}")?;
    }
    println!("{}: {} triangles, {} points", path.display(), scene.faces.len(), scene.points.len());
    file.flush()
}

fn main() -> std::io::Result<()> {
    let usage =
        || Error::new(ErrorKind::InvalidInput, "usage: make_stress DIR [city|menger|sphere|terrain [N]]");
    let words: Vec<String> = std::env::args().skip(1).collect();
    let folder = words.first().map(Path::new).ok_or_else(usage)?;
    std::fs::create_dir_all(folder)?;
    let Some(name) = words.get(1) else {
        write(&folder.join("city.obj"), &scenes::city(300))?;
        return write(&folder.join("menger4.obj"), &scenes::menger(4));
    };
    let (make, usual): (fn(u32) -> Triangles, u32) = match name.as_str() {
        "city" => (scenes::city, 300),
        "menger" => (scenes::menger, 4),
        "sphere" => (scenes::sphere, 100),
        "terrain" => (scenes::terrain, 300),
        _ => return Err(usage()),
    };
    let n = words.get(2).map_or(Ok(usual), |word| word.parse().map_err(|_| usage()))?;
    write(&folder.join(format!("{name}{n}.obj")), &make(n))
}
