//! Non-maximum suppression: whether a jump is the crest of an edge, or only part of its slope or its echo.

/// Smallest jump that is not noise, in edge thresholds.
const LEAST: f32 = 0.3;

/// Radius of the echo of a jump, px: a surface bends fastest just before it turns away.
const ECHO: usize = 10;

/// Largest jump, relative to a jump nearby, that counts as its echo.
const ECHO_SHARE: f32 = 0.35;

/// Smallest jump that is no echo, in edge thresholds; it corresponds to a bend of 16 degrees.
pub(crate) const NO_ECHO: f32 = 8.0;

/// Whether jump `at` of a row or column of `count` jumps is a local maximum and no echo.
pub(crate) fn is_crest(jump: impl Fn(usize) -> f32, at: usize, count: usize) -> bool {
    let own = jump(at);
    if own <= LEAST {
        return false;
    }
    let before = |far: usize| if at >= far { jump(at - far) } else { 0.0 };
    let behind = |far: usize| if at + far < count { jump(at + far) } else { 0.0 };
    if own <= before(1) || own < behind(1) {
        return false;
    }
    own > NO_ECHO || (2..=ECHO).all(|far| own >= ECHO_SHARE * before(far).max(behind(far)))
}
