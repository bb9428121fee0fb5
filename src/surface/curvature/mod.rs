//! Principal curvatures, their derivatives, and the feature size of each part.
//!
//! 1. Normals are smoothed by heat diffusion over a length (Chebyshev polynomials; Hammond et al. 2011).
//! 2. A curvature tensor is fitted to each face and averaged over the faces around each vertex (Rusinkiewicz
//!    2004).
//! 3. The derivative of the tensor is estimated in the same way.
//! 4. The feature size of a part, a length, makes curvature thresholds dimensionless (as in Rusinkiewicz's
//!    program rtsc).
//!
//! Files, in reading order: [`surface_curvature`] (all steps), [`vertex_fans`] (faces and Voronoi areas
//! around a vertex), [`normal_diffusion`] (step 1), [`principal_curvatures`] (step 2),
//! [`curvature_derivative`] (step 3), [`feature_size`].

mod curvature_derivative;
pub(crate) mod feature_size;
mod normal_diffusion;
pub(crate) mod principal_curvatures;
pub(crate) mod surface_curvature;
pub(crate) mod vertex_fans;
