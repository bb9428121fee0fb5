//! Locates the shared models, an optional folder outside the repository.

use std::collections::BTreeSet;
use std::path::PathBuf;
use std::sync::Mutex;

/// Names of models that were requested and are absent.
static ABSENT: Mutex<BTreeSet<String>> = Mutex::new(BTreeSet::new());

fn place() -> PathBuf {
    std::env::var_os("LIGNE_MODELS").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../shared/models")),
        PathBuf::from,
    )
}

/// The folder of the shared models; `None` if absent, which is recorded.
///
/// It is `LIGNE_MODELS` if set, otherwise `../shared/models` next to the repository.
pub(crate) fn folder() -> Option<PathBuf> {
    let folder = place();
    if !folder.is_dir() {
        note("all");
        return None;
    }
    Some(folder)
}

/// The path of a shared model; `None` if absent, which is recorded.
pub(crate) fn find(name: &str) -> Option<PathBuf> {
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

/// One line that lists all requested models that were absent.
pub(crate) fn absent() -> Option<String> {
    let absent = ABSENT.lock().ok()?;
    let names: Vec<&str> = absent.iter().map(String::as_str).collect();
    let place = place();
    let list = names.join(", ");
    (!names.is_empty()).then(|| format!("skipped: shared models that are not in {}: {list}", place.display()))
}
