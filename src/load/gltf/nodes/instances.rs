//! Transforms of the instances of a node (EXT_mesh_gpu_instancing).

use glam::{DAffine3, DQuat, DVec3};

use crate::animation::track::unit_quaternion;
use crate::error::Error;
use crate::load::gltf::json::Instancing;
use crate::load::gltf::storage::buffers::Buffers;

/// Transform of each instance relative to its node.
pub(crate) fn places(buffers: &Buffers, instancing: &Instancing) -> Result<Vec<DAffine3>, Error> {
    let attribute = |name: &str| instancing.attributes.get(name).copied();
    let translations = attribute("TRANSLATION").map(|a| buffers.read(a, DVec3::from_array)).transpose()?;
    let scales = attribute("SCALE").map(|a| buffers.read(a, DVec3::from_array)).transpose()?;
    let turn = |xyzw: [f64; 4]| unit_quaternion(xyzw).unwrap_or(DQuat::IDENTITY);
    let rotations = attribute("ROTATION").map(|a| buffers.read(a, turn)).transpose()?;

    let lengths = [
        translations.as_ref().map(Vec::len),
        rotations.as_ref().map(Vec::len),
        scales.as_ref().map(Vec::len),
    ];
    let mut lengths = lengths.into_iter().flatten();
    let Some(count) = lengths.next() else {
        return Err(Error::new("EXT_mesh_gpu_instancing: it has neither TRANSLATION, ROTATION nor SCALE"));
    };
    if lengths.any(|length| length != count) {
        return Err(Error::new(
            "EXT_mesh_gpu_instancing: its attributes differ in their number of instances",
        ));
    }
    let place = |i: usize| {
        DAffine3::from_scale_rotation_translation(
            scales.as_ref().and_then(|all| all.get(i)).copied().unwrap_or(DVec3::ONE),
            rotations.as_ref().and_then(|all| all.get(i)).copied().unwrap_or(DQuat::IDENTITY),
            translations.as_ref().and_then(|all| all.get(i)).copied().unwrap_or(DVec3::ZERO),
        )
    };
    Ok((0..count).map(place).collect())
}
