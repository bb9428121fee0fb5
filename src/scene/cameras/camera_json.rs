//! The camera record: a [`Camera`] as JSON, for other programs.

use std::path::Path;

use glam::DVec3;
use serde::Serialize;
use serde_json::{Map, Value};

use super::camera::DEFAULT_FRAME_PX;
use crate::error::Error;
use crate::scene::{Camera, Projection};

/// Example of a record, shown in error messages.
const EXAMPLE_RECORD: &str = "a record looks like {\"type\": \"perspective\", \"eye\": [3, 2, 5], \"target\": [0, 0, 0], \
                       \"up\": [0, 1, 0], \"fov_y_deg\": 35, \"width_px\": 1000, \"height_px\": 1000}";

/// Serialised form of the record.
#[derive(Serialize)]
struct CameraRecord {
    r#type: &'static str,
    eye: [f64; 3],
    target: [f64; 3],
    up: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    fov_y_deg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    ortho_height: Option<f64>,
    width_px: f64,
    height_px: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    near: Option<f64>,
}

impl Camera {
    /// Reads a camera record. Accepts `fov`, `width` and `height` for `fov_y_deg`, `width_px` and
    /// `height_px`. The default size is 1000 x 1000 px; unknown keys are ignored.
    ///
    /// # Errors
    /// Names the line or the key that is wrong, and the remedy; see [`Camera::validate`].
    pub fn from_json(text: &str) -> Result<Self, Error> {
        let value: Value = serde_json::from_str(text.trim_start_matches('\u{feff}'))
            .map_err(|error| Error::json("the camera record is not JSON", &error).remedy(EXAMPLE_RECORD))?;
        let Value::Object(record) = value else {
            return Err(Error::new("the camera record is not a JSON object").remedy(EXAMPLE_RECORD));
        };
        let camera = Self {
            eye: point(&record, "eye")?,
            target: point(&record, "target")?,
            up: point(&record, "up")?,
            projection: projection(&record)?,
            width: number(&record, "width_px", "width")?.unwrap_or(DEFAULT_FRAME_PX),
            height: number(&record, "height_px", "height")?.unwrap_or(DEFAULT_FRAME_PX),
            near: number(&record, "near", "near")?,
        };
        camera.validate()?;
        Ok(camera)
    }

    /// Reads a camera record from a file.
    ///
    /// # Errors
    /// As [`Camera::from_json`], naming the file as well.
    pub fn open(path: impl AsRef<Path>) -> Result<Self, Error> {
        let path = path.as_ref();
        let text = std::fs::read_to_string(path).map_err(|error| {
            Error::io("cannot read the camera record", error)
                .in_file(path)
                .remedy("check the path; the file is JSON in UTF-8")
        })?;
        Self::from_json(&text).map_err(|error| error.in_file(path))
    }

    /// Writes the camera record: one line of JSON that [`Camera::from_json`] reads back bit for bit.
    #[must_use]
    pub fn to_json(&self) -> String {
        let (kind, fov_y_deg, ortho_height) = match self.projection {
            Projection::Perspective { fov_y_deg } => ("perspective", Some(fov_y_deg), None),
            Projection::Orthographic { height } => ("orthographic", None, Some(height)),
        };
        let record = CameraRecord {
            r#type: kind,
            eye: self.eye.to_array(),
            target: self.target.to_array(),
            up: self.up.to_array(),
            fov_y_deg,
            ortho_height,
            width_px: self.width,
            height_px: self.height,
            near: self.near,
        };
        // Serialising a struct of numbers cannot fail.
        serde_json::to_string(&record).unwrap_or_default()
    }
}

fn projection(record: &Map<String, Value>) -> Result<Projection, Error> {
    let kind = record.get("type").ok_or_else(|| missing("type"))?;
    match kind.as_str() {
        Some("perspective") => {
            let fov_y_deg = number(record, "fov_y_deg", "fov")?.ok_or_else(|| missing("fov_y_deg"))?;
            Ok(Projection::Perspective { fov_y_deg })
        }
        Some("orthographic") => {
            let height =
                number(record, "ortho_height", "ortho_height")?.ok_or_else(|| missing("ortho_height"))?;
            Ok(Projection::Orthographic { height })
        }
        _ => Err(Error::new(format!("there is no camera of type {kind}"))
            .at("key type")
            .remedy("write \"perspective\" or \"orthographic\"")),
    }
}

