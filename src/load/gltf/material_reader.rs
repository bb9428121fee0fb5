//! Reads materials: base colour, emitted light, and the file or bytes of the base-colour texture.

use std::sync::Arc;

use super::json;
use super::uri;
use crate::animation::MaterialFactors;
use crate::animation::material_factors::AlphaMode;
use crate::load::gltf::json::lenient_index::DisplayIndex;
use crate::load::gltf::storage::buffers::{Buffers, Fetch};
use crate::scene::model_folder::ModelFolder;
use crate::scene::{Filter, Material, Warnings, Wrap};

/// Path of a texture next to the model, or its bytes.
type TextureOrigin = (Option<String>, Option<Arc<[u8]>>);

/// Number of bytes that are tested for an image format.
const IMAGE_HEAD_BYTES: usize = 32;

/// Access to the files next to a model.
#[derive(Clone, Copy)]
pub(crate) struct ModelFiles<'a> {
    /// Reads the beginning of a file.
    pub fetch: &'a Fetch<'a>,
    /// Index of all files; `None` if the model is not a file.
    pub all: Option<&'a ModelFolder>,
}

impl ModelFiles<'_> {
    /// Beginning of the file of a relative URI, its path, and whether that is the path in the URI. If no file
    /// is there, a file of a similar name is used.
    fn head(&self, uri: &str) -> Result<(Vec<u8>, String, bool), String> {
        let message = match uri::inside_folder(uri) {
            Err(message) => message,
            Ok(path) if self.all.is_some_and(|all| !all.has(&path)) => {
                format!("`{path}` is not a file in the model's folder")
            }
            Ok(path) => match (self.fetch)(&path, IMAGE_HEAD_BYTES) {
                Ok(bytes) => return Ok((bytes, path, true)),
                Err(error) => format!("`{path}` cannot be read ({error})"),
            },
        };
        let found = self.all.and_then(|all| all.find("", &uri::decoded(uri)));
        let read = found.and_then(|path| Some(((self.fetch)(&path, IMAGE_HEAD_BYTES).ok()?, path, false)));
        read.ok_or(message)
    }
}

/// Reads all materials of a file; problems with textures are only warnings.
pub(crate) fn materials(buffers: &Buffers, files: ModelFiles, warnings: &mut Warnings) -> Vec<Material> {
    let read = |material: &json::Material| {
        let texture =
            base_texture(material).and_then(|texture| image(texture, material, buffers, files, warnings));
        let (texture, picture) = texture.unwrap_or_default();
        let mut made = Material {
            name: material.name.clone().unwrap_or_default(),
            double_sided: material.double_sided,
            texture,
            picture,
            filter: base_texture(material).map_or(Filter::Smooth, |texture| filter(buffers.root, texture)),
            wrap: base_texture(material).map_or([Wrap::Repeat; 2], |texture| wrap(buffers.root, texture)),
            ..Material::default()
        };
        factors(material).apply_to(&mut made);
        made
    };
    buffers.root.materials.iter().map(read).collect()
}

/// Values of a material as stored in the file.
pub(crate) fn factors(material: &json::Material) -> MaterialFactors {
    let transmission = material.extensions.transmission.as_ref();
    MaterialFactors {
        base: base_colour(material),
        emissive: material.emissive_texture.is_none().then_some(material.emissive_factor),
        mode: match material.alpha_mode.as_deref() {
            Some("BLEND") => AlphaMode::Blend,
            Some("MASK") => AlphaMode::Mask,
            _ => AlphaMode::Opaque,
        },
        cutoff: material.alpha_cutoff.unwrap_or(0.5),
        roughness: material.pbr_metallic_roughness.roughness_factor,
        transmission: transmission.map_or(0.0, |own| own.transmission_factor),
    }
}

