//! STL, binary and text.
//!
//! Source: 3D Systems, *StereoLithography Interface Specification* (1989). The z axis is assumed to point up.
//! Normals are ignored: the order of the corners gives the same orientation, and many files store zeros.
//!
//! 1. A file is text if it begins with `solid`, has no zero byte near its start, and its size differs from
//!    the size that its binary triangle count implies.
//! 2. A binary file starts with 80 bytes of header and the number of triangles, which this file reads.
//! 3. Each `solid` of a text file becomes a part; a binary file is one part. Equal corners share a vertex.
//! 4. [`attribute_colours`] reads the colours that two conventions store in the attribute bytes of binary
//!    files.

mod attribute_colours;

use glam::{DAffine3, DVec3};
use rustc_hash::FxHashMap;

use super::text_cursor::{Cursor, decode};
use crate::error::Error;
use crate::scene::drawable;
use crate::scene::extent::coordinate_limits::{NOT_DRAWABLE_WARNING, is_drawable};
use crate::scene::extent::precision_warning;
use crate::scene::warnings::WarningExamples;
use crate::scene::{Geometry, Part, Scene, UpAxis};

const HEADER_BYTES: usize = 84;
const RECORD_BYTES: usize = 50;

/// Reads the bytes of an STL file; `stem` names solids without a name.
///
/// # Errors
/// Names the place if it is cut off or nothing can be drawn.
pub(crate) fn read_bytes(bytes: &[u8], stem: &str) -> Result<Scene, Error> {
    let mut scene = Scene { format: "STL", up: UpAxis::Z, ..Scene::default() };
    if is_text(bytes) {
        read_text(bytes, stem, &mut scene)?
    } else {
        read_binary(bytes, stem, &mut scene)?
    }
    drawable(scene).map(precision_warning::with_precision_warning)
}

/// Number of triangles in the header of a binary file.
fn binary_count(bytes: &[u8]) -> Option<u32> {
    bytes.get(80..HEADER_BYTES).and_then(|count| <[u8; 4]>::try_from(count).ok()).map(u32::from_le_bytes)
}

/// Whether a file is text. Binary files may begin with `solid` too, so their length and zero bytes are tested
/// as well.
fn is_text(bytes: &[u8]) -> bool {
    let fits = binary_count(bytes)
        .is_some_and(|n| HEADER_BYTES as u64 + RECORD_BYTES as u64 * u64::from(n) == bytes.len() as u64);
    let mut cursor = Cursor::new(bytes);
    cursor.skip_space();
    let keyword = cursor.word();
    let head = bytes.get(..bytes.len().min(512)).unwrap_or_default();
    !fits && keyword.eq_ignore_ascii_case(b"solid") && !head.contains(&0)
}

fn add_part(scene: &mut Scene, name: String, geometry: Geometry) {
    scene.parts.push(Part { name, geometry: scene.geometries.len(), world_from_part: DAffine3::IDENTITY });
    scene.geometries.push(geometry);
}

