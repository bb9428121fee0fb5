//! Reads the faces of a PLY file: polygons and triangle strips.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::element_rows::{ElementReader, RowValues, place};
use super::header::{Element, Encoding, ScalarType};
use super::vertex_element::{COLOUR_NAMES, MIN_TASK_ROWS, find};
use crate::colour::srgb::Colour;
use crate::error::Error;
use crate::load::polygons::added_diagonals::Diagonals;
use crate::load::polygons::triangulation::{self, CutOutcome};
use crate::mesh::EdgeMark;
use crate::scene::Warnings;
use crate::scene::extent::coordinate_limits::is_drawable;

const LIST_NAMES: [&str; 2] = ["vertex_indices", "vertex_index"];

/// Collects triangles over the positions of the file.
pub(crate) struct FaceReader<'a> {
    positions: &'a [DVec3],
    has_bad_positions: bool,
    corners: Vec<u32>,
    points: Vec<DVec3>,
    cut: Vec<[u32; 3]>,
    diagonals: Diagonals,
    /// Triangles read so far.
    pub triangles: Vec<[u32; 3]>,
    /// Colour of each triangle; empty if faces have none.
    pub colours: Vec<Option<Colour>>,
    /// Marks of their sides; at most as long as `triangles`, the remaining ones are unmarked.
    pub edge_marks: Vec<[EdgeMark; 3]>,
    /// Number of faces left out because of their coordinates.
    pub unusable: u64,
    pub warnings: Warnings,
}

impl<'a> FaceReader<'a> {
    /// Starts without faces.
    pub(crate) fn new(positions: &'a [DVec3]) -> Self {
        Self {
            positions,
            has_bad_positions: !positions.par_iter().with_min_len(MIN_TASK_ROWS).all(|&p| is_drawable(p)),
            corners: Vec::new(),
            points: Vec::new(),
            cut: Vec::new(),
            diagonals: Diagonals::default(),
            triangles: Vec::new(),
            colours: Vec::new(),
            edge_marks: Vec::new(),
            unusable: 0,
            warnings: Warnings::default(),
        }
    }

    /// Reads the element `face`.
    pub(crate) fn polygons(&mut self, body: &mut ElementReader, element: &Element) -> Result<(), Error> {
        let count = body.check_count(element)?;
        let Some(list) = element.find(&LIST_NAMES).filter(|&p| is_list(element, p)) else {
            self.warnings.note("faces without a list of vertices left out");
            return skip(body, element);
        };
        self.triangles.reserve(count);
        let colour = ColourColumns::new(element);
        let packed = Packed::new(body, element, list).filter(|_| colour.is_none());
        let mut too_short = 0;
        let mut row = RowValues::default();
        let first = packed.as_ref().map_or(0, |packed| self.first_triangles(packed, body, count));
        for number in first..count {
            if let Some((triangle, size)) = packed.as_ref().and_then(|p| p.triangle(body.rest())) {
                let exists = triangle.iter().all(|&i| (i as usize) < self.positions.len());
                if exists && !self.has_bad_positions {
                    self.triangles.push(triangle);
                    body.cursor.at += size;
                    continue;
                }
            }
            let start = body.cursor.clone();
            body.row(element, number, &mut row)?;
            let mut corners = std::mem::take(&mut self.corners);
            corners.clear();
            for &index in row.list(list) {
                let Some(index) = index_of(index, self.positions) else {
                    return Err(no_vertex(index, self.positions).at(body.place(start, element, number)));
                };
                corners.push(index);
            }
            too_short += u64::from(corners.len() < 3);
            self.polygon(&corners);
            self.corners = corners;
            if let Some(colour) = &colour {
                self.colours.resize(self.triangles.len(), Some(colour.of(&row)));
            }
        }
        self.warnings.count("faces left out, with too few corners", too_short);
        Ok(())
    }

    /// Reads the leading rows that are triangles, in parallel, and returns their number. In most files these
    /// are all rows, and all have the same size.
    fn first_triangles(&mut self, packed: &Packed, body: &mut ElementReader, count: usize) -> usize {
        if self.has_bad_positions {
            return 0;
        }
        let (size, vertices) = (packed.size(), self.positions.len());
        let rows = body.rest();
        let rows = rows.get(..count.min(rows.len() / size) * size).unwrap_or_default();
        let triangle = |row: &[u8]| {
            let (triangle, _) = packed.triangle(row)?;
            triangle.iter().all(|&i| (i as usize) < vertices).then_some(triangle)
        };
        let before = self.triangles.len();
        let chunks = rows.par_chunks(size * MIN_TASK_ROWS);
        let read: Vec<Vec<[u32; 3]>> =
            chunks.map(|rows| rows.chunks_exact(size).map_while(triangle).collect()).collect();
        self.triangles.reserve(read.iter().map(Vec::len).sum());
        for (triangles, rows) in read.into_iter().zip(rows.chunks(size * MIN_TASK_ROWS)) {
            let is_whole = triangles.len() * size == rows.len();
            self.triangles.extend(triangles);
            if !is_whole {
                break;
            }
        }
        let first = self.triangles.len() - before;
        body.cursor.at += first * size;
        first
    }

