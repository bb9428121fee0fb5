//! [`Picture`]: decoded pixels of a PNG, JPEG or WebP file.

use std::io::Cursor;

use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

use super::srgb::Colour;

/// Maximum width and height of a picture, px. Larger files are refused.
pub(crate) const MAX_SIDE_PX: u32 = 16_384;

/// Maximum memory for decoding a picture, bytes.
const MAX_DECODE_BYTES: usize = 1 << 30;

/// Pixels of a picture, row by row from the top, in sRGB.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Picture {
    /// Width in pixels, at least 1.
    pub width: usize,
    /// Height in pixels, at least 1.
    pub height: usize,
    /// Colours, `width * height` of them.
    pub pixels: Vec<Colour>,
}

impl Picture {
    /// Decodes the bytes of a PNG, JPEG or WebP file. Of an animation, only the first frame is read.
    ///
    /// # Errors
    /// Describes briefly why the bytes cannot be decoded.
    pub fn decode(bytes: &[u8]) -> Result<Self, String> {
        let decoded = if bytes.starts_with(&PNG_MAGIC) {
            decode_png(bytes)
        } else if bytes.starts_with(&JPEG_MAGIC) {
            decode_jpeg(bytes)
        } else if is_webp(bytes) {
            decode_webp(bytes)
        } else {
            return Err("is neither PNG, JPEG nor WebP".to_owned());
        };
        let picture = decoded.map_err(|error| format!("cannot be read as a picture ({error})"))?;
        if picture.width == 0 || picture.height == 0 {
            return Err("has no pixels".to_owned());
        }
        Ok(picture)
    }

    /// Converts 8-bit samples with `channels` per pixel: grey, grey and alpha, RGB, or RGBA.
    fn of_samples(width: usize, height: usize, samples: &[u8], channels: usize) -> Result<Self, String> {
        let pixels: Vec<Colour> = samples
            .chunks_exact(channels.max(1))
            .map(|pixel| match *pixel {
                [grey] => Colour { r: grey, g: grey, b: grey, a: 255 },
                [grey, a] => Colour { r: grey, g: grey, b: grey, a },
                [r, g, b, ref rest @ ..] => Colour { r, g, b, a: rest.first().copied().unwrap_or(255) },
                [] => Colour::BLACK,
            })
            .take(width * height)
            .collect();
        if pixels.len() < width * height {
            return Err("pixels are missing".to_owned());
        }
        Ok(Self { width, height, pixels })
    }

    /// Pixel at a column and a row, both clamped to the picture.
    #[must_use]
    pub fn at(&self, column: usize, row: usize) -> Colour {
        let (column, row) = (column.min(self.width - 1), row.min(self.height - 1));
        self.pixels.get(row * self.width + column).copied().unwrap_or(Colour::BLACK)
    }

    /// Downsamples the picture to at most `most` pixels, by the mean of square blocks.
    #[must_use]
    pub fn at_most(self, most: usize) -> Self {
        let smaller = |times: usize| [self.width, self.height].map(|count| (count / times).max(1));
        let fits = |times: &usize| smaller(*times).iter().product::<usize>() <= most.max(1);
        let times = (1..).find(fits).unwrap_or(1);
        if times == 1 {
            return self;
        }
        let [width, height] = smaller(times);
        let mean = |k: usize| {
            let (column, row) = (k % width * times, k / width * times);
            let mut sum = [0; 4];
            for (i, j) in (0..times * times).map(|n| (n % times, n / times)) {
                let Colour { r, g, b, a } = self.at(column + i, row + j);
                sum.iter_mut().zip([r, g, b, a]).for_each(|(sum, c)| *sum += usize::from(c));
            }
            let [r, g, b, a] = sum.map(|sum| ((sum + times * times / 2) / (times * times)) as u8);
            Colour { r, g, b, a }
        };
        Self { width, height, pixels: (0..width * height).map(mean).collect() }
    }

    /// Colours of a row.
    #[must_use]
    pub fn row(&self, row: usize) -> &[Colour] {
        let start = row.min(self.height - 1) * self.width;
        self.pixels.get(start..start + self.width).unwrap_or_default()
    }
}

/// First bytes of the file formats.
const PNG_MAGIC: [u8; 4] = *b"\x89PNG";
const JPEG_MAGIC: [u8; 3] = [0xff, 0xd8, 0xff];

fn is_webp(bytes: &[u8]) -> bool {
    bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP")
}

fn is_too_large(width: usize, height: usize) -> bool {
    let side = MAX_SIDE_PX as usize;
    width > side || height > side || width * height * 4 > MAX_DECODE_BYTES
}