fn read_binary(bytes: &[u8], stem: &str, scene: &mut Scene) -> Result<(), Error> {
    let Some((count, body)) = binary_count(bytes).zip(bytes.get(HEADER_BYTES..)) else {
        let message = format!(
            "{} bytes are too few for a binary STL file and no text begins with `solid`",
            bytes.len()
        );
        return Err(Error::new(message).at("header"));
    };
    let whole = body.len() / RECORD_BYTES;
    if (count as usize) > whole {
        let message = format!("the file says it has {count} triangles, but ends after {whole}");
        return Err(Error::new(message).at("byte 80").remedy("it is cut off or not an STL file"));
    }
    if body.len() > count as usize * RECORD_BYTES {
        scene.warnings.count(
            "bytes after the last triangle left out",
            (body.len() - count as usize * RECORD_BYTES) as u64,
        );
    }
    let mut geometry = Geometry { single_precision: true, ..Geometry::default() };
    geometry.triangles.reserve_exact(count as usize);
    // A closed mesh has half as many vertices as triangles.
    geometry.positions.reserve(count as usize / 2 + 3);
    let mut recent = RecentVertices::new();
    let mut unusable = 0;
    let mut attributes = 0;
    for record in body.chunks_exact(RECORD_BYTES).take(count as usize) {
        attributes |= attribute(record);
        let corners = corner_bits(record);
        if is_odd(&corners) {
            unusable += 1;
            continue;
        }
        geometry.triangles.push(corners.map(|bits| recent.vertex(bits, &mut geometry.positions)));
    }
    scene.warnings.count(NOT_DRAWABLE_WARNING, unusable);
    let header = bytes.get(..80).unwrap_or_default();
    if attributes != 0 || attribute_colours::has_part_colour(header) {
        let sound =
            body.chunks_exact(RECORD_BYTES).take(count as usize).filter(|record| !has_odd_corner(record));
        let attributes: Vec<u16> = sound.map(attribute).collect();
        attribute_colours::paint(header, &attributes, &mut geometry, scene);
    }
    add_part(scene, stem.to_owned(), geometry);
    Ok(())
}

/// The "attribute byte count" of a triangle, which may contain a colour.
fn attribute(record: &[u8]) -> u16 {
    record.get(48..).and_then(|rest| rest.first_chunk()).copied().map_or(0, u16::from_le_bytes)
}

/// Bits of the three corners of a triangle.
fn corner_bits(record: &[u8]) -> [[u32; 3]; 3] {
    let mut corners = [[0_u32; 3]; 3];
    let stored = record.get(12..48).unwrap_or_default().chunks_exact(4);
    for (value, four) in corners.as_flattened_mut().iter_mut().zip(stored) {
        *value = four.first_chunk().copied().map(u32::from_le_bytes).unwrap_or_default();
    }
    corners
}

/// Whether a coordinate is infinite or NaN: its exponent bits are all ones.
fn is_odd(corners: &[[u32; 3]; 3]) -> bool {
    corners.as_flattened().iter().any(|bits| bits & 0x7f80_0000 == 0x7f80_0000)
}

fn has_odd_corner(record: &[u8]) -> bool {
    is_odd(&corner_bits(record))
}

/// Direct-mapped cache of recent vertices, by the bits of their coordinates.
///
/// Adjacent triangles are mostly close to each other in the file, so a small cache finds most shared
/// vertices. Welding finds the others.
struct RecentVertices {
    slots: Vec<([u32; 3], u32)>,
}

impl RecentVertices {
    const SLOT_BITS: u32 = 15;

    fn new() -> Self {
        Self { slots: vec![([u32::MAX; 3], u32::MAX); 1 << Self::SLOT_BITS] }
    }

    #[inline]
    fn vertex(&mut self, bits: [u32; 3], positions: &mut Vec<DVec3>) -> u32 {
        let [x, y, z] = bits.map(u64::from);
        let mixed = x ^ y.rotate_left(23) ^ z.rotate_left(43);
        let slot = mixed.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> (64 - Self::SLOT_BITS);
        let id = positions.len() as u32;
        let point = || DVec3::from_array(bits.map(|b| f64::from(f32::from_bits(b))));
        match self.slots.get_mut(slot as usize) {
            Some((known, id)) if *known == bits => *id,
            known => {
                if let Some(slot) = known {
                    *slot = (bits, id);
                }
                positions.push(point());
                id
            }
        }
    }
}

