//! Flattening: all instances of a scene into one [`Soup`] in world space.
