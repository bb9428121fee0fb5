//! Makes parts and materials from the statements of an OBJ file.

use glam::DAffine3;
use rustc_hash::FxHashMap;

use super::mtl_library::{self, LibraryLocation};
use super::statements::{ElementRun, NO_INDEX, Object, Statements};
use crate::colour::srgb::linear;
use crate::load::text_cursor::decode;
use crate::mesh::EdgeMark;
use crate::scene::model_folder::{ModelFolder, stays_inside};
use crate::scene::{Geometry, Material, Part, Scene, UpAxis, Warnings};

/// Makes one geometry per part, with only the vertices that it uses.
///
/// `library` reads a library by its path relative to the model; `files` are the files in the model's folder.
pub(crate) fn scene(
    mut statements: Statements,
    stem: &str,
    library: impl FnMut(&str) -> Option<Vec<u8>>,
    files: Option<&ModelFolder>,
) -> Scene {
    let mut warnings = std::mem::take(&mut statements.warnings);
    let materials = materials(&statements, library, files, &mut warnings);
    let mut scene = Scene { format: "OBJ", up: UpAxis::Y, materials, warnings, ..Scene::default() };

    let mut runs: Vec<Vec<ElementRun>> = vec![Vec::new(); statements.objects.len()];
    // Parts are in the order of their first face.
    let mut order = Vec::new();
    for run in std::mem::take(&mut statements.runs) {
        if let Some(object_runs) = runs.get_mut(run.object) {
            if object_runs.is_empty() {
                order.push(run.object);
            }
            object_runs.push(run);
        }
    }
    for (geometry, &object) in order.iter().enumerate() {
        let name = match statements.objects.get(object) {
            Some(Object::Named([])) => format!("part {}", geometry + 1),
            Some(Object::Named(name)) => decode(name).into_owned(),
            _ => stem.to_owned(),
        };
        scene.parts.push(Part { name, geometry, world_from_part: DAffine3::IDENTITY });
    }
    // Triangles before the first `usemtl` get a default material if others have one.
    let unnamed = scene.materials.len() as u32;
    let all_runs = || order.iter().filter_map(|&o| runs.get(o)).flatten();
    if all_runs().any(|run| run.material.is_none()) && all_runs().any(|run| run.material.is_some()) {
        scene.materials.push(Material::default());
    }
    fill_white(&mut statements);
    if let ([object], false) = (&order[..], statements.has_bad_positions) {
        let object_runs = runs.get(*object).map(Vec::as_slice).unwrap_or_default();
        let mut geometry = single_geometry(statements);
        assign_materials(&mut geometry, object_runs, unnamed);
        scene.geometries.push(geometry);
        return scene;
    }
    scene.unused_vertices = count_unused_vertices(&statements);
    let mut split = PartSplitter::new(&statements);
    for &object in &order {
        let object_runs = runs.get(object).map(Vec::as_slice).unwrap_or_default();
        let mut geometry = split.geometry(object_runs);
        assign_materials(&mut geometry, object_runs, unnamed);
        scene.geometries.push(geometry);
    }
    scene
}

