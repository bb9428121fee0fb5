//! [`Models`]: the models of a figure, and the scene that they form.
//!
//! Each model is read, posed at its time, reduced to the selected parts and coloured. Then it is moved to its
//! position and appended to the scene. The first model determines the up axis of the scene.

use std::fmt;
use std::path::PathBuf;

use glam::{DAffine3, DMat3, DQuat, DVec3};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error as _, MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use toml::Spanned;

use super::part_colours::{self, PartColours};
use super::scene_assembly::{append_scene, move_scene};
use crate::animation::{Clip, Playing, Rigged};
use crate::error::Error;
use crate::geometry::numbers::portable_math::{cos, sin};
use crate::motion;
use crate::page::page_source::PageSource;
use crate::scene::{Scene, UpAxis};
use crate::style::Style;

/// The keys of a model.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct ModelKeys {
    /// File of the model, relative to the page file.
    pub file: Spanned<String>,
    /// Prefix of its part names: `hero` makes them `hero/head` and so on. Default: none.
    pub name: Option<String>,
    /// Position of its origin, in units of the first model. Default: 0, 0, 0.
    #[serde(default)]
    pub position: [f64; 3],
    /// Rotation in degrees about the x, then the y, then the z axis. Default: 0, 0, 0.
    #[serde(default)]
    pub rotation: [f64; 3],
    /// Scale factor. Default: 1.
    pub scale: Option<Spanned<f64>>,
    /// The axis that points up, `y` or `z`. Default: that of the file format.
    pub up: Option<Spanned<String>>,
    /// Time of its animation, in seconds. Default: that of the figure.
    pub time: Option<Spanned<f64>>,
    /// Name of its animation. Default: the only one.
    pub animation: Option<Spanned<String>>,
    /// One colour, or colours by part name, that replace its materials. Default: those of the file.
    #[serde(alias = "color")]
    pub colour: Option<Spanned<PartColours>>,
    /// Patterns of the parts that are kept. Default: all.
    #[serde(default)]
    pub only: Vec<String>,
    /// Patterns of the parts that are removed. Default: none.
    #[serde(default)]
    pub hide: Vec<String>,
}

/// The models of a figure: a path, a table of keys, or a list of these.
#[derive(Debug, Clone, Default)]
pub(crate) struct Models(pub Vec<ModelKeys>);

impl Models {
    /// The files of all models.
    pub(crate) fn files<'a>(&'a self, source: &'a PageSource) -> impl Iterator<Item = PathBuf> + 'a {
        self.0.iter().map(|model| source.resolve(model.file.get_ref()))
    }
}

/// The value of a key for one or more models.
enum ModelValue {
    Path(String),
    Keys(Box<ModelKeys>),
    List(Vec<Spanned<ModelValue>>),
}

impl<'de> Deserialize<'de> for ModelValue {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ModelValueVisitor)
    }
}

struct ModelValueVisitor;

