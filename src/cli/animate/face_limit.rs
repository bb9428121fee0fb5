//! Number of faces of each frame: unlimited, a maximum, a time budget, or a list from a file.

use std::path::Path;

use serde_json::Value;

use crate::cli::json_files;
use crate::error::Error;

/// Limit on the number of faces of frames.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FaceLimit {
    /// No limit.
    All,
    /// Maximum number of faces, the same for all drawings.
    AtMost(u64),
    /// Drawing time per frame in ms; the number of faces adapts to it.
    Budget(f64),
    /// Maximum number of faces of each drawing, one entry per drawing.
    Listed(Vec<u64>),
}

/// Reads the time for a frame, in ms: `33ms`, `0.1s`, or a number of milliseconds.
pub(crate) fn budget(text: &str) -> Result<f64, String> {
    let (number, factor) = match (text.strip_suffix("ms"), text.strip_suffix('s')) {
        (Some(number), _) => (number, 1.0),
        (None, Some(number)) => (number, 1000.0),
        (None, None) => (text, 1.0),
    };
    let ms = number.trim().parse::<f64>().ok().map(|number| number * factor);
    ms.filter(|ms| ms.is_finite() && *ms > 0.0).ok_or_else(|| "write a time, such as 33ms".to_owned())
}

/// Reads the face counts of a file written by `--save-levels`, one per drawing.
pub(crate) fn read_levels(path: &Path, drawings: usize) -> Result<Vec<u64>, Error> {
    let remedy = "write one with --budget TIME --save-levels FILE";
    let value = json_files::read(path, remedy)?;
    let list = value.get("faces").and_then(Value::as_array);
    let faces: Option<Vec<u64>> = list.and_then(|list| list.iter().map(Value::as_u64).collect());
    let faces =
        faces.ok_or_else(|| Error::new("this is not a list of face counts").in_file(path).remedy(remedy))?;
    if faces.len() != drawings {
        return Err(Error::new(format!("it has {} levels, and there are {drawings} drawings", faces.len()))
            .in_file(path)
            .remedy("draw the same frames as when the file was written"));
    }
    Ok(faces)
}

/// Bytes of a file that [`read_levels`] reads.
pub(crate) fn written_levels(faces: &[u64], ms: f64) -> Vec<u8> {
    let list: Vec<String> = faces.iter().map(u64::to_string).collect();
    format!("{{\"budget_ms\": {ms}, \"faces\": [{}]}}\n", list.join(", ")).into_bytes()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn budget_parses_frame_times_with_units() {
        assert_eq!(budget("33ms"), Ok(33.0));
        assert_eq!(budget("0.1s"), Ok(100.0));
        assert_eq!(budget("20"), Ok(20.0));
        for wrong in ["", "ms", "-3ms", "0", "inf", "3 h"] {
            assert!(budget(wrong).is_err(), "{wrong}");
        }
    }
}