fn read_text(bytes: &[u8], stem: &str, scene: &mut Scene) -> Result<(), Error> {
    let mut text =
        TextParser { cursor: Cursor::new(bytes), word_at: 0, lacks_end: WarningExamples::default() };
    let mut unusable = 0;
    loop {
        let keyword = text.word();
        if keyword.is_empty() {
            break;
        }
        if !keyword.eq_ignore_ascii_case(b"solid") {
            return Err(text.error("`solid`"));
        }
        text.cursor.skip_blanks();
        let name = decode(text.cursor.rest_of_line()).into_owned();
        let name = if name.is_empty() { stem.to_owned() } else { name };
        let geometry = text.solid(&mut unusable)?;
        if !geometry.triangles.is_empty() {
            add_part(scene, name, geometry);
        }
    }
    scene.warnings.count(NOT_DRAWABLE_WARNING, unusable);
    text.lacks_end.warn(&mut scene.warnings);
    Ok(())
}

struct TextParser<'a> {
    cursor: Cursor<'a>,
    word_at: usize,
    /// Solids without `endsolid`.
    lacks_end: WarningExamples,
}

impl<'a> TextParser<'a> {
    fn word(&mut self) -> &'a [u8] {
        self.cursor.skip_space();
        self.word_at = self.cursor.at;
        self.cursor.word()
    }

    fn expect(&mut self, keyword: &str) -> Result<(), Error> {
        if self.word().eq_ignore_ascii_case(keyword.as_bytes()) {
            Ok(())
        } else {
            Err(self.error(&format!("`{keyword}`")))
        }
    }

    fn number(&mut self) -> Result<f64, Error> {
        self.cursor.skip_space();
        self.word_at = self.cursor.at;
        let number = self.cursor.number();
        number
            .filter(|_| self.cursor.at_end() || self.cursor.at_word_end())
            .ok_or_else(|| self.error("a number"))
    }

    fn error(&mut self, expected: &str) -> Error {
        self.cursor.at = self.word_at;
        let location = format!("line {}", self.cursor.line());
        let actual_word = self.cursor.word();
        if actual_word.is_empty() {
            return Error::new(format!("the file ends where {expected} should stand"))
                .at(location)
                .remedy("it is cut off");
        }
        Error::new(format!("`{}` stands where {expected} should", super::quoted_start(actual_word)))
            .at(location)
    }

    /// Reads the facets up to `endsolid`. The end of the file or another `solid` between two facets ends the
    /// solid too, with a warning.
    fn solid(&mut self, unusable: &mut u64) -> Result<Geometry, Error> {
        let mut geometry = Geometry::default();
        let mut ids: FxHashMap<[u64; 3], u32> = FxHashMap::default();
        loop {
            let keyword = self.word();
            if keyword.eq_ignore_ascii_case(b"endsolid") {
                self.cursor.rest_of_line();
                return Ok(geometry);
            }
            if keyword.is_empty() || keyword.eq_ignore_ascii_case(b"solid") {
                self.cursor.at = self.word_at;
                let line = self.cursor.line();
                self.lacks_end.add(|| {
                    format!("line {line}: the solid ends without `endsolid`; the file may be cut off after its last whole facet")
                });
                return Ok(geometry);
            }
            if !keyword.eq_ignore_ascii_case(b"facet") {
                return Err(self.error("`facet` or `endsolid`"));
            }
            self.expect("normal")?;
            for _ in 0..3 {
                // Some exporters write `-nan` for the normal of a sliver.
                self.word();
            }
            self.expect("outer")?;
            self.expect("loop")?;
            let mut corners = [DVec3::ZERO; 3];
            for corner in &mut corners {
                self.expect("vertex")?;
                *corner = DVec3::new(self.number()?, self.number()?, self.number()?);
            }
            self.expect("endloop")?;
            self.expect("endfacet")?;
            if !corners.iter().all(|&p| is_drawable(p)) {
                *unusable += 1;
                continue;
            }
            let triangle = corners.map(|p| {
                *ids.entry(p.to_array().map(f64::to_bits)).or_insert_with(|| {
                    geometry.positions.push(p);
                    (geometry.positions.len() - 1) as u32
                })
            });
            geometry.triangles.push(triangle);
        }
    }
}

#[cfg(test)]
mod tests;