/// Materials that are used, from the libraries, or grey if undefined.
fn materials(
    statements: &Statements,
    mut library: impl FnMut(&str) -> Option<Vec<u8>>,
    files: Option<&ModelFolder>,
    warnings: &mut Warnings,
) -> Vec<Material> {
    let mut defined = Vec::new();
    let mut all_found = true;
    let mut load = |name: &str, warnings: &mut Warnings| {
        let mut path = name.replace('\\', "/");
        let is_inside = stays_inside(&path);
        let mut bytes = if is_inside { library(&path) } else { None };
        if let Some(found) = files.filter(|_| bytes.is_none()).and_then(|files| files.find("", name)) {
            bytes = library(&found);
            warnings.missing_file(format!("material library {name} is not there; {found} is used"));
            path = found;
        }
        let Some(bytes) = bytes else {
            if !is_inside {
                let why = "is outside the model's folder and is left out";
                warnings.missing_file(format!("material library {name} {why}"));
            }
            return !is_inside;
        };
        let folder = path.rfind('/').map_or("", |slash| path.get(..=slash).unwrap_or_default());
        mtl_library::parse(&bytes, LibraryLocation { folder, files }, &mut defined, warnings);
        true
    };
    for name in &statements.libraries {
        let name = decode(name);
        if name.is_empty() || load(&name, warnings) {
            continue;
        }
        // A line may list several libraries. A name with blanks was already tried as a whole.
        let words: Vec<&str> = name.split_whitespace().collect();
        for word in &words {
            if words.len() == 1 || !load(word, warnings) {
                warnings.missing_file(format!("material library {word} is missing"));
                all_found = false;
            }
        }
    }
    let mut by_name: FxHashMap<&str, &Material> = FxHashMap::default();
    for material in &defined {
        by_name.entry(&material.name).or_insert(material);
    }
    let mut undefined = 0;
    let used = statements.materials.iter().map(|name| {
        let name = decode(name);
        by_name.get(&*name).map_or_else(
            || {
                undefined += u64::from(!name.is_empty());
                Material { name: name.to_string(), ..Material::default() }
            },
            |&material| material.clone(),
        )
    });
    let used = used.collect();
    if all_found {
        warnings.count("materials that no library defines", undefined);
    }
    used
}

/// Fills up vertex colours with white.
fn fill_white(statements: &mut Statements) {
    if !statements.colours.is_empty() {
        statements.colours.resize(statements.positions.len(), [1.0; 3]);
    }
}

fn rgba([r, g, b]: [f32; 3]) -> [f32; 4] {
    [linear(r), linear(g), linear(b), 1.0]
}

fn assign_materials(geometry: &mut Geometry, runs: &[ElementRun], unnamed: u32) {
    let id = |run: &ElementRun| run.material.map_or(unnamed, |m| m as u32);
    let first = runs.first().and_then(|run| run.material);
    if runs.iter().all(|run| run.material == first) && first.is_none() {
        return;
    }
    geometry.material = runs.first().map(id);
    if runs.iter().any(|run| run.material != first) {
        geometry.triangle_material =
            runs.iter().flat_map(|run| run.triangles.clone().map(move |_| id(run))).collect();
    }
}

/// Geometry of a file with a single part, without copying.
fn single_geometry(statements: Statements) -> Geometry {
    let Statements { positions, triangles, wires, normals, uvs, colours, .. } = statements;
    let pad = |mut corners: Vec<[u32; 3]>, count: usize| {
        if !corners.is_empty() {
            corners.resize(triangles.len(), [NO_INDEX; 3]);
            for corner in corners.iter_mut().flatten() {
                *corner = if (*corner as usize) < count { *corner } else { NO_INDEX };
            }
        }
        corners
    };
    let corner_normals = pad(statements.corner_normals, normals.len());
    let corner_uvs = pad(statements.corner_uvs, uvs.len());
    let colours = colours.into_iter().map(rgba).collect();
    let mut edge_marks = statements.edge_marks;
    if !edge_marks.is_empty() {
        edge_marks.resize(triangles.len(), [EdgeMark::Unmarked; 3]);
    }
    Geometry {
        positions,
        triangles,
        normals,
        corner_normals,
        uvs,
        corner_uvs,
        colours,
        edge_marks,
        wires,
        ..Geometry::default()
    }
}

/// Number of vertices without a triangle or wire.
fn count_unused_vertices(statements: &Statements) -> u64 {
    let mut unused = vec![true; statements.positions.len()];
    let corners = statements.triangles.as_flattened().iter().chain(statements.wires.as_flattened());
    for corner in corners {
        if let Some(own) = unused.get_mut(*corner as usize) {
            *own = false;
        }
    }
    unused.into_iter().filter(|unused| *unused).count() as u64
}

/// Splits the arrays of a file into those of its parts.
struct PartSplitter<'a> {
    statements: &'a Statements<'a>,
    positions: Renumber,
    normals: Renumber,
    uvs: Renumber,
}

