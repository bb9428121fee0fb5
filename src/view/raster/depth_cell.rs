//! [`Cell`]: the face in front at a pixel and how near it is, in one number of which the larger one wins.

/// What is in front at a pixel: the bits of the nearness, which order positive numbers, above those of the face,
/// inverted; zero where there is no face.
pub(crate) type Cell = u64;

/// The nearer face is larger, of equally near ones that of the lesser id.
#[inline]
pub(crate) fn cell(face: u32, nearness: f32) -> Cell {
    u64::from(nearness.to_bits()) << 32 | u64::from(!face)
}

/// The face in front.
#[inline]
pub(crate) fn front(cell: Cell) -> Option<u32> {
    (cell != 0).then_some(!(cell as u32))
}

/// How near the face in front is, on the screen's scale from 0 to 1.
#[inline]
pub(crate) fn nearness(cell: Cell) -> Option<f32> {
    (cell != 0).then_some(f32::from_bits((cell >> 32) as u32))
}
