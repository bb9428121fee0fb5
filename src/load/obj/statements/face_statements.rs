//! Parses the statements that refer to vertices: `f` and `l`.

use glam::DVec3;

use super::plain_statements::{CornerIndices, NO_INDEX, plain_triangle};
use super::{ParseStop, Parser};
use crate::error::Error;
use crate::load::polygons::triangulation::{self, CutOutcome};
use crate::load::text_cursor::Cursor;
use crate::mesh::EdgeMark;
use crate::scene::extent::coordinate_limits::is_drawable;

impl Parser<'_> {
    /// Next corner of a face or line; `None` at the end of the line.
    #[inline]
    fn corner(&mut self) -> Result<Option<CornerIndices>, ParseStop> {
        self.cursor.skip_blanks();
        if self.cursor.at_line_end() {
            return Ok(None);
        }
        let start = self.cursor.at;
        let mut index = 0;
        let digits = self.cursor.digits(&mut index);
        let position = if digits.wrapping_sub(1) < 18 && index.wrapping_sub(1) < self.position_count as u64 {
            (index - 1) as u32
        } else {
            self.cursor.at = start;
            self.unusual_position()?
        };
        let mut corner = [position, NO_INDEX, NO_INDEX];
        if self.cursor.peek() == b'/' {
            self.cursor.at += 1;
            corner[1] = self.attribute(self.out.uvs.len());
            if self.cursor.peek() == b'/' {
                self.cursor.at += 1;
                corner[2] = self.attribute(self.out.normals.len());
            }
        }
        if self.cursor.at_word_end() { Ok(Some(corner)) } else { Err(self.not_an_index().into()) }
    }

    /// Reads the corners up to the end of the line.
    fn read_corners(&mut self) -> Result<(), ParseStop> {
        self.corners.clear();
        while let Some(corner) = self.corner()? {
            self.corners.push(corner);
        }
        Ok(())
    }

    /// Index of a texture coordinate or normal; [`NO_INDEX`] if it is out of range.
    #[inline]
    fn attribute(&mut self, count: usize) -> u32 {
        match self.cursor.integer() {
            Some(index) if index > 0 => u32::try_from(index - 1).unwrap_or(NO_INDEX),
            Some(index) if index < 0 => usize::try_from(count as i64 + index)
                .ok()
                .and_then(|i| u32::try_from(i).ok())
                .unwrap_or(NO_INDEX),
            _ => NO_INDEX,
        }
    }

    /// Parses a negative index, or one of a vertex further below, or reports an error.
    #[cold]
    fn unusual_position(&mut self) -> Result<u32, ParseStop> {
        let index_start = self.cursor.clone();
        let Some(index) = self.cursor.integer() else { return Err(self.not_an_index().into()) };
        let count = self.position_count as i64;
        let zero_based = if index < 0 { count + index } else { index - 1 };
        let fail = |message: String| {
            let line_text = format!("line {}", index_start.line());
            Err(ParseStop::Error(
                Error::new(message).at(line_text).remedy("indices count from 1, or from −1 backwards"),
            ))
        };
        if index == 0 || zero_based < 0 {
            return fail(format!("vertex {index} does not exist"));
        }
        if zero_based >= count {
            if zero_based < self.out.positions.len() as i64 {
                return Ok(zero_based as u32);
            }
            let all = if self.second_pass { self.out.positions.len() } else { count_vertices(&self.cursor) };
            if self.second_pass || zero_based >= count + all as i64 {
                let all = if self.second_pass { all } else { self.position_count + all };
                return fail(format!("vertex {index} does not exist; the file has {all}"));
            }
            return Err(ParseStop::FaceFirst);
        }
        u32::try_from(zero_based)
            .or_else(|_| fail(format!("vertex {index} has coordinates that are too large")))
    }

    /// Parses `f`.
    #[inline]
    pub(crate) fn face(&mut self) -> Result<(), ParseStop> {
        if let Some((triangle, at)) = plain_triangle(self.cursor.bytes, self.cursor.at) {
            let exists = triangle.iter().all(|i| i.wrapping_sub(1) < self.position_count as u64);
            if exists && !self.out.has_bad_positions {
                self.cursor.at = at;
                self.out.triangles.push(triangle.map(|i| (i - 1) as u32));
                return Ok(());
            }
        }
        self.any_face()
    }

    #[inline(never)]
    fn any_face(&mut self) -> Result<(), ParseStop> {
        self.read_corners()?;
        if self.out.has_bad_positions && self.corners.iter().any(|c| !is_drawable(self.point(c[0]))) {
            self.unusable[0] += 1;
            return Ok(());
        }
        self.cut_corners();
        Ok(())
    }

    /// Triangulates the face with corners `corners`.
    fn cut_corners(&mut self) {
        match *self.corners.as_slice() {
            [a, b, c] => self.triangle([a, b, c], [EdgeMark::Unmarked; 3]),
            [] | [_] | [_, _] => self.too_short += 1,
            _ => self.polygon(),
        }
    }

    fn polygon(&mut self) {
        let corners = std::mem::take(&mut self.corners);
        let mut points = std::mem::take(&mut self.points);
        let mut cut = std::mem::take(&mut self.cut);
        points.clear();
        points.extend(corners.iter().map(|c| self.point(c[0])));
        cut.clear();
        if triangulation::triangulate(&points, &mut cut) == CutOutcome::TooLarge {
            self.out.warnings.count("concave polygons with too many corners, triangulated roughly", 1);
        }
        self.diagonals.of(&points);
        for triangle in &cut {
            if let [Some(&a), Some(&b), Some(&c)] = triangle.map(|i| corners.get(i as usize)) {
                self.triangle([a, b, c], self.diagonals.marks(*triangle));
            }
        }
        (self.corners, self.points, self.cut) = (corners, points, cut);
    }

    #[inline]
    fn point(&self, id: u32) -> DVec3 {
        self.out.positions.get(id as usize).copied().unwrap_or(DVec3::NAN)
    }

    #[inline]
    fn triangle(&mut self, [a, b, c]: [CornerIndices; 3], marks: [EdgeMark; 3]) {
        let count = self.out.triangles.len();
        self.out.triangles.push([a[0], b[0], c[0]]);
        if (a[1] & b[1] & c[1]) != NO_INDEX {
            self.out.corner_uvs.resize(count, [NO_INDEX; 3]);
            self.out.corner_uvs.push([a[1], b[1], c[1]]);
        }
        if (a[2] & b[2] & c[2]) != NO_INDEX {
            self.out.corner_normals.resize(count, [NO_INDEX; 3]);
            self.out.corner_normals.push([a[2], b[2], c[2]]);
        }
        if marks != [EdgeMark::Unmarked; 3] {
            self.out.edge_marks.resize(count, [EdgeMark::Unmarked; 3]);
            self.out.edge_marks.push(marks);
        }
    }

    pub(crate) fn line(&mut self) -> Result<(), ParseStop> {
        self.read_corners()?;
        if self.corners.len() < 2 {
            self.too_short += 1;
        }
        for pair in self.corners.windows(2) {
            if let [a, b] = pair {
                if self.out.has_bad_positions && [a, b].iter().any(|c| !is_drawable(self.point(c[0]))) {
                    self.unusable[1] += 1;
                } else {
                    self.out.wires.push([a[0], b[0]]);
                }
            }
        }
        Ok(())
    }
}

/// Number of vertices in the rest of the text.
fn count_vertices(cursor: &Cursor) -> usize {
    let mut cursor = cursor.clone();
    let mut count = 0;
    while !cursor.at_end() {
        cursor.rest_of_line();
        cursor.skip_space();
        count += usize::from(cursor.peek() == b'v' && matches!(cursor.peek_on(1), b' ' | b'\t'));
    }
    count
}
