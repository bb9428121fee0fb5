//! The statements of an OBJ file as flat arrays, in one pass over its bytes.
//!
//! 1. [`plain_statements`] recognises statements of plain numbers, the bulk of large files.
//! 2. The parser reads all other statements: [`face_statements`] for `f` and `l`, [`lenient_numbers`] for
//!    numbers in unusual notation.

mod face_statements;
mod lenient_numbers;
mod plain_statements;

use std::ops::Range;

use glam::DVec3;
pub(crate) use plain_statements::NO_INDEX;
use plain_statements::{CornerIndices, plain_position};

use crate::error::Error;
use crate::load::polygons::added_diagonals::Diagonals;
use crate::load::quoted_start;
use crate::load::text_cursor::Cursor;
use crate::mesh::EdgeMark;
use crate::scene::Warnings;
use crate::scene::extent::coordinate_limits::is_drawable;
use crate::scene::warnings::WarningExamples;

/// Consecutive triangles and wires of one part and one material.
#[derive(Debug, Clone)]
pub(crate) struct ElementRun {
    /// Index into `objects`.
    pub object: usize,
    /// Index into `materials`, if there was a `usemtl` before.
    pub material: Option<usize>,
    /// Its triangles.
    pub triangles: Range<usize>,
    /// Its wires.
    pub wires: Range<usize>,
}

/// An `o`, a `g`, or the part before both.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Object<'a> {
    Unnamed,
    Named(&'a [u8]),
}

/// Content of an OBJ file, with polygons triangulated.
#[derive(Default)]
pub(crate) struct Statements<'a> {
    pub positions: Vec<DVec3>,
    /// Vertex colours; shorter than `positions` if the last vertices have none, or empty.
    pub colours: Vec<[f32; 3]>,
    pub uvs: Vec<[f32; 2]>,
    pub normals: Vec<[f32; 3]>,
    pub triangles: Vec<[u32; 3]>,
    /// At most as long as `triangles`; the remaining triangles have none.
    pub corner_uvs: Vec<[u32; 3]>,
    pub corner_normals: Vec<[u32; 3]>,
    /// At most as long as `triangles`; the remaining triangles are unmarked.
    pub edge_marks: Vec<[EdgeMark; 3]>,
    pub wires: Vec<[u32; 2]>,
    pub runs: Vec<ElementRun>,
    pub objects: Vec<Object<'a>>,
    /// Names of `usemtl`, each once, in order of first use.
    pub materials: Vec<&'a [u8]>,
    pub libraries: Vec<&'a [u8]>,
    /// Whether any position cannot be drawn.
    pub has_bad_positions: bool,
    /// Number of vertices with only x and y.
    flat_vertices: usize,
    pub warnings: Warnings,
}

/// Reason for which parsing stopped.
enum ParseStop {
    Error(Error),
    /// A face before its vertices.
    FaceFirst,
}

impl From<Error> for ParseStop {
    fn from(error: Error) -> Self {
        Self::Error(error)
    }
}

impl<'a> Statements<'a> {
    /// Parses a file.
    pub(crate) fn parse(bytes: &'a [u8]) -> Result<Self, Error> {
        let statements = Self::parse_as(bytes, false)?;
        // If no vertex has a z coordinate, the file is a plane drawing.
        if statements.flat_vertices > 0 && statements.flat_vertices == statements.positions.len() {
            return Self::parse_as(bytes, true);
        }
        Ok(statements)
    }

    /// Parses a file; with `is_flat`, vertices of two coordinates have z = 0.
    fn parse_as(bytes: &'a [u8], is_flat: bool) -> Result<Self, Error> {
        let parser = |positions| Parser { is_flat, ..Parser::new(bytes, positions) };
        match parser(Vec::new()).run() {
            Ok(statements) => Ok(statements),
            Err(ParseStop::Error(error)) => Err(error),
            Err(ParseStop::FaceFirst) => {
                // Some exporters write the faces first, but triangulation needs all positions, so they are
                // read in a first pass.
                let mut first = parser(Vec::new());
                first.only_vertices = true;
                let vertices = first.run().map_err(ParseStop::into_error)?;
                parser(vertices.positions).run().map_err(ParseStop::into_error)
            }
        }
    }
}