/// Whether the base colour comes from KHR_materials_pbrSpecularGlossiness; animation pointers to the metallic
/// base colour then have no effect.
pub(crate) fn is_glossy(material: &json::Material) -> bool {
    let glossy = material.extensions.specular_glossiness.as_ref();
    material.pbr_metallic_roughness.base_color_factor.is_none()
        && glossy.is_some_and(|glossy| glossy.diffuse_factor.is_some())
}

/// Base-colour texture of a material.
pub(crate) fn base_texture(material: &json::Material) -> Option<&json::TextureUse> {
    let glossy = material.extensions.specular_glossiness.as_ref();
    let metallic = material.pbr_metallic_roughness.base_color_texture.as_ref();
    metallic.or_else(|| glossy.and_then(|glossy| glossy.diffuse_texture.as_ref()))
}

fn base_colour(material: &json::Material) -> [f32; 4] {
    let glossy = material.extensions.specular_glossiness.as_ref();
    let metallic = material.pbr_metallic_roughness.base_color_factor;
    metallic.or_else(|| glossy.and_then(|glossy| glossy.diffuse_factor)).unwrap_or([1.0; 4])
}

/// Interpolation between the texels of a texture.
fn filter(root: &json::Root, texture: &json::TextureUse) -> Filter {
    let sampler = root.textures.get(texture.index).and_then(|texture| root.samplers.get(texture.sampler?));
    match sampler.and_then(|sampler| sampler.mag_filter) {
        Some(9728) => Filter::Blocks,
        _ => Filter::Smooth,
    }
}

/// Wrapping of a texture.
fn wrap(root: &json::Root, texture: &json::TextureUse) -> [Wrap; 2] {
    let sampler = root.textures.get(texture.index).and_then(|texture| root.samplers.get(texture.sampler?));
    sampler.map_or([Wrap::Repeat; 2], |sampler| {
        [sampler.wrap_s, sampler.wrap_t].map(|code| match code {
            Some(33_071) => Wrap::Clamp,
            Some(33_648) => Wrap::Mirror,
            _ => Wrap::Repeat,
        })
    })
}

/// Path of a texture file, or the bytes of a texture inside the model's file. Checks that it exists and
/// begins like an image.
fn image(
    texture: &json::TextureUse,
    material: &json::Material,
    buffers: &Buffers,
    files: ModelFiles,
    warnings: &mut Warnings,
) -> Option<TextureOrigin> {
    let root = buffers.root;
    let mut other_file = None;
    let mut broken = |number: usize, what: String| {
        let number = DisplayIndex(number);
        warnings.note(format!("texture {number}{}: {what}; the plain colour is drawn instead", of(material)));
        None
    };
    let number = texture.index;
    let Some(entry) = root.textures.get(number) else {
        return broken(number, format!("it is pointed to, but the file has {}", root.textures.len()));
    };
    let texture_extensions = &entry.extensions;
    let extension_source = [&texture_extensions.basisu, &texture_extensions.webp, &texture_extensions.avif]
        .into_iter()
        .flatten()
        .find_map(|other| other.source);
    let source = entry.source.or(extension_source)?;
    let Some(image) = root.images.get(source) else {
        return broken(
            number,
            format!("it shows image {}, but the file has {}", DisplayIndex(source), root.images.len()),
        );
    };
    let (bytes, path) = match (&image.uri, image.buffer_view) {
        (Some(text), _) => match uri::data(text) {
            Some(Ok(bytes)) => (bytes, None),
            Some(Err(message)) => return broken(number, message),
            None => match files.head(text) {
                Err(message) => return broken(number, message),
                Ok((bytes, path, is_named)) => {
                    other_file = (!is_named)
                        .then(|| format!("`{}` is not there; {path} is used", uri::shortened(text)));
                    (bytes, Some(path))
                }
            },
        },
        (None, Some(view)) => match buffers.view(view) {
            Ok((bytes, _)) => (bytes.to_vec(), None),
            Err(error) => return broken(number, error.to_string()),
        },
        (None, None) => return None,
    };
    if !is_image(&bytes) {
        return broken(number, format!("image {source} is damaged or of an unknown format"));
    }
    if let Some(substitute_note) = other_file {
        warnings.note(format!("texture {number}{}: {substitute_note}", of(material)));
    }
    let inside = path.is_none().then(|| Arc::from(bytes));
    Some((path, inside))
}

