//! Surface curves: curves and figures that lie on the model's surface, as seen on the page.
//!
//! 1. Level curves of a function on the faces are traced, joined end to end and projected (`level_curves`).
//! 2. A plane is laid on the faces by texture coordinates or part axes (`surface_chart`).
//! 3. Figures repeated on that plane, such as dots, are projected point by point from their centre outward
//!    (`decals`).
//!
//! Files, in reading order: [`level_curves`]; [`surface_chart`]; [`decals`].

pub(crate) mod decals;
pub(crate) mod level_curves;
pub(crate) mod surface_chart;