impl ParseStop {
    fn into_error(self) -> Error {
        match self {
            Self::Error(error) => error,
            Self::FaceFirst => Error::new("a face uses a vertex that is not in the file"),
        }
    }
}

struct Parser<'a> {
    cursor: Cursor<'a>,
    out: Statements<'a>,
    /// Positions read so far; fewer than `out.positions` in a second pass.
    position_count: usize,
    second_pass: bool,
    only_vertices: bool,
    /// Whether vertices of two coordinates have z = 0.
    is_flat: bool,
    corners: Vec<CornerIndices>,
    points: Vec<DVec3>,
    cut: Vec<[u32; 3]>,
    diagonals: Diagonals,
    has_objects: bool,
    object: usize,
    material: Option<usize>,
    groups: rustc_hash::FxHashMap<&'a [u8], usize>,
    material_ids: rustc_hash::FxHashMap<&'a [u8], usize>,
    /// Faces and lines left out because of an invalid corner.
    unusable: [u64; 2],
    too_short: u64,
    points_passed: u64,
    not_understood: u64,
    odd_numbers: WarningExamples,
    /// Vertices with a coordinate that cannot be read or drawn.
    unplaced: WarningExamples,
    /// Whether the present vertex is one of them.
    is_unplaced: bool,
}

impl<'a> Parser<'a> {
    fn new(bytes: &'a [u8], positions: Vec<DVec3>) -> Self {
        let second_pass = !positions.is_empty();
        let objects = vec![Object::Unnamed];
        Self {
            cursor: Cursor::new(bytes),
            out: Statements { positions, objects, ..Statements::default() },
            position_count: 0,
            second_pass,
            only_vertices: false,
            is_flat: false,
            corners: Vec::new(),
            points: Vec::new(),
            cut: Vec::new(),
            diagonals: Diagonals::default(),
            has_objects: false,
            object: 0,
            material: None,
            groups: Default::default(),
            material_ids: Default::default(),
            unusable: [0; 2],
            too_short: 0,
            points_passed: 0,
            not_understood: 0,
            odd_numbers: WarningExamples::default(),
            unplaced: WarningExamples::default(),
            is_unplaced: false,
        }
    }