/// Text that names the material of a texture, if it has a name.
fn of(material: &json::Material) -> String {
    material.name.as_ref().map_or_else(String::new, |name| format!(" of material `{name}`"))
}

/// Whether bytes begin like a PNG, JPEG, WebP, KTX2, DDS or AVIF image.
fn is_image(bytes: &[u8]) -> bool {
    let at = |start: usize, magic: &[u8]| bytes.get(start..).is_some_and(|rest| rest.starts_with(magic));
    (at(0, b"\x89PNG\r\n\x1a\n") && at(12, b"IHDR"))
        || at(0, b"\xff\xd8\xff")
        || (at(0, b"RIFF") && at(8, b"WEBP"))
        || at(0, b"\xabKTX 20")
        || at(0, b"DDS ")
        || at(4, b"ftyp")
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::colour::srgb::Colour;

    fn read(json: &str) -> (Vec<Material>, Warnings) {
        let root: json::Root = serde_json::from_str(json).unwrap();
        let fetch = |path: &str, _: usize| match path {
            "here.png" => Ok(b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR".to_vec()),
            _ => Err(std::io::ErrorKind::NotFound.into()),
        };
        let buffers = Buffers::gather(&root, None, &fetch).unwrap();
        let mut warnings = Warnings::default();
        (materials(&buffers, ModelFiles { fetch: &fetch, all: None }, &mut warnings), warnings)
    }

    #[test]
    fn colours_of_metallic_and_specular_workflows_are_read() {
        let (materials, _) = read(
            r#"{"materials":[{},
            {"pbrMetallicRoughness":{"baseColorFactor":[1,0,0.2158605,0.5]},"doubleSided":true},
            {"alphaMode":"BLEND","emissiveFactor":[0,1,0],
             "extensions":{"KHR_materials_pbrSpecularGlossiness":{"diffuseFactor":[0,0,1,0.5]}}}]}"#,
        );
        assert_eq!(materials[0].colour, Colour::WHITE);
        assert_eq!(materials[1].colour, Colour::rgb(255, 0, 128));
        assert!(materials[1].double_sided);
        assert_eq!(materials[2].colour, Colour { r: 0, g: 0, b: 255, a: 128 });
        assert_eq!(materials[2].emissive, Colour::rgb(0, 255, 0));
        let (lamps, _) = read(r#"{"materials":[{"emissiveFactor":[1,1,1],"emissiveTexture":{"index":0}}]}"#);
        assert_eq!(lamps[0].emissive, Colour::BLACK);
    }

    #[test]
    fn unusable_textures_are_left_out_with_a_warning() {
        let texture = |uri: &str| {
            read(&format!(
                r#"{{"materials":[{{"name":"wood","pbrMetallicRoughness":{{"baseColorTexture":{{"index":0}}}}}}],
                "textures":[{{"source":0}}],"images":[{{"uri":"{uri}"}}]}}"#
            ))
        };
        let (materials, warnings) = texture("./here.png");
        assert_eq!((materials[0].texture.as_deref(), warnings.is_empty()), (Some("here.png"), true));
        for bad in ["lost.png", "../here.png", "data:image/png;base64,iVBORw0KGgpub3QgcmVhbGx5"] {
            let (materials, warnings) = texture(bad);
            assert_eq!((&materials[0].texture, warnings.lines().len()), (&None, 1), "{bad}");
            assert!(warnings.lines()[0].contains("material `wood`"), "{:?}", warnings.lines());
        }
    }
}
