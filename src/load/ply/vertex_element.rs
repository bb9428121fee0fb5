//! Reads the vertices of a PLY file: positions, normals, colours, texture coordinates.

use crate::parallel::prelude::*;
use glam::DVec3;

use super::element_rows::{ElementReader, RowValues};
use super::header::{Element, Encoding, ScalarType};
use crate::colour::oklab::linear_table;
use crate::colour::srgb::linear;
use crate::error::Error;
use crate::scene::Geometry;

/// Minimum rows per parallel task.
pub(crate) const MIN_TASK_ROWS: usize = 1 << 13;

/// Property indices of the vertex attributes.
struct Columns {
    position: [usize; 3],
    normal: Option<[usize; 3]>,
    colour: Option<[usize; 3]>,
    alpha: Option<usize>,
    uv: Option<[usize; 2]>,
}

/// Names of the channels of a colour.
pub(crate) const COLOUR_NAMES: [[&str; 3]; 3] =
    [["red", "green", "blue"], ["diffuse_red", "diffuse_green", "diffuse_blue"], ["r", "g", "b"]];

/// Indices of a set of properties, if all are present.
pub(crate) fn find<const N: usize>(element: &Element, names: [&str; N]) -> Option<[usize; N]> {
    let mut found = [0; N];
    for (slot, name) in found.iter_mut().zip(names) {
        *slot = element.find(&[name])?;
    }
    Some(found)
}

impl Columns {
    fn new(element: &Element) -> Option<Self> {
        let colour = COLOUR_NAMES.iter().find_map(|names| find(element, *names));
        let uv = [["s", "t"], ["u", "v"], ["texture_u", "texture_v"], ["texture_s", "texture_t"]];
        Some(Self {
            position: find(element, ["x", "y", "z"])?,
            normal: find(element, ["nx", "ny", "nz"]),
            colour,
            alpha: element.find(&["alpha", "diffuse_alpha", "a"]),
            uv: uv.into_iter().find_map(|names| find(element, names)),
        })
    }
}

/// Reads the rows of the element `vertex`.
pub(crate) fn read(body: &mut ElementReader, element: &Element) -> Result<Geometry, Error> {
    let count = body.check_count(element)?;
    let Some(columns) = Columns::new(element) else {
        return Err(Error::new("the vertices have no x, y and z").at("element vertex"));
    };
    let kind = |property: usize| element.properties.get(property).map_or(ScalarType::F64, |p| p.kind);
    let single_precision = columns.position.iter().all(|&p| kind(p) == ScalarType::F32);
    let mut geometry = Geometry { single_precision, ..Geometry::default() };
    geometry.positions.reserve_exact(count);
    let fixed = element.properties.iter().all(|p| p.list.is_none()) && body.encoding != Encoding::Text;
    let only_positions = columns.normal.is_none() && columns.colour.is_none() && columns.uv.is_none();
    if let ([x, y, z], true) = (columns.position, fixed && only_positions) {
        let stride = element.least_size(body.encoding);
        let rows = body.rest().get(..count * stride).unwrap_or_default();
        let packed = element.offset(x).filter(|&o| {
            let follow = element.offset(y) == Some(o + 4) && element.offset(z) == Some(o + 8);
            follow && single_precision && body.encoding == Encoding::Little
        });
        let each = rows.par_chunks(stride).with_min_len(MIN_TASK_ROWS);
        if let Some(start) = packed {
            geometry.positions.par_extend(each.map(|row| packed_position(row, start)));
        } else {
            let places = [x, y, z].map(|p| (kind(p), element.offset(p).unwrap_or(0)));
            geometry.positions.par_extend(each.map(|row| {
                let value = |(kind, at): (ScalarType, usize)| {
                    kind.read(row.get(at..).unwrap_or_default(), body.encoding)
                };
                DVec3::from_array(places.map(value))
            }));
        }
        body.cursor.at += rows.len();
        return Ok(geometry);
    }
    // Byte channels are the usual case; converting each channel would be slow.
    let bytes = linear_table();
    let channel = |row: &RowValues, property: usize| match kind(property) {
        ScalarType::U8 => bytes.get(row.value(property) as usize).copied().unwrap_or(1.0),
        kind => linear((row.value(property) / kind.full()) as f32),
    };
    let mut row = RowValues::default();
    for number in 0..count {
        body.row(element, number, &mut row)?;
        geometry.positions.push(DVec3::from_array(columns.position.map(|p| row.value(p))));
        if let Some(normal) = columns.normal {
            geometry.normals.push(normal.map(|p| row.value(p) as f32));
        }
        if let Some([r, g, b]) = columns.colour.map(|c| c.map(|p| channel(&row, p))) {
            let alpha = columns.alpha.map_or(1.0, |p| row.value(p) / kind(p).full());
            geometry.colours.push([r, g, b, alpha as f32]);
        }
        if let Some(uv) = columns.uv {
            geometry.uvs.push(uv.map(|p| row.value(p) as f32));
        }
    }
    Ok(geometry)
}

/// Reads three little-endian floats at an offset of a row.
#[inline]
fn packed_position(row: &[u8], start: usize) -> DVec3 {
    let bytes = row.get(start..).and_then(|b| b.first_chunk::<12>()).copied().unwrap_or_default();
    let [a, b, c, d, e, f, g, h, i, j, k, l] = bytes;
    let axes = [[a, b, c, d], [e, f, g, h], [i, j, k, l]];
    DVec3::from_array(axes.map(|axis| f64::from(f32::from_le_bytes(axis))))
}