    fn run(mut self) -> Result<Statements<'a>, ParseStop> {
        self.out.has_bad_positions = self.out.positions.iter().any(|&p| !is_drawable(p));
        while !self.cursor.at_end() {
            let c = &mut self.cursor;
            match (c.peek(), c.peek_on(1)) {
                (b'v', b' ' | b'\t') => {
                    c.at += 2;
                    self.position();
                }
                (b'f', b' ' | b'\t') if !self.only_vertices => {
                    c.at += 2;
                    self.face()?;
                }
                (b' ' | b'\t' | b'\n' | b'\r' | b'\\', _) => c.at += 1,
                _ => self.other()?,
            }
        }
        self.close_run();
        let Self { mut out, unusable, too_short, points_passed, not_understood, odd_numbers, .. } = self;
        let (is_flat, unplaced) = (self.is_flat, self.unplaced);
        if let Some(vertices) = unplaced.sentence() {
            out.warnings.note(format!("{vertices}; {}", lenient_numbers::left_out_sentence(unusable)));
        }
        if is_flat {
            out.warnings.note("no vertex has a z coordinate; all are drawn at z = 0");
        }
        out.warnings.count("faces or lines left out, with too few corners", too_short);
        out.warnings.count("points left out", points_passed);
        out.warnings.count("lines left out that are not OBJ statements", not_understood);
        odd_numbers.warn(&mut out.warnings);
        Ok(out)
    }

    /// Parses the less frequent statements.
    fn other(&mut self) -> Result<(), ParseStop> {
        let start = self.cursor.at;
        let keyword = self.cursor.word();
        match keyword {
            b"vt" => {
                let u = self.number();
                self.cursor.skip_blanks();
                let v = if self.cursor.at_line_end() { 0.0 } else { self.number() };
                self.out.uvs.push([u as f32, v as f32]);
                self.pass_line();
            }
            b"vn" => {
                let normal = [self.number(), self.number(), self.number()].map(|n| n as f32);
                self.out.normals.push(normal);
                self.pass_line();
            }
            b"v" => self.position(),
            b"f" if !self.only_vertices => self.face()?,
            b"l" if !self.only_vertices => self.line()?,
            b"p" => {
                self.points_passed += 1;
                self.pass_line();
            }
            b"o" => {
                let name = self.cursor.rest_of_line();
                if !self.has_objects {
                    // Groups inside objects are ignored.
                    self.groups.clear();
                    self.has_objects = true;
                }
                self.begin_object(name);
            }
            b"g" => {
                let name = self.cursor.rest_of_line();
                if self.has_objects {
                    return Ok(());
                }
                self.close_run();
                match self.groups.get(name) {
                    Some(&object) => self.object = object,
                    None => {
                        self.begin_object(name);
                        self.groups.insert(name, self.object);
                    }
                }
            }
            b"usemtl" => {
                let name = self.cursor.rest_of_line();
                self.close_run();
                let next = self.out.materials.len();
                let id = *self.material_ids.entry(name).or_insert(next);
                if id == next {
                    self.out.materials.push(name);
                }
                self.material = Some(id);
            }
            b"mtllib" => {
                let name = self.cursor.rest_of_line();
                self.out.libraries.push(name);
            }
            _ => {
                let known = keyword.first().is_some_and(|c| c.is_ascii_alphabetic() || *c == b'#')
                    && keyword.iter().all(|c| (b' '..=b'~').contains(c));
                if !known && self.cursor.at > start {
                    self.not_understood += 1;
                }
                if keyword.starts_with(b"#") {
                    _ = self.cursor.rest_of_line()
                } else {
                    self.pass_line()
                }
                // A byte that is neither part of a word nor a blank.
                if self.cursor.at == start {
                    self.cursor.at += 1;
                }
            }
        }
        Ok(())
    }

    fn begin_object(&mut self, name: &'a [u8]) {
        self.close_run();
        self.object = self.out.objects.len();
        self.out.objects.push(Object::Named(name));
    }

    /// Ends the run of triangles and wires before a change of part or material.
    fn close_run(&mut self) {
        let (triangles, wires) =
            self.out.runs.last().map_or((0, 0), |run| (run.triangles.end, run.wires.end));
        let (triangles, wires) = (triangles..self.out.triangles.len(), wires..self.out.wires.len());
        if !triangles.is_empty() || !wires.is_empty() {
            self.out.runs.push(ElementRun { object: self.object, material: self.material, triangles, wires });
        }
    }

    /// Skips the rest of a statement, including continuation lines.
    fn pass_line(&mut self) {
        while self.cursor.rest_of_line().ends_with(b"\\") && !self.cursor.at_end() {
            self.cursor.at +=
                if (self.cursor.peek(), self.cursor.peek_on(1)) == (b'\r', b'\n') { 2 } else { 1 };
        }
    }

    /// Parses `v x y z`, with an optional weight or colour.
    #[inline]
    fn position(&mut self) {
        match plain_position(self.cursor.bytes, self.cursor.at) {
            Some((point, at)) => {
                self.cursor.at = at;
                self.add_position(point);
            }
            None => self.any_position(),
        }
    }

    #[inline]
    fn add_position(&mut self, point: DVec3) {
        self.position_count += 1;
        if !self.second_pass {
            self.out.has_bad_positions |= !is_drawable(point);
            self.out.positions.push(point);
        }
    }

    #[cold]
    fn not_an_index(&self) -> Error {
        let word = quoted_start(self.cursor.clone().word());
        Error::new(format!("`{word}` is not the index of a vertex"))
            .at(format!("line {}", self.cursor.line()))
    }
}
