//! Non-maximum suppression: whether a jump is the crest of an edge, or only part of its slope or its echo.

/// Smallest jump that is not noise, in edge thresholds.
const MIN_JUMP: f32 = 0.3;

/// Radius of the echo of a jump, px: a surface bends fastest just before it turns away.
const ECHO_RADIUS_PX: usize = 10;

/// Largest jump, relative to a jump nearby, that counts as its echo.
const MAX_ECHO_RATIO: f32 = 0.35;

/// Smallest jump that is no echo, in edge thresholds; it corresponds to a bend of 16 degrees.
pub(crate) const MIN_INDEPENDENT_JUMP: f32 = 8.0;

/// Whether jump `at` of a row or column of `count` jumps is a local maximum and no echo.
pub(crate) fn is_crest(jump: impl Fn(usize) -> f32, at: usize, count: usize) -> bool {
    let own = jump(at);
    if own <= MIN_JUMP {
        return false;
    }
    let before = |far: usize| if at >= far { jump(at - far) } else { 0.0 };
    let behind = |far: usize| if at + far < count { jump(at + far) } else { 0.0 };
    if own <= before(1) || own < behind(1) {
        return false;
    }
    own > MIN_INDEPENDENT_JUMP
        || (2..=ECHO_RADIUS_PX).all(|far| own >= MAX_ECHO_RATIO * before(far).max(behind(far)))
}
