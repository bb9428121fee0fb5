//! [`Levels`]: a scene at any number of faces, reached from the present level by applying or undoing
//! collapses.

use super::collapse_record::{CollapseRecord, NO_INDEX};
use crate::error::Error;
use crate::scene::{Geometry, Scene};

/// A scene at some level of detail. Changing the level takes time in proportion to the collapses between the
/// two.
///
/// Faces come from the scene for which the levels were made; vertices may come from any pose of it.
#[derive(Debug, Clone)]
pub struct Levels<'a> {
    record: &'a CollapseRecord,
    /// Wedges of each face; [`NO_INDEX`] for faces that are not drawn.
    faces: Vec<[u32; 3]>,
    /// Whether each face is removed.
    gone: Vec<bool>,
    /// Remaining faces of each geometry.
    left: Vec<u64>,
    /// Number of collapses applied.
    done: usize,
}

impl<'a> Levels<'a> {
    pub(crate) fn new(record: &'a CollapseRecord) -> Self {
        let gone = record.faces.iter().map(|face| face[0] == NO_INDEX).collect();
        let left = record.ranges.iter().map(|range| range.len() as u64).collect();
        Self { record, faces: record.faces.clone(), gone, left, done: 0 }
    }

    /// Number of collapses applied.
    #[must_use]
    pub fn level(&self) -> usize {
        self.done
    }

    /// Number of levels below the full scene.
    #[must_use]
    pub fn deepest(&self) -> usize {
        self.record.steps.len()
    }

    /// Goes to the finest level with at most `most` faces, instances counted, or to the deepest one. Returns
    /// the number of faces there. The result does not depend on the present level.
    ///
    /// # Errors
    /// If the scene does not match these levels.
    pub fn seek(&mut self, scene: &Scene, most: u64) -> Result<u64, Error> {
        self.check(scene)?;
        let shown = shown(scene);
        let count =
            |levels: &Self| -> u64 { levels.left.iter().zip(&shown).map(|(left, shown)| left * shown).sum() };
        let mut faces = count(self);
        let saved = |levels: &Self, step: usize| -> u64 {
            let (_, removed) = levels.record.of_step(step);
            removed.iter().map(|face| shown[levels.geometry_of(*face)]).sum()
        };
        while faces > most && self.done < self.deepest() {
            faces -= saved(self, self.done);
            self.down();
        }
        while let Some(last) = self.done.checked_sub(1) {
            let before = faces + saved(self, last);
            if before > most && faces != before {
                break;
            }
            faces = before;
            self.up();
        }
        Ok(faces)
    }

    /// The scene at this level: its own parts, materials, vertices and normals, reduced to the remaining
    /// faces and the vertices that these use.
    ///
    /// # Errors
    /// If the scene does not match these levels.
    pub fn scene(&self, scene: &Scene) -> Result<Scene, Error> {
        self.check(scene)?;
        let geometries = scene.geometries.iter().enumerate();
        let geometries = geometries.map(|(number, geometry)| self.geometry(number, geometry)).collect();
        Ok(Scene {
            file: scene.file.clone(),
            format: scene.format,
            up: scene.up,
            geometries,
            parts: scene.parts.clone(),
            materials: scene.materials.clone(),
            lights: scene.lights.clone(),
            cameras: scene.cameras.clone(),
            warnings: scene.warnings.clone(),
            unused_vertices: scene.unused_vertices,
            movers: scene.movers.clone(),
        })
    }

