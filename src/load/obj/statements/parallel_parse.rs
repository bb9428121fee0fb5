//! [`ParallelParse`]: parses long runs of plain statements on several threads, ahead of the parser.
//!
//! Vertices and faces of plain numbers are the bulk of every large file, and can be parsed independently of
//! each other. The text is divided into blocks at line ends, and plain statements in the blocks are parsed in
//! parallel. The parser then visits the text in order: at the beginning of a run it takes the whole run, and
//! it parses all other statements itself.

use std::collections::VecDeque;

use crate::parallel::prelude::*;
use glam::DVec3;

use super::plain_statements::{CornerIndices, NO_CORNER, plain_face, plain_position, plain_triangle};
use crate::load::text_cursor::plain_number;
use crate::scene::extent::coordinate_limits::is_drawable;

/// Minimum size of a text for parallel parsing, bytes. Shorter texts are parsed before other threads have
/// started.
const MIN_PARALLEL_BYTES: usize = 1 << 17;
/// Bytes per parallel task.
const BLOCK_BYTES: usize = 1 << 16;
/// Blocks parsed at a time. Bounds the memory for data that is held twice.
const BLOCKS_PER_READ: usize = 32;
/// A block is left to the parser after this number of other statements, plus one for each `PLAIN_PER_OTHER`
/// plain ones.
const MAX_OTHER_STATEMENTS: usize = 64;
const PLAIN_PER_OTHER: usize = 16;

/// Consecutive statements of one kind.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct StatementRun {
    /// Byte index of the start of the first statement.
    start: usize,
    /// Byte index of the end of the last statement's line.
    pub end: usize,
    pub read: RunValues,
}

/// Values of a run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum RunValues {
    /// `v`: positions that can be drawn.
    Positions(Vec<DVec3>),
    /// `vt`.
    Uvs(Vec<[f32; 2]>),
    /// `vn`.
    Normals(Vec<[f32; 3]>),
    /// `f` with three plain indices, counted from 0, and the largest of them.
    Triangles(Vec<[u32; 3]>, u32),
    /// `f` with three or four corners, some with texture coordinates or normals, and the largest position
    /// index. The fourth corner of a triangle is [`NO_CORNER`].
    Faces(Vec<[CornerIndices; 4]>, u32),
}

/// Runs that were parsed ahead of the parser.
#[derive(Debug, Default)]
pub(crate) struct ParallelParse {
    /// Runs in text order.
    runs: VecDeque<StatementRun>,
    /// Byte index of the next block.
    next: usize,
    /// Bytes per block; 0 if nothing is parsed ahead.
    block: usize,
}

impl ParallelParse {
    /// Chooses parallel parsing if the text is long enough.
    pub(crate) fn of(bytes: &[u8]) -> Self {
        let alone = bytes.len() < MIN_PARALLEL_BYTES || rayon_core::current_num_threads() == 1;
        Self::with_blocks(if alone { 0 } else { BLOCK_BYTES })
    }

    /// Parses in blocks of about `block` bytes.
    pub(crate) fn with_blocks(block: usize) -> Self {
        Self { block, ..Self::default() }
    }

    /// Takes the run that begins at `at`, the start of a statement.
    #[inline]
    pub(crate) fn take(&mut self, bytes: &[u8], at: usize) -> Option<StatementRun> {
        if self.block == 0 || (at < self.next && self.runs.front().is_none_or(|run| at < run.start)) {
            return None;
        }
        self.take_there(bytes, at)
    }

    #[inline(never)]
    fn take_there(&mut self, bytes: &[u8], at: usize) -> Option<StatementRun> {
        // Skip runs inside a statement that the parser has already consumed, such as a continued line.
        while self.runs.front().is_some_and(|run| run.start < at) {
            self.runs.pop_front();
        }
        if self.runs.is_empty() && at >= self.next {
            self.read(bytes, at);
        }
        self.runs.pop_front_if(|run| run.start == at)
    }

    /// Parses the blocks that begin at `at`.
    fn read(&mut self, bytes: &[u8], at: usize) {
        let mut starts = vec![at];
        while let Some(last) = starts.last().copied().filter(|last| *last < bytes.len()) {
            if starts.len() > BLOCKS_PER_READ {
                break;
            }
            let from = (last + self.block).min(bytes.len());
            let line = memchr::memchr(b'\n', bytes.get(from..).unwrap_or_default());
            starts.push(line.map_or(bytes.len(), |length| from + length + 1));
        }
        self.next = starts.last().copied().unwrap_or(bytes.len());
        let blocks: Vec<[usize; 2]> = starts.array_windows().copied().collect();
        let runs: Vec<Vec<StatementRun>> =
            blocks.into_par_iter().with_max_len(1).map(|[start, end]| runs(bytes, start, end)).collect();
        self.runs = runs.into_iter().flatten().collect();
    }
}

