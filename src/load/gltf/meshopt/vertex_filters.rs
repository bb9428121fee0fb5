//! Filters after the vertex codec: unit vectors, quaternions, floats and colours.

/// Rounds half away from zero.
fn rounded(value: f32) -> i32 {
    (value + if value >= 0.0 { 0.5 } else { -0.5 }) as i32
}

/// Unit vector from two octahedral coordinates; the third component is the value that represents 1.
fn octahedral([x, y, one]: [f32; 3], full: f32) -> [i32; 3] {
    let z = one - x.abs() - y.abs();
    let fold = z.min(0.0);
    let unfolded = |v: f32| v + if v >= 0.0 { fold } else { -fold };
    let (x, y) = (unfolded(x), unfolded(y));
    let scale = full / (x * x + y * y + z * z).sqrt();
    [x, y, z].map(|v| rounded(v * scale))
}

/// Octahedral unit vectors of signed bytes.
pub(crate) fn octahedral_8(bytes: &mut [u8]) {
    for [x, y, z, _] in bytes.as_chunks_mut::<4>().0 {
        let lanes = [*x, *y, *z].map(|v| f32::from(v.cast_signed()));
        [*x, *y, *z] = octahedral(lanes, 127.0).map(|v| v as u8);
    }
}

/// Octahedral unit vectors of signed 16-bit numbers.
pub(crate) fn octahedral_16(bytes: &mut [u8]) {
    for element in bytes.as_chunks_mut::<8>().0 {
        let [x, y, z, w] = words(*element);
        let lanes = [x, y, z].map(|v| f32::from(v.cast_signed()));
        let [x, y, z] = octahedral(lanes, 32767.0).map(|v| v as u16);
        *element = bytes_of([x, y, z, w]);
    }
}

/// Unit quaternions without their largest component; the low two bits give its index.
pub(crate) fn quaternion(bytes: &mut [u8]) {
    for element in bytes.as_chunks_mut::<8>().0 {
        let stored = words(*element);
        let [x, y, z, _] = stored.map(|v| f32::from(v.cast_signed()));
        let largest = usize::from(stored[3] & 3);
        let one = f32::from((stored[3] | 3).cast_signed());
        let rest = 2.0 * one * one - x * x - y * y - z * z;
        let unit = 32767.0 / std::f32::consts::SQRT_2 / one;
        let mut turned = [0; 4];
        for (lane, value) in [rest.max(0.0).sqrt(), x, y, z].into_iter().enumerate() {
            turned[(largest + lane) % 4] = rounded(value * unit) as u16;
        }
        *element = bytes_of(turned);
    }
}

/// Floats of a 24-bit mantissa and an 8-bit exponent.
pub(crate) fn exponential(bytes: &mut [u8]) {
    for element in bytes.as_chunks_mut::<4>().0 {
        let stored = u32::from_le_bytes(*element).cast_signed();
        let (mantissa, exponent) = (stored << 8 >> 8, stored >> 24);
        let power = f32::from_bits((exponent + 127).cast_unsigned() << 23);
        *element = (power * mantissa as f32).to_le_bytes();
    }
}

/// Colour from luma, two differences and opacity; the highest bit of the opacity gives the scale.
fn colour(luma: i32, orange: i32, green: i32, opacity: i32, full: f32) -> [i32; 4] {
    let mut one = opacity;
    for shift in [1, 2, 4, 8] {
        one |= one >> shift;
    }
    let opacity = (opacity << 1 & one) | (opacity & 1);
    let scale = full / one as f32;
    [luma + orange - green, luma + green, luma - orange - green, opacity]
        .map(|v| (v as f32 * scale + 0.5) as i32)
}

/// Colours of 8-bit channels.
pub(crate) fn colour_8(bytes: &mut [u8]) {
    for element in bytes.as_chunks_mut::<4>().0 {
        let [y, co, cg, a] = *element;
        let [co, cg] = [co, cg].map(|v| i32::from(v.cast_signed()));
        *element = colour(i32::from(y), co, cg, i32::from(a), 255.0).map(|v| v as u8);
    }
}

/// Colours of 16-bit channels.
pub(crate) fn colour_16(bytes: &mut [u8]) {
    for element in bytes.as_chunks_mut::<8>().0 {
        let [y, co, cg, a] = words(*element);
        let [co, cg] = [co, cg].map(|v| i32::from(v.cast_signed()));
        let rgba = colour(i32::from(y), co, cg, i32::from(a), 65535.0);
        *element = bytes_of(rgba.map(|v| v as u16));
    }
}

fn words(bytes: [u8; 8]) -> [u16; 4] {
    let [a, b, c, d, e, f, g, h] = bytes;
    [[a, b], [c, d], [e, f], [g, h]].map(u16::from_le_bytes)
}

fn bytes_of(words: [u16; 4]) -> [u8; 8] {
    let [[a, b], [c, d], [e, f], [g, h]] = words.map(u16::to_le_bytes);
    [a, b, c, d, e, f, g, h]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn octahedral_filter_decodes_both_hemispheres() {
        let mut bytes = [0, 0, 127, 9, 127, 0, 127, 9, 100, 100, 127, 9];
        octahedral_8(&mut bytes);
        assert_eq!(bytes, [0, 0, 127, 9, 127, 0, 0, 9, 42, 42, (-113_i8) as u8, 9]);
        let mut bytes = bytes_of([0, (-32767_i16) as u16, 32767, 5]);
        octahedral_16(&mut bytes);
        assert_eq!(words(bytes), [0, (-32767_i16) as u16, 0, 5]);
    }

    #[test]
    fn quaternion_filter_restores_the_largest_component() {
        // 1023 represents 1; x = 0.6, and the largest component, number 2, is 0.8.
        let x = (0.6 * std::f32::consts::SQRT_2 * 1023.0).round() as u16;
        let mut bytes = bytes_of([x, 0, 0, 1020 | 2]);
        quaternion(&mut bytes);
        let [a, b, c, d] = words(bytes).map(|v| f32::from(v.cast_signed()) / 32767.0);
        assert!(a == 0.0 && b == 0.0);
        assert!((c - 0.8).abs() < 1e-3 && (d - 0.6).abs() < 1e-3, "{c} {d}");
    }

    #[test]
    fn exponential_and_colour_filters_decode_values() {
        let mut bytes = (0xff00_0003_u32).to_le_bytes();
        exponential(&mut bytes);
        assert_eq!(f32::from_le_bytes(bytes), 1.5);
        let mut bytes = [80, 20, 246, 127];
        colour_8(&mut bytes);
        // Luma 80, orange 20, green -10, out of 127.
        assert_eq!(bytes, [221, 141, 141, 255]);
    }
}