    fn geometry(&self, number: usize, from: &Geometry) -> Geometry {
        let range = self.record.ranges[number].clone();
        if self.left[number] == range.len() as u64 {
            return from.clone();
        }
        let kept: Vec<usize> = range.clone().filter(|face| !self.gone[*face]).collect();
        let wedges = |face: &usize| self.faces[*face].map(|wedge| self.record.wedges[wedge as usize]);
        let of_face = |face: &usize| face - range.start;
        let mut geometry = Geometry {
            triangles: kept.iter().map(|face| wedges(face).map(|wedge| wedge.vertex)).collect(),
            wires: from.wires.clone(),
            material: from.material,
            single_precision: from.single_precision,
            lattice_step: from.lattice_step,
            triangle_material: picked(&from.triangle_material, kept.iter().map(of_face)),
            edge_marks: picked(&from.edge_marks, kept.iter().map(of_face)),
            ..Geometry::default()
        };
        if !from.corner_normals.is_empty() {
            geometry.corner_normals =
                kept.iter().map(|face| wedges(face).map(|wedge| wedge.normal)).collect();
        }
        if !from.corner_uvs.is_empty() {
            geometry.corner_uvs = kept.iter().map(|face| wedges(face).map(|wedge| wedge.uv)).collect();
        }
        let corners =
            geometry.triangles.as_flattened_mut().iter_mut().chain(geometry.wires.as_flattened_mut());
        let vertices = packed(from.positions.len(), corners);
        geometry.positions = picked(&from.positions, vertices.iter().copied());
        geometry.colours = picked(&from.colours, vertices.iter().copied());
        let normals = packed(from.normals.len(), geometry.corner_normals.as_flattened_mut().iter_mut());
        geometry.normals = picked(&from.normals, normals.into_iter());
        let uvs = packed(from.uvs.len(), geometry.corner_uvs.as_flattened_mut().iter_mut());
        geometry.uvs = picked(&from.uvs, uvs.into_iter());
        geometry
    }

    fn down(&mut self) {
        let (changes, removed) = self.record.of_step(self.done);
        for change in changes {
            self.faces[(change.corner / 3) as usize][(change.corner % 3) as usize] = change.after;
        }
        for &face in removed {
            self.gone[face as usize] = true;
            let geometry = self.geometry_of(face);
            self.left[geometry] -= 1;
        }
        self.done += 1;
    }

    fn up(&mut self) {
        self.done -= 1;
        let (changes, removed) = self.record.of_step(self.done);
        for change in changes {
            self.faces[(change.corner / 3) as usize][(change.corner % 3) as usize] = change.before;
        }
        for &face in removed {
            self.gone[face as usize] = false;
            let geometry = self.geometry_of(face);
            self.left[geometry] += 1;
        }
    }

    fn geometry_of(&self, face: u32) -> usize {
        self.record.ranges.partition_point(|range| range.end <= face as usize)
    }

    /// Returns an error for scenes with other face counts.
    fn check(&self, scene: &Scene) -> Result<(), Error> {
        let counts = scene.geometries.iter().map(|geometry| geometry.triangles.len());
        if counts.eq(self.record.ranges.iter().map(ExactSizeIterator::len)) {
            return Ok(());
        }
        Err(Error::new("these levels of detail belong to another scene")
            .remedy("give a pose of the scene they were made for"))
    }
}

/// Number of instances of each geometry.
pub(crate) fn shown(scene: &Scene) -> Vec<u64> {
    let mut shown = vec![0; scene.geometries.len()];
    for part in scene.parts.iter().filter(|part| scene.geometry_of(part).is_some()) {
        shown[part.geometry] += 1;
    }
    shown
}

fn picked<T: Copy>(values: &[T], which: impl Iterator<Item = usize>) -> Vec<T> {
    if values.is_empty() {
        Vec::new()
    } else {
        which.filter_map(|which| values.get(which).copied()).collect()
    }
}

/// Renumbers pointers into `count` items consecutively, in item order; returns the items in use.
fn packed<'b>(count: usize, pointers: impl Iterator<Item = &'b mut u32>) -> Vec<usize> {
    let mut pointers: Vec<&mut u32> = pointers.collect();
    let mut numbers = vec![NO_INDEX; count];
    for pointer in &pointers {
        if let Some(number) = numbers.get_mut(**pointer as usize) {
            *number = 0;
        }
    }
    let mut kept = Vec::new();
    for (which, number) in numbers.iter_mut().enumerate().filter(|(_, number)| **number == 0) {
        *number = kept.len() as u32;
        kept.push(which);
    }
    for pointer in &mut pointers {
        if let Some(number) = numbers.get(**pointer as usize) {
            **pointer = *number;
        }
    }
    kept
}
