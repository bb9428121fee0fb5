//! The shared models: a folder that is not part of the project and may be absent.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Mutex;

/// What was asked for and is not there.
static ABSENT: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

fn place() -> PathBuf {
    std::env::var_os("LIGNE_MODELS").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models")),
        PathBuf::from,
    )
}

/// The folder of the shared models, `LIGNE_MODELS`, or `../shared/models` beside the project; none if it is absent,
/// which is noted.
pub fn folder() -> Option<PathBuf> {
    let folder = place();
    if !folder.is_dir() {
        note("all");
        return None;
    }
    Some(folder)
}

/// The path of a shared model; none if it is absent, which is noted.
pub fn find(name: &str) -> Option<PathBuf> {
    let path = place().join(name);
    if !path.is_file() {
        note(name);
        return None;
    }
    Some(path)
}

fn note(name: &str) {
    println!("skipped: no {name} in {}", place().display());
    if let Ok(mut absent) = ABSENT.lock() {
        absent.insert(name.to_owned());
    }
}

/// What has been asked for and was not there, in one line.
pub fn absent() -> Option<String> {
    let absent = ABSENT.lock().ok()?;
    let names: Vec<&str> = absent.iter().map(String::as_str).collect();
    let place = place();
    let list = names.join(", ");
    (!names.is_empty()).then(|| format!("skipped: shared models that are not in {}: {list}", place.display()))
}
