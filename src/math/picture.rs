//! [`Picture`]: the pixels of a PNG or JPEG file.

use std::io::Cursor;

use super::colour::Colour;

/// No picture that is read has more pixels on a side.
pub const GREATEST_SIDE: u32 = 16_384;

/// Memory that decoding a picture may take, bytes.
const GREATEST_MEMORY: u64 = 1 << 30;

/// The pixels of a picture, row by row from the top, sRGB.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Pixels in a row, at least 1.
    pub width: usize,
    /// Rows, at least 1.
    pub height: usize,
    /// `width * height` colours.
    pub pixels: Vec<Colour>,
}

impl Picture {
    /// Reads a PNG or JPEG file's bytes, whichever they are.
    ///
    /// # Errors
    /// Says in a few words what is wrong with the bytes.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
        let mut reader = image::ImageReader::new(Cursor::new(bytes))
            .with_guessed_format()
            .map_err(|error| format!("is damaged ({error})"))?;
        if reader.format().is_none() {
            return Err("is neither PNG nor JPEG".to_owned());
        }
        let mut limits = image::Limits::default();
        limits.max_image_width = Some(GREATEST_SIDE);
        limits.max_image_height = Some(GREATEST_SIDE);
        limits.max_alloc = Some(GREATEST_MEMORY);
        reader.limits(limits);
        let image = reader.decode().map_err(|error| format!("cannot be read as a picture ({error})"))?;
        let image = image.into_rgba8();
        let (width, height) = (image.width() as usize, image.height() as usize);
        if width == 0 || height == 0 {
            return Err("has no pixels".to_owned());
        }
        let pixels = image.pixels().map(|pixel| {
            let [r, g, b, a] = pixel.0;
            Colour { r, g, b, a }
        });
        Ok(Self { width, height, pixels: pixels.collect() })
    }

    /// The pixel of a column and a row; those beyond the border repeat the border.
    #[must_use]
    pub fn at(&self, column: usize, row: usize) -> Colour {
        let (column, row) = (column.min(self.width - 1), row.min(self.height - 1));
        self.pixels.get(row * self.width + column).copied().unwrap_or(Colour::BLACK)
    }

    /// The colours of a row.
    #[must_use]
    pub fn row(&self, row: usize) -> &[Colour] {
        let start = row.min(self.height - 1) * self.width;
        self.pixels.get(start..start + self.width).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn png(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().unwrap().write_image_data(pixels).unwrap();
        bytes
    }

    #[test]
    fn pixels_of_a_png() {
        let picture = Picture::decode(&png(2, 1, &[1, 2, 3, 250, 0, 9])).unwrap();
        assert_eq!((picture.width, picture.height), (2, 1));
        assert_eq!(picture.row(0), [Colour::rgb(1, 2, 3), Colour::rgb(250, 0, 9)]);
        assert_eq!(picture.at(7, 7), Colour::rgb(250, 0, 9));
    }

    #[test]
    fn what_is_no_picture_is_named() {
        assert_eq!(Picture::decode(b"hello").unwrap_err(), "is neither PNG nor JPEG");
        let whole = png(64, 64, &[7; 64 * 64 * 3]);
        assert!(Picture::decode(&whole[..whole.len() / 2]).unwrap_err().starts_with("cannot be read"));
    }
}