    /// Reads the element `tristrips`; −1 starts a new strip.
    pub(crate) fn strips(&mut self, body: &mut ElementReader, element: &Element) -> Result<(), Error> {
        let count = body.check_count(element)?;
        let Some(list) = element.find(&LIST_NAMES).filter(|&p| is_list(element, p)) else {
            return skip(body, element);
        };
        let mut row = RowValues::default();
        for number in 0..count {
            body.row(element, number, &mut row)?;
            let values = row.list(list);
            for strip in values.split(|&index| index == -1.0) {
                let ids: Option<Vec<u32>> =
                    strip.iter().map(|&index| index_of(index, self.positions)).collect();
                let Some(ids) = ids else {
                    let bad = strip.iter().copied().find(|&index| index_of(index, self.positions).is_none());
                    return Err(no_vertex(bad.unwrap_or_default(), self.positions).at(place(element, number)));
                };
                for (i, corners) in ids.windows(3).enumerate() {
                    let &[a, b, c] = corners else { continue };
                    // Every other triangle has reversed winding; repeated corners only steer the strip.
                    if a != b && b != c && c != a {
                        self.polygon(&if i % 2 == 0 { [a, b, c] } else { [b, a, c] });
                    }
                }
            }
        }
        Ok(())
    }

    fn polygon(&mut self, corners: &[u32]) {
        self.points.clear();
        self.points.extend(corners.iter().filter_map(|&i| self.positions.get(i as usize)));
        if self.has_bad_positions && !self.points.iter().all(|&p| is_drawable(p)) {
            self.unusable += 1;
            return;
        }
        self.cut.clear();
        if triangulation::triangulate(&self.points, &mut self.cut) == CutOutcome::TooLarge {
            self.warnings.count("concave polygons with too many corners, triangulated roughly", 1);
        }
        let id = |corner: u32| corners.get(corner as usize).copied().unwrap_or_default();
        if self.cut.len() > 1 {
            self.diagonals.of(&self.points);
            self.edge_marks.resize(self.triangles.len(), [EdgeMark::Unmarked; 3]);
            self.edge_marks.extend(self.cut.iter().map(|triangle| self.diagonals.marks(*triangle)));
        }
        self.triangles.extend(self.cut.iter().map(|triangle| triangle.map(id)));
    }
}

/// Vertex index for a number of the file.
pub(crate) fn index_of(value: f64, positions: &[DVec3]) -> Option<u32> {
    let exists =
        value >= 0.0 && value < positions.len().min(u32::MAX as usize) as f64 && value.fract() == 0.0;
    exists.then_some(value as u32)
}

/// Error for an index out of range.
#[cold]
pub(crate) fn no_vertex(index: f64, positions: &[DVec3]) -> Error {
    Error::new(format!("vertex {index} does not exist; the file has {}", positions.len()))
        .remedy("indices count from 0")
}

/// Properties with the colour of a face.
struct ColourColumns {
    channels: [(usize, ScalarType); 3],
    alpha: Option<(usize, ScalarType)>,
}

impl ColourColumns {
    fn new(element: &Element) -> Option<Self> {
        let kind = |property: usize| element.properties.get(property).map_or(ScalarType::U8, |p| p.kind);
        let channels = COLOUR_NAMES.iter().find_map(|names| find(element, *names))?;
        let is_number = |property: &usize| !is_list(element, *property);
        let alpha = element.find(&["alpha", "diffuse_alpha", "a"]).filter(is_number);
        channels.iter().all(is_number).then(|| Self {
            channels: channels.map(|property| (property, kind(property))),
            alpha: alpha.map(|property| (property, kind(property))),
        })
    }

    fn of(&self, row: &RowValues) -> Colour {
        let byte = |(property, kind): (usize, ScalarType)| {
            (row.value(property) / kind.full() * 255.0).round().clamp(0.0, 255.0) as u8
        };
        let [r, g, b] = self.channels.map(byte);
        Colour { r, g, b, a: self.alpha.map_or(255, byte) }
    }
}

fn is_list(element: &Element, property: usize) -> bool {
    element.properties.get(property).is_some_and(|p| p.list.is_some())
}

/// Skips an element.
pub(crate) fn skip(body: &mut ElementReader, element: &Element) -> Result<(), Error> {
    let count = body.check_count(element)?;
    let mut row = RowValues::default();
    (0..count).try_for_each(|number| body.row(element, number, &mut row))
}

/// The most frequent layout of rows: a byte for the length, 32-bit indices, and possibly numbers before and
/// after.
struct Packed {
    before: usize,
    after: usize,
}

impl Packed {
    fn new(body: &ElementReader, element: &Element, list: usize) -> Option<Self> {
        let property = element.properties.get(list)?;
        let usual = property.list == Some(ScalarType::U8)
            && matches!(property.kind, ScalarType::I32 | ScalarType::U32)
            && body.encoding == Encoding::Little;
        let others = element.properties.iter().skip(list + 1);
        let after: Option<usize> = others.map(|p| p.list.is_none().then(|| p.kind.size())).sum();
        usual.then_some(Self { before: element.offset(list)?, after: after? })
    }

    /// Number of bytes of a triangle's row.
    fn size(&self) -> usize {
        self.before + 13 + self.after
    }

    /// Triangle at the start of some bytes, and the size of its row; `None` if it is another polygon, or cut
    /// off.
    #[inline]
    fn triangle(&self, bytes: &[u8]) -> Option<([u32; 3], usize)> {
        let row = bytes.get(self.before..)?.first_chunk::<13>()?;
        let size = self.size();
        let &[3, a, b, c, d, e, f, g, h, i, j, k, l] = row else { return None };
        let corners = [[a, b, c, d], [e, f, g, h], [i, j, k, l]].map(u32::from_le_bytes);
        (bytes.len() >= size).then_some((corners, size))
    }
}