impl<'a> PartSplitter<'a> {
    fn new(statements: &'a Statements<'a>) -> Self {
        Self {
            statements,
            positions: Renumber::new(statements.positions.len()),
            normals: Renumber::new(statements.normals.len()),
            uvs: Renumber::new(statements.uvs.len()),
        }
    }

    fn geometry(&mut self, runs: &[ElementRun]) -> Geometry {
        let from = self.statements;
        let mut triangles = gather(&from.triangles, runs, [NO_INDEX; 3]);
        let mut wires: Vec<[u32; 2]> =
            runs.iter().filter_map(|run| from.wires.get(run.wires.clone())).flatten().copied().collect();
        let kept = self.positions.renumber(&mut [triangles.as_flattened_mut(), wires.as_flattened_mut()]);
        let positions = pick(&from.positions, &kept);
        let colours = pick(&from.colours, &kept).into_iter().map(rgba).collect();

        let mut corner_normals = gather(&from.corner_normals, runs, [NO_INDEX; 3]);
        let normals = pick(&from.normals, &self.normals.renumber(&mut [corner_normals.as_flattened_mut()]));
        let mut corner_uvs = gather(&from.corner_uvs, runs, [NO_INDEX; 3]);
        let uvs = pick(&from.uvs, &self.uvs.renumber(&mut [corner_uvs.as_flattened_mut()]));
        let edge_marks = gather(&from.edge_marks, runs, [EdgeMark::Unmarked; 3]);
        if normals.is_empty() {
            corner_normals.clear();
        }
        if uvs.is_empty() {
            corner_uvs.clear();
        }
        Geometry {
            positions,
            triangles,
            normals,
            corner_normals,
            uvs,
            corner_uvs,
            colours,
            edge_marks,
            wires,
            ..Geometry::default()
        }
    }
}

/// Per-triangle data of some runs, filled up with `nothing` if `all` is too short; empty if the file has
/// none.
fn gather<T: Copy>(all: &[T], runs: &[ElementRun], nothing: T) -> Vec<T> {
    let count = runs.iter().map(|run| run.triangles.len()).sum();
    let mut corners = Vec::with_capacity(if all.is_empty() { 0 } else { count });
    if all.is_empty() {
        return corners;
    }
    for run in runs {
        let end = run.triangles.end.min(all.len());
        let have = all.get(run.triangles.start.min(end)..end).unwrap_or_default();
        corners.extend_from_slice(have);
        corners.extend(std::iter::repeat_n(nothing, run.triangles.len() - have.len()));
    }
    corners
}

fn pick<T: Copy>(from: &[T], kept: &[u32]) -> Vec<T> {
    kept.iter().filter_map(|&i| from.get(i as usize).copied()).collect()
}

/// Renumbers the elements that a part uses from 0, in file order.
struct Renumber {
    /// New number of each old one; [`NO_INDEX`] outside the present part.
    new_from_old: Vec<u32>,
}

impl Renumber {
    fn new(count: usize) -> Self {
        Self { new_from_old: vec![NO_INDEX; count] }
    }

    /// Renumbers indices and returns the old numbers in use. Indices out of range become [`NO_INDEX`].
    fn renumber(&mut self, indices: &mut [&mut [u32]]) -> Vec<u32> {
        let mut kept = Vec::new();
        for &old in indices.iter().flat_map(|part| part.iter()) {
            if let Some(new) = self.new_from_old.get_mut(old as usize).filter(|new| **new == NO_INDEX) {
                *new = 0;
                kept.push(old);
            }
        }
        kept.sort_unstable();
        for (new, &old) in kept.iter().enumerate() {
            if let Some(slot) = self.new_from_old.get_mut(old as usize) {
                *slot = new as u32;
            }
        }
        for index in indices.iter_mut().flat_map(|part| part.iter_mut()) {
            *index = self.new_from_old.get(*index as usize).copied().unwrap_or(NO_INDEX);
        }
        for &old in &kept {
            if let Some(slot) = self.new_from_old.get_mut(old as usize) {
                *slot = NO_INDEX;
            }
        }
        kept
    }
}
