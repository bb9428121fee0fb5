//! Which jumps are the crest of an edge, and which its foothills.

/// A jump that alone is no more than this part of an edge is taken for noise.
const LEAST: f32 = 0.3;

/// How far from where something jumps a surface that turns away may bend faster than elsewhere, pixels.
const ECHO: usize = 10;

/// What jumps by less than this part of what jumps so near is its echo: the surface bends most just before it turns away.
const ECHO_SHARE: f32 = 0.35;

/// What jumps by more than so many edges is none: a bend of 16 degrees.
pub(crate) const NO_ECHO: f32 = 8.0;

/// Whether number `at` of the `count` jumps of a row or column is the largest.
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