fn decode_png(bytes: &[u8]) -> Result<Picture, String> {
    let mut decoder =
        png::Decoder::new_with_limits(Cursor::new(bytes), png::Limits { bytes: MAX_DECODE_BYTES });
    decoder.set_transformations(png::Transformations::normalize_to_color8());
    let mut reader = decoder.read_info().map_err(|error| error.to_string())?;
    let (width, height) = (reader.info().width as usize, reader.info().height as usize);
    let size = reader.output_buffer_size().filter(|_| !is_too_large(width, height));
    let mut samples = vec![0; size.ok_or("it is too large")?];
    let frame = reader.next_frame(&mut samples).map_err(|error| error.to_string())?;
    Picture::of_samples(width, height, &samples[..frame.buffer_size()], frame.color_type.samples())
}

fn decode_jpeg(bytes: &[u8]) -> Result<Picture, String> {
    let side = MAX_SIDE_PX as usize;
    let options = DecoderOptions::default().set_strict_mode(false).set_max_width(side).set_max_height(side);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(|error| error.to_string())?;
    let (width, height) = decoder.dimensions().ok_or("it has no size")?;
    if is_too_large(width, height) {
        return Err("it is too large".to_owned());
    }
    let (space, channels) = match decoder.input_colorspace() {
        Some(ColorSpace::Luma) => (ColorSpace::Luma, 1),
        _ => (ColorSpace::RGB, 3),
    };
    decoder.set_options(decoder.options().jpeg_set_out_colorspace(space));
    let samples = decoder.decode().map_err(|error| error.to_string())?;
    Picture::of_samples(width, height, &samples, channels)
}

