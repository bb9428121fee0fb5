//! The width of a stroke at every point of its axis.
//!
//! 1. The pen's width is multiplied by factors for strength, light, depth and depth gap, and smoothed.
//! 2. Bends thicken or thin it, ends taper, and joined lines are blended.
//!
//! Source: Lake, Marshall, Harris and Blackstein, Stylized rendering techniques for scalable real-time 3D
//! animation, 2000, section 4.3. The paper picks a stroke texture by the angle between adjacent segments;
//! here the width follows the curvature.
//!
//! Files, in reading order: [`swell`] the `[pen.swell]` table; [`width_profile`] widths along an axis.

pub(crate) mod swell;
pub(crate) mod width_profile;
