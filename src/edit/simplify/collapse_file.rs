//! File format of collapses: the pairs of points in their order, bound to the model by a checksum.
//!
//! Layout:
//!
//! 1. `ligne-lod` and a version byte.
//! 2. Checksum of the model, 8 bytes, little endian.
//! 3. Number of collapses.
//! 4. For each collapse the removed point, and the difference to the number of the remaining point.
//! 5. Checksum of the result, 8 bytes, little endian.
//!
//! Counts and numbers are LEB128: groups of seven bits, lowest first, the eighth bit set in all but the last.
//! Differences are zigzag encoded, with the sign in the lowest bit.

use super::collapse_record::CollapseRecord;
use super::edge_collapse::{Collapser, DEGENERATE_STEP};
use super::flat_surface::IndexedSurface;
use crate::error::{Error, ErrorKind};
use crate::scene::Scene;

const FILE_MAGIC: &[u8] = b"ligne-lod";
const FILE_VERSION: u8 = 1;

/// Writes the collapses of a scene to the bytes of a file.
pub(crate) fn written(record: &CollapseRecord, scene: &Scene) -> Vec<u8> {
    let mut bytes = FILE_MAGIC.to_vec();
    bytes.push(FILE_VERSION);
    bytes.extend(model_checksum(&IndexedSurface::of(scene)).to_le_bytes());
    let steps = || record.steps.iter().filter(|step| step.from != DEGENERATE_STEP);
    put(&mut bytes, steps().count() as u64);
    for step in steps() {
        put(&mut bytes, u64::from(step.from));
        let far = i64::from(step.to) - i64::from(step.from);
        put(&mut bytes, (far << 1 ^ far >> 63).cast_unsigned());
    }
    bytes.extend(record_checksum(record).to_le_bytes());
    bytes
}

/// Reads the collapses of a scene from the bytes of a file, by repeating them on the surface.
pub(crate) fn read(bytes: &[u8], scene: &Scene) -> Result<CollapseRecord, Error> {
    let rest =
        bytes.strip_prefix(FILE_MAGIC).ok_or_else(|| Error::new("this is not a file of levels of detail"))?;
    let (version, rest) = rest.split_first().ok_or_else(cut_off)?;
    if *version != FILE_VERSION {
        return Err(Error::new(format!("levels of detail of version {version} cannot be read"))
            .of_kind(ErrorKind::Unsupported)
            .remedy("write them again with ligne lod"));
    }
    let (sum, mut rest) = rest.split_first_chunk().ok_or_else(cut_off)?;
    let flat = IndexedSurface::of(scene);
    if u64::from_le_bytes(*sum) != model_checksum(&flat) {
        return Err(Error::new(
            "these levels of detail belong to another model, or to an older version of it",
        )
        .remedy("write them again with ligne lod"));
    }
    let mut surface = Collapser::new(flat);
    let points = surface.sites.len() as u64;
    for step in 0..take(&mut rest)? {
        let from = take(&mut rest)?;
        let zigzag = take(&mut rest)?;
        let difference = (zigzag >> 1).cast_signed() ^ -(zigzag & 1).cast_signed();
        let to = from.checked_add_signed(difference).filter(|to| from.max(*to) < points && *to != from);
        // Point numbers fit in 32 bits.
        let is_replayed = to.is_some_and(|to| surface.replay(from as u32, to as u32));
        if !is_replayed {
            return Err(Error::new("a collapse of two points without an edge").at(format!("collapse {step}")));
        }
    }
    let sum: &[u8; 8] = rest.try_into().map_err(|_| cut_off())?;
    if u64::from_le_bytes(*sum) != record_checksum(&surface.record) {
        return Err(Error::new("the collapses do not match the model; the file is damaged"));
    }
    Ok(surface.record)
}

fn cut_off() -> Error {
    Error::new("the file ends too early or too late; it is damaged").remedy("write it again with ligne lod")
}

fn put(bytes: &mut Vec<u8>, mut number: u64) {
    while number > 0x7f {
        bytes.push(number as u8 | 0x80);
        number >>= 7;
    }
    bytes.push(number as u8);
}

fn take(bytes: &mut &[u8]) -> Result<u64, Error> {
    let mut number = 0;
    for shift in (0..63).step_by(7) {
        let (byte, rest) = bytes.split_first().ok_or_else(cut_off)?;
        *bytes = rest;
        number |= u64::from(byte & 0x7f) << shift;
        if *byte < 0x80 {
            return Ok(number);
        }
    }
    Err(Error::new("a number is too large; the file is damaged"))
}

/// Checksum over a sequence of words; their order matters.
#[derive(Default)]
struct Checksum(u64);

impl Checksum {
    fn add(&mut self, word: u64) {
        self.0 = (self.0.rotate_left(29) ^ word).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    }

    fn add_all<T>(&mut self, values: impl ExactSizeIterator<Item = T>, word: impl Fn(T) -> u64) {
        self.add(values.len() as u64);
        values.for_each(|value| self.add(word(value)));
    }

    fn add_triples(&mut self, triples: &[[u32; 3]]) {
        self.add_all(triples.as_flattened().iter(), |value| u64::from(*value));
    }
}

/// Checksum of everything that determines the order of collapses.
fn model_checksum(flat: &IndexedSurface) -> u64 {
    let mut sum = Checksum::default();
    sum.add_all(flat.points.iter(), |p| {
        let [x, y, z] = p.to_array().map(f64::to_bits);
        x ^ y.rotate_left(21) ^ z.rotate_left(42)
    });
    sum.add_triples(&flat.faces);
    sum.add_all(flat.wedges.iter(), |wedge| {
        u64::from(wedge.vertex)
            ^ u64::from(wedge.normal).rotate_left(21)
            ^ u64::from(wedge.uv).rotate_left(42)
    });
    sum.add_all(flat.class.iter(), |class| u64::from(*class));
    sum.add_all(flat.normals.as_flattened().iter(), |part| u64::from(part.to_bits()));
    sum.add_all(flat.material.iter(), |material| u64::from(*material));
    sum.add_all(flat.in_file.iter(), |face| u64::from(*face));
    sum.add_all(flat.marked.as_flattened().iter(), |marked| u64::from(*marked));
    sum.add_all(flat.ranges.iter(), |range| range.end as u64);
    sum.add_all(flat.weights.iter(), |weight| weight.to_bits());
    sum.0 ^ sum.0 >> 32
}

/// Checksum of the result after all collapses.
fn record_checksum(record: &CollapseRecord) -> u64 {
    let mut sum = Checksum::default();
    for step in &record.steps {
        sum.add(u64::from(step.changes_end) << 32 | u64::from(step.removed_end));
    }
    sum.add_all(record.changes.iter(), |change| u64::from(change.corner) << 32 | u64::from(change.after));
    sum.add_all(record.removed.iter(), |face| u64::from(*face));
    sum.0 ^ sum.0 >> 32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn variable_length_numbers_round_trip() {
        let numbers = [0, 1, 127, 128, 300, 1 << 20, u64::from(u32::MAX), (1 << 63) - 1];
        let mut bytes = Vec::new();
        numbers.iter().for_each(|number| put(&mut bytes, *number));
        let mut rest = &bytes[..];
        assert!(numbers.iter().all(|number| take(&mut rest) == Ok(*number)));
        assert!(rest.is_empty() && take(&mut rest).is_err() && take(&mut &[0xff; 12][..]).is_err());
    }
}