/// Runs in the lines between two byte indices.
fn runs(bytes: &[u8], start: usize, end: usize) -> Vec<StatementRun> {
    let mut runs: Vec<StatementRun> = Vec::new();
    let (mut at, mut plain, mut others, mut joins) = (start, 0, 0, false);
    while at < end {
        let Some(first) = bytes.get(at) else { break };
        if matches!(first, b'\n' | b'\r') {
            at += 1;
            continue;
        }
        let read = match (first, bytes.get(at + 1), bytes.get(at + 2)) {
            (b'v', Some(b' '), _) => position(bytes, at + 2),
            (b'f', Some(b' '), _) => face(bytes, at + 2),
            (b'v', Some(b'n'), Some(b' ')) => normal(bytes, at + 3),
            (b'v', Some(b't'), Some(b' ')) => uv(bytes, at + 3),
            _ => None,
        };
        let read = read.map(|(one, end)| {
            let run = runs.last_mut().filter(|_| joins);
            if !run.is_some_and(|run| run.takes(&one, end)) {
                runs.push(StatementRun { start: at, end, read: one.into() });
            }
            end
        });
        joins = read.is_some();
        at = match read {
            Some(at) => {
                plain += 1;
                at
            }
            None => {
                others += 1;
                if others > MAX_OTHER_STATEMENTS + plain / PLAIN_PER_OTHER {
                    break;
                }
                let rest = bytes.get(at..).unwrap_or_default();
                at + memchr::memchr2(b'\n', b'\r', rest).unwrap_or(rest.len())
            }
        };
    }
    runs
}

/// Values of one plain statement.
enum PlainStatement {
    Position(DVec3),
    Uv([f32; 2]),
    Normal([f32; 3]),
    Triangle([u32; 3]),
    Face([CornerIndices; 4]),
}

impl StatementRun {
    /// Adds a statement that ends at `end`, if it has the same kind as the run.
    #[inline]
    fn takes(&mut self, one: &PlainStatement, end: usize) -> bool {
        match (&mut self.read, one) {
            (RunValues::Positions(all), PlainStatement::Position(point)) => all.push(*point),
            (RunValues::Uvs(all), PlainStatement::Uv(uv)) => all.push(*uv),
            (RunValues::Normals(all), PlainStatement::Normal(normal)) => all.push(*normal),
            (RunValues::Triangles(all, largest), PlainStatement::Triangle(corners)) => {
                *largest = corners.iter().fold(*largest, |largest, corner| largest.max(*corner));
                all.push(*corners);
            }
            (RunValues::Faces(all, largest), PlainStatement::Face(corners)) => {
                *largest = largest_of(corners).max(*largest);
                all.push(*corners);
            }
            _ => return false,
        }
        self.end = end;
        true
    }
}

impl From<PlainStatement> for RunValues {
    fn from(one: PlainStatement) -> Self {
        match one {
            PlainStatement::Position(point) => Self::Positions(vec![point]),
            PlainStatement::Uv(uv) => Self::Uvs(vec![uv]),
            PlainStatement::Normal(normal) => Self::Normals(vec![normal]),
            PlainStatement::Triangle(corners @ [a, b, c]) => Self::Triangles(vec![corners], a.max(b).max(c)),
            PlainStatement::Face(corners) => Self::Faces(vec![corners], largest_of(&corners)),
        }
    }
}

/// Largest position index of a face.
fn largest_of(corners: &[CornerIndices; 4]) -> u32 {
    corners.iter().filter(|corner| **corner != NO_CORNER).fold(0, |largest, corner| largest.max(corner[0]))
}

#[inline]
fn position(bytes: &[u8], at: usize) -> Option<(PlainStatement, usize)> {
    let (point, end) = plain_position(bytes, at).filter(|(point, _)| is_drawable(*point))?;
    Some((PlainStatement::Position(point), end))
}

#[inline]
fn normal(bytes: &[u8], at: usize) -> Option<(PlainStatement, usize)> {
    let (normal, end) = plain_position(bytes, at)?;
    Some((PlainStatement::Normal(normal.to_array().map(|n| n as f32)), end))
}

#[inline]
fn uv(bytes: &[u8], at: usize) -> Option<(PlainStatement, usize)> {
    let (u, at) = plain_number(bytes, at)?;
    let (v, at) = plain_number(bytes, at + 1).filter(|_| bytes.get(at) == Some(&b' '))?;
    matches!(bytes.get(at)?, b'\n' | b'\r').then_some((PlainStatement::Uv([u as f32, v as f32]), at))
}

#[inline]
fn face(bytes: &[u8], at: usize) -> Option<(PlainStatement, usize)> {
    let Some((corners, end)) = plain_triangle(bytes, at) else {
        let (corners, end) = plain_face(bytes, at)?;
        return Some((PlainStatement::Face(corners), end));
    };
    let [a, b, c] = corners.map(|index| index.wrapping_sub(1));
    u32::try_from(a.max(b).max(c)).ok()?;
    Some((PlainStatement::Triangle([a as u32, b as u32, c as u32]), end))
}