/// Number at `key`, or at the alternative key `other`; `null` counts as absent.
fn number(record: &Map<String, Value>, key: &str, other: &str) -> Result<Option<f64>, Error> {
    let (name, value) = match (record.get(key), record.get(other)) {
        (Some(value), _) => (key, value),
        (None, Some(value)) => (other, value),
        (None, None) => return Ok(None),
    };
    if value.is_null() {
        return Ok(None);
    }
    let number = value.as_f64().ok_or_else(|| {
        Error::new(format!("{value} is not a number")).at(format!("key {name}")).remedy("write a number")
    })?;
    Ok(Some(number))
}

fn point(record: &Map<String, Value>, key: &str) -> Result<DVec3, Error> {
    let value = record.get(key).ok_or_else(|| missing(key))?;
    let numbers: Option<Vec<f64>> =
        value.as_array().and_then(|items| items.iter().map(Value::as_f64).collect());
    match numbers.as_deref() {
        Some(&[x, y, z]) => Ok(DVec3::new(x, y, z)),
        _ => Err(Error::new(format!("{value} is not a point"))
            .at(format!("key {key}"))
            .remedy("write three numbers, such as [0, 1, 0]")),
    }
}

fn missing(key: &str) -> Error {
    Error::new("the camera record has no such key").at(format!("key {key}")).remedy(EXAMPLE_RECORD)
}

#[cfg(test)]
mod tests {
    use super::*;

    const PERSPECTIVE: &str = r#"{"type":"perspective","eye":[3,2,5.5],"target":[0,0,0],"up":[0,1,0],
        "fov_y_deg":35,"width_px":1000,"height_px":800}"#;

    #[test]
    fn from_json_reads_a_camera_record() -> Result<(), Error> {
        let camera = Camera::from_json(PERSPECTIVE)?;
        assert_eq!(camera.eye, DVec3::new(3.0, 2.0, 5.5));
        assert_eq!(camera.projection, Projection::Perspective { fov_y_deg: 35.0 });
        assert_eq!((camera.width, camera.height, camera.near), (1000.0, 800.0, None));
        let short = PERSPECTIVE.replace("fov_y_deg", "fov").replace("_px", "");
        assert_eq!(Camera::from_json(&short)?, camera);
        let noted = PERSPECTIVE.replace("{\"type\"", "{\"near\":null,\"note\":\"x\",\"type\"");
        assert_eq!(Camera::from_json(&noted)?, camera);
        Ok(())
    }

    #[test]
    fn camera_json_round_trip_keeps_every_bit() -> Result<(), Error> {
        let mut camera = Camera::from_json(PERSPECTIVE)?;
        camera.eye = DVec3::new(1.0 / 3.0, 1e-300, -123_456_789.123_456_78);
        camera.near = Some(0.1);
        assert_eq!(Camera::from_json(&camera.to_json())?, camera);
        camera.projection = Projection::Orthographic { height: 2.0_f64.sqrt() };
        assert_eq!(Camera::from_json(&camera.to_json())?, camera);
        Ok(())
    }

    #[test]
    fn camera_json_errors_name_the_place() {
        let with = |from: &str, to: &str| PERSPECTIVE.replace(from, to);
        let bad = [
            ("line 1, column 6", "{\"a\" 1}".to_owned()),
            ("key type", with("\"type\"", "\"kind\"")),
            ("key type", with("perspective", "fisheye")),
            ("key eye", with("\"eye\":[3,2,5.5],", "")),
            ("key eye", with("[3,2,5.5]", "[3,2]")),
            ("key eye", with("[3,2,5.5]", "[3,2,\"5\"]")),
            ("key fov_y_deg", with("\"fov_y_deg\":35,", "")),
            ("key fov_y_deg", with(":35", ":180")),
            ("key fov_y_deg", with(":35", ":\"wide\"")),
            ("key ortho_height", with("perspective", "orthographic")),
            ("key width_px", with(":1000", ":-5")),
            ("key up", with("[0,1,0]", "[-3,-2,-5.5]")),
            ("key target", with("[0,0,0]", "[3,2,5.5]")),
        ];
        for (place, text) in bad {
            let error = Camera::from_json(&text).expect_err(&text);
            assert_eq!(error.place.as_deref(), Some(place), "{error}");
            assert!(error.remedy.is_some(), "{error}");
        }
        assert!(Camera::from_json("[]").is_err());
        assert!(Camera::from_json(&with(":35", ":1e999")).is_err());
    }

    #[test]
    fn open_names_a_camera_file_that_cannot_be_read() {
        let error = Camera::open("no/such/camera.json").expect_err("no such file");
        assert!(error.to_string().starts_with("no/such/camera.json: "), "{error}");
    }
}