fn decode_webp(bytes: &[u8]) -> Result<Picture, String> {
    let mut decoder = image_webp::WebPDecoder::new(Cursor::new(bytes)).map_err(|error| error.to_string())?;
    decoder.set_memory_limit(MAX_DECODE_BYTES);
    let (width, height) = decoder.dimensions();
    let (width, height) = (width as usize, height as usize);
    let size = decoder.output_buffer_size().filter(|_| !is_too_large(width, height));
    let mut samples = vec![0; size.ok_or("it is too large")?];
    decoder.read_image(&mut samples).map_err(|error| error.to_string())?;
    Picture::of_samples(width, height, &samples, if decoder.has_alpha() { 4 } else { 3 })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn encode_png(width: u32, height: u32, pixels: &[u8]) -> Vec<u8> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, width, height);
        encoder.set_color(png::ColorType::Rgb);
        encoder.write_header().unwrap().write_image_data(pixels).unwrap();
        bytes
    }

    #[test]
    fn picture_decodes_png_pixels() {
        let picture = Picture::decode(&encode_png(2, 1, &[1, 2, 3, 250, 0, 9])).unwrap();
        assert_eq!((picture.width, picture.height), (2, 1));
        assert_eq!(picture.row(0), [Colour::rgb(1, 2, 3), Colour::rgb(250, 0, 9)]);
        assert_eq!(picture.at(7, 7), Colour::rgb(250, 0, 9));
    }

    #[test]
    fn at_most_downsamples_large_pictures() {
        let grey = |v: u8| Colour::rgb(v, v, v);
        let picture =
            Picture { width: 4, height: 2, pixels: [0, 100, 7, 7, 100, 200, 7, 7].map(grey).to_vec() };
        assert_eq!(picture.clone().at_most(8), picture);
        assert_eq!(picture.at_most(7), Picture { width: 2, height: 1, pixels: vec![grey(100), grey(7)] });
    }

    /// JPEG files in base 64: one with blocks of several colours, and a grey one.
    const RED_AND_BLUE_JPEG_BASE64: &str = "\
        /9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAMCAgMCAgMDAwMEAwMEBQgFBQQEBQoHBwYIDAoMDAsKCwsNDhIQDQ4RDgsLEBYQERMU\
        FRUVDA8XGBYUGBIUFRT/2wBDAQMEBAUEBQkFBQkUDQsNFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQUFBQU\
        FBQUFBQUFBT/wAARCAAIABADAREAAhEBAxEB/8QAFAABAAAAAAAAAAAAAAAAAAAAB//EABQQAQAAAAAAAAAAAAAAAAAAAAD/xAAW\
        AQEBAQAAAAAAAAAAAAAAAAAJBwj/xAAUEQEAAAAAAAAAAAAAAAAAAAAA/9oADAMBAAIRAxEAPwASSptgeEIGu//Z";
    const GREY_JPEG_BASE64: &str = "\
        /9j/4AAQSkZJRgABAQAAAQABAAD/2wBDAAYEBQYFBAYGBQYHBwYIChAKCgkJChQODwwQFxQYGBcUFhYaHSUfGhsjHBYWICwgIyYn\
        KSopGR8tMC0oMCUoKSj/wAALCAAIAAgBAREA/8QAFAABAAAAAAAAAAAAAAAAAAAAB//EABQQAQAAAAAAAAAAAAAAAAAAAAD/2gAI\
        AQEAAD8AO3//2Q==";

    fn decode_base64(base64: &str) -> Vec<u8> {
        base64::Engine::decode(&base64::engine::general_purpose::STANDARD, base64).unwrap()
    }

    #[test]
    fn picture_decodes_jpeg_pixels() {
        let is_near = |a: Colour, b: Colour| {
            [(a.r, b.r), (a.g, b.g), (a.b, b.b)].iter().all(|(a, b)| a.abs_diff(*b) <= 3) && a.a == 255
        };
        let picture = Picture::decode(&decode_base64(RED_AND_BLUE_JPEG_BASE64)).unwrap();
        assert_eq!((picture.width, picture.height), (16, 8));
        assert!(picture.row(5)[..8].iter().all(|pixel| is_near(*pixel, Colour::rgb(200, 40, 30))));
        assert!(picture.row(5)[8..].iter().all(|pixel| is_near(*pixel, Colour::rgb(20, 60, 180))));
        let grey = Picture::decode(&decode_base64(GREY_JPEG_BASE64)).unwrap();
        assert!(grey.pixels.len() == 64 && grey.pixels.iter().all(|p| is_near(*p, Colour::rgb(77, 77, 77))));
        let whole = decode_base64(RED_AND_BLUE_JPEG_BASE64);
        assert!(Picture::decode(&whole[..60]).unwrap_err().starts_with("cannot be read"));
    }

    #[test]
    fn picture_decodes_webp_pixels() {
        let mut bytes = Vec::new();
        let encoder = image_webp::WebPEncoder::new(&mut bytes);
        encoder.encode(&[9, 8, 7, 255, 250, 1, 2, 60], 2, 1, image_webp::ColorType::Rgba8).unwrap();
        let picture = Picture::decode(&bytes).unwrap();
        assert_eq!(picture.row(0), [Colour::rgb(9, 8, 7), Colour { r: 250, g: 1, b: 2, a: 60 }]);
        assert!(Picture::decode(&bytes[..bytes.len() / 2]).unwrap_err().starts_with("cannot be read"));
    }

    #[test]
    fn picture_decodes_png_of_every_depth_to_eight_bits() {
        let encoded = |colour: png::ColorType, depth: png::BitDepth, palette: &[u8], pixels: &[u8]| {
            let mut bytes = Vec::new();
            let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
            encoder.set_color(colour);
            encoder.set_depth(depth);
            if !palette.is_empty() {
                encoder.set_palette(palette.to_vec());
            }
            encoder.write_header().unwrap().write_image_data(pixels).unwrap();
            Picture::decode(&bytes).unwrap().pixels
        };
        let grey = |v: u8, a: u8| Colour { r: v, g: v, b: v, a };
        use png::{BitDepth, ColorType};
        assert_eq!(
            encoded(ColorType::Grayscale, BitDepth::One, &[], &[0x40]),
            [grey(0, 255), grey(255, 255)]
        );
        let sixteen = encoded(ColorType::Grayscale, BitDepth::Sixteen, &[], &[9, 0, 200, 0]);
        assert_eq!(sixteen, [grey(9, 255), grey(200, 255)]);
        let half = encoded(ColorType::GrayscaleAlpha, BitDepth::Eight, &[], &[9, 128, 200, 0]);
        assert_eq!(half, [grey(9, 128), grey(200, 0)]);
        let painted = encoded(ColorType::Indexed, BitDepth::Eight, &[1, 2, 3, 250, 0, 9], &[1, 0]);
        assert_eq!(painted, [Colour::rgb(250, 0, 9), Colour::rgb(1, 2, 3)]);
        let seen = encoded(ColorType::Rgba, BitDepth::Eight, &[], &[1, 2, 3, 4, 5, 6, 7, 8]);
        assert_eq!(seen, [Colour { r: 1, g: 2, b: 3, a: 4 }, Colour { r: 5, g: 6, b: 7, a: 8 }]);
    }

    #[test]
    fn picture_decode_explains_unreadable_files() {
        assert_eq!(Picture::decode(b"hello").unwrap_err(), "is neither PNG, JPEG nor WebP");
        let whole = encode_png(64, 64, &[7; 64 * 64 * 3]);
        assert!(Picture::decode(&whole[..whole.len() / 2]).unwrap_err().starts_with("cannot be read"));
    }
}