#[cfg(test)]
mod tests {
    use super::super::{ParseStop, Parser, Statements};
    use super::*;
    use std::fmt::Write;

    fn parsed(text: &[u8], block: usize) -> Result<Statements<'_>, String> {
        let mut parser = Parser::new(text, Vec::new());
        parser.ahead = ParallelParse::with_blocks(block);
        parser.run().map_err(|stop| match stop {
            ParseStop::Error(error) => error.to_string(),
            ParseStop::FaceFirst => "a face first".to_owned(),
        })
    }

    /// Debug text of everything in a text, or the error.
    fn parsed_debug_text(text: &[u8], block: usize) -> String {
        parsed(text, block).map_or_else(
            |error| error,
            |s| {
                let places = (s.positions, s.colours, s.uvs, s.normals, s.triangles);
                let faces = (s.corner_uvs, s.corner_normals, s.edge_marks, s.wires, s.runs, s.objects);
                format!("{places:?} {faces:?} {:?} {}", s.materials, s.warnings.lines().join("\n"))
            },
        )
    }

    fn sample_text(odd: &[&str]) -> String {
        let mut text = String::new();
        for k in 0..600_i32 {
            let _ = writeln!(text, "v {} {}.5 -{}", k % 13, k % 7, k);
            if k % 11 == 2 {
                let _ = writeln!(text, "f {} {} {}", k - 1, k, k + 1);
            }
            if let Some(line) = odd.get(usize::try_from(k / 7).unwrap()).filter(|_| k % 7 == 3) {
                text += line;
            }
        }
        text
    }

    #[test]
    fn parallel_parse_matches_sequential_parsing() {
        let odd = [
            "# v 1 2 3\n",
            "o one\n",
            "v 1 2 3 0.5 0.5 0.5\n",
            "f 1 2 3 4\n",
            "\n\n",
            "f -1 -2 -3\n",
            "g x \\\nf 1 2 3\n",
            "usemtl red\r\n",
            "  v 1 2 3\n",
            "v 1 2\\\n 3\n",
            "v 1e3 2 3\n",
            "l 1 2 3\n",
            "vn 0 0 1\n",
            "f 1//1 2//1 3//1\n",
            "v nan 1 2\n",
            "f 1 2 3\n",
            "junk\\\nv 4 5 6\nv 7 8 9\n",
            "v 1 2 3\rf 1 2 3\r",
            "mtllib a.mtl\n",
        ];
        let plain = sample_text(&[]);
        let mut faces = plain.clone();
        for k in 1..300 {
            let _ = writeln!(faces, "vn 0 {k} 1\nvn 1 0 {k}\nvt 0.{k} 1\nvt {k} 1 0\nvt 1  2");
        }
        for k in 1..300 {
            let _ = writeln!(faces, "f {k}/{k} {}/1 3/2\nf {k}//{k} {}//2 3//1 7//9999", k + 1, k + 2);
            let _ = writeln!(faces, "f {k}/{k}/1 {}/1/2 9/2/ 8/0/2 \nf 1/1/1 2// 3/-1/1\nf 1 2 3 4", k + 1);
            let _ = writeln!(faces, "f 9 8\nf 1 2 3 4 5\nf {k} 2 3\r\nf  4  {k}  6 ");
        }
        let mixed = sample_text(&odd);
        let odd_ends = ["f 1/1 2/2 /3", "f 1 2 0 4", "f 1/1 2/2 9999/1", "f 1 2 9999", "f 1 2 x", "f 1 2 3"];
        let ended = odd_ends.map(|line| format!("{faces}{line}"));
        let going_on = odd_ends.map(|line| format!("{plain}{line}\n{plain}"));
        for text in [&plain, &mixed, &faces].into_iter().chain(&ended).chain(&going_on) {
            let wanted = parsed_debug_text(text.as_bytes(), 0);
            for block in [1, 40, 300, 5000, 1 << 20] {
                assert_eq!(parsed_debug_text(text.as_bytes(), block), wanted, "blocks of {block}");
            }
        }
    }

    #[test]
    fn parallel_parse_finds_whole_runs_of_vertices_and_faces() {
        let text = b"v 1 2 3\nv 4 5 6\n\nf 1 2 3\n# f 1 2 3\nf 3 2 1\nf 0 1 2\nf 1 2 3\n";
        let found_runs = runs(text, 0, text.len());
        let spans: Vec<[usize; 2]> = found_runs.iter().map(|run| [run.start, run.end]).collect();
        assert_eq!(spans, [[0, 15], [17, 24], [35, 42], [51, 58]]);
        assert_eq!(found_runs[1].read, RunValues::Triangles(vec![[0, 1, 2]], 2));
        // Parallel parsing gives up soon on a file of other statements.
        let other_text = "s 1\n".repeat(1000) + "v 1 2 3\n";
        assert!(runs(other_text.as_bytes(), 0, other_text.len()).is_empty());
    }
}
