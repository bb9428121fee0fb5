//! [`DepthCell`]: the nearest face of a pixel and its nearness in one integer; the larger value wins.

/// Nearest face at a pixel: the bits of the nearness, which sort positive numbers, above those of the
/// inverted face id. Zero where there is no face.
pub(crate) type DepthCell = u64;

/// Packs a face and its nearness. Nearer faces are larger; of equally near ones, the one with the smaller id.
#[inline]
pub(crate) fn depth_cell(face: u32, nearness: f32) -> DepthCell {
    u64::from(nearness.to_bits()) << 32 | u64::from(!face)
}

/// Nearest face.
#[inline]
pub(crate) fn front(cell: DepthCell) -> Option<u32> {
    (cell != 0).then_some(!(cell as u32))
}

/// Nearness of the nearest face, on the screen's scale from 0 to 1.
#[inline]
pub(crate) fn nearness(cell: DepthCell) -> Option<f32> {
    (cell != 0).then_some(f32::from_bits((cell >> 32) as u32))
}
