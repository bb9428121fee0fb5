//! [`Texture`]: the colour of a base-colour texture where a triangle shows it.

use std::path::Path;

use super::beside::read_beside;
use super::swatches::{ALIKE, difference};
use super::{Material, Scene};
use crate::math::colour::Colour;
use crate::math::picture::Picture;

/// A texture that repeats in both directions.
pub(super) struct Texture {
    picture: Picture,
    /// Whether v grows from the bottom row up, as in OBJ and PLY, or from the top row down.
    upward: bool,
}

impl Texture {
    /// The texture of a material; none if it has none or if it is not PNG or JPEG, an error if it
    /// cannot be read.
    pub fn of(scene: &Scene, material: &Material) -> Option<Result<Self, String>> {
        let picture = picture_of(scene, material)?;
        Some(picture.map(|picture| Self { picture, upward: scene.format != "glTF" }))
    }

    /// The colour that stands for a triangle: of its centroid and three points between that and
    /// its corners, the one that differs least from the others; and whether all are alike.
    pub fn of_triangle(&self, corners: [[f32; 2]; 3]) -> (Colour, bool) {
        let mut corners = corners.map(|uv| uv.map(f64::from));
        // Whichever corner the triangle begins with, the points are the same to the last bit.
        corners.sort_unstable_by(|a, b| a[0].total_cmp(&b[0]).then_with(|| a[1].total_cmp(&b[1])));
        let [a, b, c] = corners;
        let at = |wa: f64, wb: f64, wc: f64| {
            self.at([wa * a[0] + wb * b[0] + wc * c[0], wa * a[1] + wb * b[1] + wc * c[1]])
        };
        let third = 1.0 / 3.0;
        let samples = [at(third, third, third), at(0.8, 0.1, 0.1), at(0.1, 0.8, 0.1), at(0.1, 0.1, 0.8)];
        let strange = |sample: &Colour| samples.iter().map(|other| difference(*sample, *other)).sum::<u32>();
        let colour = samples.into_iter().min_by_key(strange).unwrap_or(samples[0]);
        (colour, samples.iter().all(|sample| difference(*sample, colour) < ALIKE))
    }

    /// The nearest pixel.
    fn at(&self, [u, v]: [f64; 2]) -> Colour {
        let v = if self.upward { 1.0 - v } else { v };
        let index = |t: f64, count: usize| {
            let part = t - t.floor();
            if part.is_finite() { (part * count as f64) as usize } else { 0 }
        };
        self.picture.at(index(u, self.picture.width), index(v, self.picture.height))
    }
}

/// The picture of a material's base colour; none if it has none, an error if it cannot be read.
pub(super) fn picture_of(scene: &Scene, material: &Material) -> Option<Result<Picture, String>> {
    match (&material.picture, &material.texture) {
        (Some(bytes), _) => Some(Picture::decode(bytes)),
        (None, Some(path)) => beside(scene, path),
        (None, None) => None,
    }
}

/// The picture in a file beside the model; none if the model is no file.
pub(super) fn beside(scene: &Scene, path: &str) -> Option<Result<Picture, String>> {
    scene.file.as_ref().map(|file| from_file(file, path))
}

fn from_file(model: &Path, path: &str) -> Result<Picture, String> {
    let bytes = read_beside(model, path).map_err(|error| error.message)?;
    Picture::decode(&bytes).map_err(|message| format!("{path} {message}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pixels_are_found_and_repeat() {
        let (a, b, c, d) =
            (Colour::rgb(1, 0, 0), Colour::rgb(2, 0, 0), Colour::rgb(3, 0, 0), Colour::rgb(4, 0, 0));
        let picture = Picture { width: 2, height: 2, pixels: vec![a, b, c, d] };
        let mut texture = Texture { picture, upward: false };
        assert_eq!(
            [[0.1, 0.1], [0.9, 0.1], [1.1, -0.1], [f64::NAN, 0.1]].map(|uv| texture.at(uv)),
            [a, b, c, a]
        );
        texture.upward = true;
        assert_eq!([[0.1, 0.1], [0.9, 0.9]].map(|uv| texture.at(uv)), [c, b]);
        assert_eq!(texture.of_triangle([[0.6, 0.6], [0.9, 0.6], [0.6, 0.9]]), (b, true));
        // One corner beyond the border does not count.
        assert_eq!(texture.of_triangle([[0.2, 0.6], [0.9, 0.6], [0.9, 0.9]]).0, b);
    }
}
