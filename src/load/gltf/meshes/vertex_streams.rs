//! [`VertexStreams`]: the vertices of a primitive, whether stored plainly or compressed by Draco.

use glam::DVec3;

use crate::error::Error;

/// Vertices of a primitive; arrays are as long as `positions`, or empty.
#[derive(Debug, Default)]
pub(crate) struct VertexStreams {
    pub positions: Vec<DVec3>,
    pub normals: Vec<[f32; 3]>,
    pub uvs: Vec<[f32; 2]>,
    pub colours: Vec<[f32; 4]>,
    /// Triangles of a compressed primitive.
    pub triangles: Option<Vec<[u32; 3]>>,
}

impl VertexStreams {
    /// Checks the lengths of the arrays.
    ///
    /// # Errors
    /// Names an array of the wrong length.
    pub(crate) fn check(&self) -> Result<(), Error> {
        let count = self.positions.len();
        let lengths =
            [("NORMAL", self.normals.len()), ("TEXCOORD", self.uvs.len()), ("COLOR_0", self.colours.len())];
        match lengths.into_iter().find(|(_, length)| *length != 0 && *length != count) {
            Some((name, length)) => {
                Err(Error::new(format!("it has {count} positions, but {name} has {length} elements")))
            }
            None => Ok(()),
        }
    }
}