impl<'de> Visitor<'de> for ModelValueVisitor {
    type Value = ModelValue;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a model: its path, a table such as { file = \"a.glb\", position = [1, 0, 0] }, or a list of these")
    }

    fn visit_str<E: serde::de::Error>(self, path: &str) -> Result<ModelValue, E> {
        Ok(ModelValue::Path(path.to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<ModelValue, A::Error> {
        ModelKeys::deserialize(MapAccessDeserializer::new(map)).map(|keys| ModelValue::Keys(Box::new(keys)))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<ModelValue, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(ModelValue::List)
    }
}

impl<'de> Deserialize<'de> for Models {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let written = Spanned::<ModelValue>::deserialize(deserializer)?;
        let mut models = Vec::new();
        add(written, &mut models).map_err(D::Error::custom)?;
        Ok(Self(models))
    }
}

fn add(written: Spanned<ModelValue>, models: &mut Vec<ModelKeys>) -> Result<(), String> {
    let span = written.span();
    match written.into_inner() {
        ModelValue::Path(path) => {
            let file = Spanned::new(span, path);
            models.push(ModelKeys {
                file,
                name: None,
                position: [0.0; 3],
                rotation: [0.0; 3],
                scale: None,
                up: None,
                time: None,
                animation: None,
                colour: None,
                only: Vec::new(),
                hide: Vec::new(),
            });
        }
        ModelValue::Keys(keys) => models.push(*keys),
        ModelValue::List(list) => list.into_iter().try_for_each(|one| add(one, models))?,
    }
    Ok(())
}

/// The scene of all models in their poses and positions.
///
/// `time` and `animation` apply to models without their own. The style selects the bodies with motion lines.
///
/// # Errors
/// Returns an error if a model cannot be read, lacks the animation or parts, or has an invalid position.
pub(crate) fn assemble_scene(
    models: &Models,
    time: Option<&Spanned<f64>>,
    animation: Option<&Spanned<String>>,
    style: &Style,
    source: &PageSource,
) -> Result<Scene, Error> {
    let mut all: Option<Scene> = None;
    for keys in &models.0 {
        let mut scene = posed_model(keys, time, animation, style, source)?;
        let up = all.as_ref().map_or(scene.up, |all| all.up);
        let to = scene_from_model(keys, [scene.up, up], source)?;
        move_scene(&mut scene, to);
        scene.up = up;
        if let Some(name) = &keys.name {
            for part in &mut scene.parts {
                part.name = format!("{name}/{}", part.name);
            }
        }
        match &mut all {
            None => all = Some(scene),
            Some(all) => append_scene(all, scene),
        }
    }
    Ok(all.unwrap_or_default())
}

/// A model posed at its time, with the selected parts.
fn posed_model(
    keys: &ModelKeys,
    time: Option<&Spanned<f64>>,
    animation: Option<&Spanned<String>>,
    style: &Style,
    source: &PageSource,
) -> Result<Scene, Error> {
    let path = source.existing(&keys.file, "model")?;
    let own = keys.time.is_some() || keys.animation.is_some();
    let (time, animation) = (keys.time.as_ref().or(time), keys.animation.as_ref().or(animation));
    let further = source.models.read(&path)?;
    let rigged = match &further {
        Some(scene) => Rigged::from(scene.clone()),
        None => Rigged::open(&path)?,
    };
    let moves = !rigged.rig.clips.is_empty() && (time.is_some() || animation.is_some());
    let mut scene = if moves || own {
        let playing = playing(&rigged.rig.clips, time, animation, keys, source)?;
        motion::posed(&rigged, &[playing], &style.motion, style.seed).map_err(|error| error.in_file(&path))?
    } else {
        let scene = further.map_or_else(|| Scene::open(&path), Ok)?;
        Scene { movers: Some(Vec::new()), ..scene }
    };
    if let Some(up) = &keys.up {
        scene.up = match up.get_ref().as_str() {
            "y" => UpAxis::Y,
            "z" => UpAxis::Z,
            _ => return Err(source.unknown(up, "axis", &["y", "z"])),
        };
    }
    if !(keys.only.is_empty() && keys.hide.is_empty()) {
        let names: Vec<String> = scene.parts.iter().map(|part| part.name.clone()).take(8).collect();
        scene.keep_parts(&keys.only, &keys.hide);
        if scene.parts.is_empty() {
            let advice = format!("its parts are {}", names.join(", "));
            return Err(source.fault(&keys.file.span(), "no part is left of this model", &advice));
        }
    }
    if let Some(own) = &keys.colour {
        part_colours::paint(&mut scene, own, source)?;
    }
    Ok(scene)
}

/// The animation of a model and its time.
fn playing(
    clips: &[Clip],
    time: Option<&Spanned<f64>>,
    animation: Option<&Spanned<String>>,
    keys: &ModelKeys,
    source: &PageSource,
) -> Result<Playing, Error> {
    let names: Vec<&str> = clips.iter().map(|clip| clip.name.as_str()).collect();
    let clip = match (animation, names.as_slice()) {
        (Some(name), _) => match names.iter().position(|known| known == name.get_ref()) {
            Some(clip) => clip,
            None => return Err(source.unknown(name, "animation", &names)),
        },
        (None, [_]) => 0,
        (None, []) => {
            return Err(source.fault(&keys.file.span(), "this model has no animation", "leave out its time"));
        }
        (None, _) => {
            let advice = format!("name one with `animation`: {}", names.join(", "));
            let message = format!("the model has {} animations", names.len());
            return Err(source.fault(&keys.file.span(), &message, &advice));
        }
    };
    source.check(time, |time| time.is_finite(), "this is not a time", "write a number of seconds")?;
    Ok(Playing::all(clip, time.map_or(0.0, |time| *time.get_ref())))
}

/// The transform of a model to the scene. `up` holds the up axes of the model and the scene.
fn scene_from_model(keys: &ModelKeys, up: [UpAxis; 2], source: &PageSource) -> Result<DAffine3, Error> {
    let [x, y, z] = keys.rotation.map(f64::to_radians);
    let numbers = keys.position.iter().chain(&keys.rotation);
    let scale = keys.scale.as_ref();
    if !numbers.copied().all(f64::is_finite) {
        return Err(source.fault(&keys.file.span(), "this is not a position", "write finite numbers"));
    }
    let is_positive = |scale: &f64| scale.is_finite() && *scale > 0.0;
    source.check(scale, is_positive, "this is not a scale for a model", "write a number above 0")?;
    let half = |angle: f64| (sin(angle / 2.0), cos(angle / 2.0));
    let [(x, of_x), (y, of_y), (z, of_z)] = [x, y, z].map(half);
    let turned = DQuat::from_xyzw(0.0, 0.0, z, of_z)
        * DQuat::from_xyzw(0.0, y, 0.0, of_y)
        * DQuat::from_xyzw(x, 0.0, 0.0, of_x);
    let scale = DVec3::splat(scale.map_or(1.0, |scale| *scale.get_ref()));
    // The up axis of the model becomes the up axis of the scene.
    let raised = match up {
        [UpAxis::Z, UpAxis::Y] => DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y),
        [UpAxis::Y, UpAxis::Z] => DMat3::from_cols(DVec3::X, DVec3::Z, DVec3::NEG_Y),
        _ => DMat3::IDENTITY,
    };
    let placed = DAffine3::from_scale_rotation_translation(scale, turned, DVec3::from_array(keys.position));
    Ok(placed * DAffine3::from_mat3(raised))
}
