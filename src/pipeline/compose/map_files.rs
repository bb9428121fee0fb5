//! [`MapFiles`]: the pixel maps of the search for image-space lines, encoded as PNG files for
//! inspection and for other programs.

use crate::parallel::prelude::*;

use crate::error::Error;
use crate::lines::ImageOptions;
use crate::lines::image;
use crate::mesh::Mesh;
use crate::view::raster::{NO_FRONT, NormalDepthMaps};

/// Maps of a view as PNG files of equal size, with `lines.image.samples` pixels per px of the drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub(crate) struct MapFiles {
    /// Unit normals of the visible side, -1 to 1 mapped to 0 to 255: red to the right, green up, blue towards
    /// the camera. Black for background.
    pub normal: Vec<u8>,
    /// Depth along the optical axis, 16 bits, linear. Darker is nearer; white is background.
    pub depth: Vec<u8>,
    /// Black where the style's edge test finds edges, widened by the style's number of passes.
    pub edges: Vec<u8>,
    /// One colour per part of the model; white for background.
    pub parts: Vec<u8>,
}

impl MapFiles {
    /// File names, in the order of the fields.
    pub(crate) const NAMES: [&'static str; 4] = ["normal.png", "depth.png", "edges.png", "parts.png"];

    /// The files with their names.
    #[must_use]
    pub(crate) fn named(&self) -> [(&'static str, &[u8]); 4] {
        let [normal, depth, edges, parts] = Self::NAMES;
        [(normal, &self.normal), (depth, &self.depth), (edges, &self.edges), (parts, &self.parts)]
    }

    /// Encodes the maps of a view. `options` sets the edge test and the widening of `edges`.
    pub(crate) fn new(mesh: &Mesh, maps: &NormalDepthMaps, options: &ImageOptions) -> Result<Self, Error> {
        let shown = |pixel: usize| maps.faces[pixel] != NO_FRONT;
        let normal = |pixel: usize| {
            let value = |x: f32| ((x * 0.5 + 0.5) * 255.0).round() as u8;
            if shown(pixel) { maps.normals[pixel].map(value) } else { [0; 3] }
        };
        let depth = |pixel: usize| ((maps.depths[pixel] * 65_535.0).round() as u16).to_be_bytes();
        let part = |pixel: usize| {
            let part = mesh.face_part.get(maps.faces[pixel] as usize);
            part.map_or([255; 3], |part| colour(part.0))
        };
        let ink = image::ink_dilation::dilate_ink(&image::edges(maps, options), maps.columns, options);
        let grey = |pixel: usize| [255 - (ink[pixel] * 255.0).round() as u8];
        Ok(Self {
            normal: encode(maps, png::ColorType::Rgb, png::BitDepth::Eight, normal)?,
            depth: encode(maps, png::ColorType::Grayscale, png::BitDepth::Sixteen, depth)?,
            edges: encode(maps, png::ColorType::Grayscale, png::BitDepth::Eight, grey)?,
            parts: encode(maps, png::ColorType::Rgb, png::BitDepth::Eight, part)?,
        })
    }
}

/// Colour of a part: a multiplicative hash of its number, with channels from 40 to 229. So no part is near
/// black or white.
fn colour(part: u32) -> [u8; 3] {
    let mixed = part.wrapping_add(1).wrapping_mul(0x9E37_79B1);
    [24, 16, 8].map(|shift| 40 + ((mixed >> shift) & 0xFF) as u8 / 4 * 3)
}

/// Encodes a PNG file with the size of the maps. `pixel` returns the `N` bytes of a pixel.
fn encode<const N: usize>(
    maps: &NormalDepthMaps,
    colours: png::ColorType,
    bits: png::BitDepth,
    pixel: impl Fn(usize) -> [u8; N] + Sync + Send,
) -> Result<Vec<u8>, Error> {
    let pixels: Vec<[u8; N]> = (0..maps.faces.len()).into_par_iter().map(pixel).collect();
    let mut file = Vec::new();
    let mut encoder = png::Encoder::new(&mut file, maps.columns as u32, maps.rows as u32);
    encoder.set_color(colours);
    encoder.set_depth(bits);
    encoder.set_compression(png::Compression::Fast);
    let written = encoder.write_header().and_then(|mut writer| {
        writer.write_image_data(pixels.as_flattened())?;
        writer.finish()
    });
    written.map_err(|error| Error::new(format!("cannot write PNG: {error}")))?;
    Ok(file)
}
