//! Extensions that a file may require.

use crate::error::{Error, ErrorKind};

/// Supported extensions.
const READ_EXTENSIONS: [&str; 11] = [
    "KHR_mesh_quantization",
    "EXT_mesh_gpu_instancing",
    "EXT_meshopt_compression",
    "KHR_meshopt_compression",
    "KHR_draco_mesh_compression",
    "EXT_mesh_primitive_edge_visibility",
    "EXT_mesh_primitive_restart",
    "KHR_mesh_primitive_restart",
    "KHR_lights_punctual",
    "KHR_node_visibility",
    "KHR_texture_transform",
];

/// Extensions that do not affect shape or position; a trailing `*` matches any ending.
const IGNORED_EXTENSIONS: [&str; 14] = [
    "KHR_materials_*",
    "KHR_texture_*",
    "EXT_texture_*",
    "MSFT_texture_dds",
    "KHR_animation_pointer",
    "KHR_node_selectability",
    "KHR_node_hoverability",
    "KHR_xmp*",
    "KHR_audio*",
    "EXT_lights_*",
    "EXT_mesh_features",
    "EXT_structural_metadata",
    "ADOBE_materials_*",
    "BENTLEY_materials_*",
];

/// Returns an error for a file that requires an unsupported extension, naming it.
pub(crate) fn check(required: &[String]) -> Result<(), Error> {
    let harmless = |name: &str| {
        IGNORED_EXTENSIONS.iter().any(|known| match known.strip_suffix('*') {
            Some(start) => name.starts_with(start),
            None => name == *known,
        })
    };
    match required.iter().find(|name| !READ_EXTENSIONS.contains(&name.as_str()) && !harmless(name)) {
        Some(name) => {
            Err(Error::new(format!("the file requires the extension {name}, which ligne cannot read"))
                .of_kind(ErrorKind::Unsupported)
                .at("extensionsRequired")
                .remedy("export the model again without it"))
        }
        None => Ok(()),
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn only_unknown_required_extensions_are_refused() {
        let names = |list: &[&str]| list.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>();
        assert!(check(&names(&["KHR_mesh_quantization", "KHR_materials_unlit"])).is_ok());
        let error = check(&names(&["KHR_texture_basisu", "ACME_nurbs"])).unwrap_err();
        assert!(error.to_string().contains("ACME_nurbs"));
    }
}
