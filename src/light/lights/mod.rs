//! Lights and how much of each reaches a point.
//!
//! 1. The lights of the model and of the style sheet are brought into local space.
//! 2. Diffuse light is the sum of brightness, fall-off and max(L·n, 0), or wrapped; highlights follow Blinn
//!    1977.
//! 3. Bounds of both over a small patch allow tracing to skip patches that no level crosses.
//!
//! Files, in reading order: [`light_options`] the `[light]` table; [`lamp`] one light; [`specular`]
//! highlights; [`light_slope`] the change of light with the normal; [`lighting`] all lights together.

mod lamp;
pub(crate) mod light_options;
pub(crate) mod light_slope;
pub(crate) mod lighting;
pub(crate) mod specular;
