//! Tones: steps of light on a surface, and their colours.
//!
//! 1. A scale gives the levels where the tone changes: thresholds, even steps, a ramp or a table.
//! 2. Each material gets one colour per tone (Lake et al. 2000, eq. 1; Gooch et al. 1998; or a palette).
//! 3. A view has channels, such as diffuse light and highlights. The levels that the channels reach at a
//!    point give its tone.
//!
//! Files, in reading order: [`tone_options`] the `[fills]` table; [`tone_ramps`] scales read from images;
//! [`material_tones`] levels and colours of one material; [`shade_options`] bins of light for hatching;
//! [`shading`] all channels of a view.

mod material_tones;
pub(crate) mod shade_options;
pub(crate) mod shading;
pub(crate) mod tone_options;
pub(crate) mod tone_ramps;
