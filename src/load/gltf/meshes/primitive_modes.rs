//! Assembles triangles and wires from indices, for each primitive mode.

use crate::error::Error;
use crate::scene::Warnings;

/// Primitive mode: how indices form triangles or lines.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum PrimitiveMode {
    Points,
    Lines,
    LineLoop,
    LineStrip,
    Triangles,
    TriangleStrip,
    TriangleFan,
}

impl PrimitiveMode {
    /// Mode of a number in the file; triangles by default.
    pub(crate) fn new(code: Option<u32>) -> Result<Self, Error> {
        Ok(match code {
            Some(0) => Self::Points,
            Some(1) => Self::Lines,
            Some(2) => Self::LineLoop,
            Some(3) => Self::LineStrip,
            None | Some(4) => Self::Triangles,
            Some(5) => Self::TriangleStrip,
            Some(6) => Self::TriangleFan,
            Some(other) => return Err(Error::new(format!("mode {other} is none of glTF's 0 to 6"))),
        })
    }

    /// Whether the mode supports primitive restart: strips, loops and fans.
    pub(crate) fn runs(self) -> bool {
        !matches!(self, Self::Points | Self::Lines | Self::Triangles)
    }
}

/// Triangles and wires of a primitive.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct PrimitiveElements {
    pub triangles: Vec<[u32; 3]>,
    pub wires: Vec<[u32; 2]>,
}

impl PrimitiveElements {
    /// Adds a run of indices; left-over indices are counted.
    pub(crate) fn add(&mut self, mode: PrimitiveMode, run: &[u32], warnings: &mut Warnings) {
        let mut left_over = |rest: &[u32]| {
            if !rest.is_empty() {
                warnings.count("indices left over at the end of a primitive", rest.len() as u64);
            }
        };
        match mode {
            PrimitiveMode::Points => {}
            PrimitiveMode::Lines => {
                let (pairs, rest) = run.as_chunks::<2>();
                left_over(rest);
                self.wires.extend_from_slice(pairs);
            }
            PrimitiveMode::LineLoop | PrimitiveMode::LineStrip => {
                self.wires.extend(run.array_windows().map(|[a, b]| [*a, *b]));
                if let (PrimitiveMode::LineLoop, [first, .., last]) = (mode, run) {
                    self.wires.push([*last, *first]);
                }
            }
            PrimitiveMode::Triangles => {
                let (triples, rest) = run.as_chunks::<3>();
                left_over(rest);
                if self.triangles.is_empty() {
                    self.triangles = triples.to_vec();
                } else {
                    self.triangles.extend_from_slice(triples);
                }
            }
            PrimitiveMode::TriangleStrip => {
                // Every other triangle of a strip has reversed winding.
                let turned =
                    |(i, [a, b, c]): (usize, &[u32; 3])| if i % 2 == 0 { [*a, *b, *c] } else { [*a, *c, *b] };
                self.triangles.extend(run.array_windows().enumerate().map(turned));
            }
            PrimitiveMode::TriangleFan => {
                if let [hub, rim @ ..] = run {
                    self.triangles.extend(rim.array_windows().map(|[a, b]| [*a, *b, *hub]));
                }
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn elements_and_warnings(mode: u32, run: &[u32]) -> (PrimitiveElements, Warnings) {
        let (mut shape, mut warnings) = (PrimitiveElements::default(), Warnings::default());
        shape.add(PrimitiveMode::new(Some(mode)).unwrap(), run, &mut warnings);
        (shape, warnings)
    }

    #[test]
    fn primitive_modes_give_the_specified_triangles_and_wires() {
        assert_eq!(elements_and_warnings(0, &[0, 1]).0, PrimitiveElements::default());
        assert_eq!(elements_and_warnings(1, &[0, 1, 2, 3]).0.wires, [[0, 1], [2, 3]]);
        assert_eq!(elements_and_warnings(2, &[0, 1, 2]).0.wires, [[0, 1], [1, 2], [2, 0]]);
        assert_eq!(elements_and_warnings(3, &[0, 1, 2]).0.wires, [[0, 1], [1, 2]]);
        assert_eq!(elements_and_warnings(4, &[0, 1, 2]).0.triangles, [[0, 1, 2]]);
        assert_eq!(elements_and_warnings(5, &[0, 1, 2, 3]).0.triangles, [[0, 1, 2], [1, 3, 2]]);
        assert_eq!(elements_and_warnings(6, &[0, 1, 2, 3]).0.triangles, [[1, 2, 0], [2, 3, 0]]);
        assert!(PrimitiveMode::new(Some(7)).is_err());
    }

    #[test]
    fn leftover_primitive_indices_are_counted_in_a_warning() {
        assert_eq!(
            elements_and_warnings(4, &[0, 1, 2, 3, 4]).1.lines(),
            ["2 indices left over at the end of a primitive"]
        );
        assert_eq!(
            elements_and_warnings(1, &[0]).1.lines(),
            ["1 indices left over at the end of a primitive"]
        );
        for mode in [2, 3, 5, 6] {
            assert_eq!(elements_and_warnings(mode, &[0]).0, PrimitiveElements::default());
            assert_eq!(elements_and_warnings(mode, &[]).0, PrimitiveElements::default());
        }
    }
}
