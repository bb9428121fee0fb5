//! Writes scenes for timing: `cargo run --release --example make_stress -- DIR [SCENE [N]]`.
//!
//! Without a scene it writes `city.obj` (1.08 million triangles) and `menger4.obj` (673 thousand). Scenes are
//! `city` (N houses per side), `menger` (N levels), `sphere` (12 N² triangles), `terrain` (2 N²), `knot` (8
//! N²), `nested` (24 N²), `printed` (83 times 8 N²) and `doubled` (67 times 16 N²).

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
    let mut objects = scene.objects.iter().enumerate().peekable();
    for (number, face) in scene.faces.iter().enumerate() {
        if let Some((object, _)) = objects.next_if(|(_, first)| **first == number) {
            writeln!(file, "o object{object}")?;
        }
        let [a, b, c] = face.map(|corner| corner + 1);
        writeln!(file, "f {a} {b} {c}")?;
    }
    println!("{}: {} triangles, {} points", path.display(), scene.faces.len(), scene.points.len());
    file.flush()
}

fn main() -> std::io::Result<()> {
    let scenes = "city|menger|sphere|terrain|knot|nested|printed|doubled";
    let usage = || Error::new(ErrorKind::InvalidInput, format!("usage: make_stress DIR [{scenes} [N]]"));
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
        "knot" => (scenes::knot, 71),
        "nested" => (scenes::nested, 224),
        "printed" => (scenes::printed, 39),
        "doubled" => (scenes::doubled, 18),
        _ => return Err(usage()),
    };
    let n = words.get(2).map_or(Ok(usual), |word| word.parse().map_err(|_| usage()))?;
    write(&folder.join(format!("{name}{n}.obj")), &make(n))
}
