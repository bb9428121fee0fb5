//! [`sagitta_height`]: the largest distance of a curve from one of its chords.

/// Minimum cosine (45 degrees) between one side of a seam and the reverse of the other. A border that turns
/// by more at a vertex has a corner there.
pub(crate) const MIN_SEAM_COSINE: f64 = 0.7;

/// Factor on the sagitta of equal chords, because chords of a curve differ in length.
const SAGITTA_FACTOR: f64 = 2.0;

/// The distance of a space curve from the plane of its chord and sagitta is at most the sagitta divided by
/// this.
pub(crate) const SAGITTA_PER_TWIST: f64 = 4.0;

/// Sagitta of the curve of a chord that turns by an angle with this cosine to an adjacent chord. `lengths`
/// are those of both chords. `after` is the turn from the adjacent chord to the next, and the length of that.
///
/// The next chord's share of the turn is subtracted.
pub(crate) fn sagitta_height(cosine: f64, lengths: [f64; 2], after: Option<(f64, f64)>) -> f64 {
    // Tangent of half the turn. Equal chords share a turn in halves.
    let half_turn = |cosine: f64| ((1.0 - cosine) / (1.0 + cosine)).max(0.0).sqrt();
    let turn = half_turn(cosine);
    let share = after.map_or(0.0, |(cosine, length)| {
        let of_beside = lengths[1] / (lengths[1] + length);
        if cosine < MIN_SEAM_COSINE { 0.0 } else { half_turn(cosine) * of_beside }
    });
    let own_turn = (turn - share.max(turn / 2.0)).max(0.0);
    SAGITTA_FACTOR * lengths[0] * own_turn / 2.0
}
