//! A few colours that represent a texture.
//!
//! Files: [`palette_clusters`] the flat colours of a palette texture, as in low-polygon models;
//! [`colour_kmeans`] representative colours of any other picture, by k-means in Oklab (Lloyd 1982; Arthur and
//! Vassilvitskii 2007).

pub(crate) mod colour_kmeans;
pub(crate) mod palette_clusters;
