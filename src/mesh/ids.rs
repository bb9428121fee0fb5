//! Typed ids, so that the compiler rejects a vertex id where an edge id is expected.

macro_rules! id {
    ($(#[$doc:meta])* $name:ident) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
        #[repr(transparent)]
        // Some ids are part of the public interface, others are not.
        #[allow(unreachable_pub)]
        pub struct $name(pub u32);

        #[allow(unreachable_pub)]
        impl $name {
            /// The id as an index into the arrays of its type.
            #[inline]
            #[must_use]
            pub const fn index(self) -> usize {
                self.0 as usize
            }
        }

        impl From<usize> for $name {
            #[inline]
            fn from(index: usize) -> Self {
                Self(index as u32)
            }
        }
    };
}

id!(
    /// A vertex of the mesh.
    VertexId
);
id!(
    /// A triangle of the mesh.
    FaceId
);
id!(
    /// A part of the scene: a glTF node, an OBJ object or group.
    PartId
);
id!(
    /// A material of the scene.
    MaterialId
);
id!(
    /// A paint of the scene: a material in one of its colours. The first paints are the materials.
    PaintId
);

impl From<MaterialId> for PaintId {
    #[inline]
    fn from(material: MaterialId) -> Self {
        Self(material.0)
    }
}
