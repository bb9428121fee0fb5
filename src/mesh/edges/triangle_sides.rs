//! Sides and corners of single triangles, by vertex ids.

/// The sides 0-1, 1-2 and 2-0.
#[inline]
pub(crate) fn sides([a, b, c]: [u32; 3]) -> [[u32; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// The sides 0-1, 1-2 and 2-0, each with its smaller vertex first.
#[inline]
pub(crate) fn sorted_sides(triangle: [u32; 3]) -> [[u32; 2]; 3] {
    sides(triangle).map(|[v, w]| [v.min(w), v.max(w)])
}

/// Whether a triangle runs along one of its sides in the given direction.
#[inline]
pub(crate) fn runs_along(triangle: [u32; 3], side: [u32; 2]) -> bool {
    sides(triangle).contains(&side)
}

/// The corner that is not on a side.
#[inline]
pub(crate) fn apex(triangle: [u32; 3], ends: [u32; 2]) -> Option<u32> {
    triangle.into_iter().find(|corner| !ends.contains(corner))
}
