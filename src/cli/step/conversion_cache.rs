//! [`ConversionCache`]: STEP models that were converted to GLB, stored in the cache folder of the user.
//!
//! - The key is a hash of everything that the result depends on. It is the file name of the entry.
//! - An entry consists of magic bytes, the up axis, a hash of the GLB, and the GLB. Entries with another
//!   hash are ignored.
//! - Entries are written under temporary names and renamed, so that readers never see an incomplete file.
//! - A hit updates the modification time of the entry. If all entries together exceed 1 GiB, the oldest are
//!   removed.

use std::fs::{self, File};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::{Duration, SystemTime};

use crate::error::Error;
use crate::scene::UpAxis;

/// Maximum total size of all entries, bytes.
const MAX_CACHE_BYTES: u64 = 1 << 30;

/// Age after which unfinished files of stopped runs are removed.
const MAX_UNFINISHED_AGE: Duration = Duration::from_secs(24 * 3600);

/// First bytes of an entry. The digit is the version of the format.
const ENTRY_MAGIC: &[u8; 4] = b"LST1";

/// File name extension of entries.
const ENTRY_ENDING: &str = "step-glb";

/// Hash of everything that a result depends on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct ConversionKey(u128);

impl ConversionKey {
    /// Key of a list of byte strings.
    pub(crate) fn of(things: &[&[u8]]) -> Self {
        let mut hash = Fnv::default();
        for thing in things {
            // Lengths are hashed as well, so that different splits give different keys.
            hash.add(&(thing.len() as u64).to_le_bytes());
            hash.add(thing);
        }
        Self(hash.0)
    }
}

/// 128-bit FNV-1a hash. Source: Fowler, Noll, Vo, draft-eastlake-fnv.
struct Fnv(u128);

impl Default for Fnv {
    fn default() -> Self {
        Self(0x6c62_272e_07bb_0142_62b8_2175_6295_c58d)
    }
}

impl Fnv {
    fn add(&mut self, bytes: &[u8]) {
        const PRIME: u128 = (1 << 88) + 0x13b;
        for byte in bytes {
            self.0 = (self.0 ^ u128::from(*byte)).wrapping_mul(PRIME);
        }
    }
}

/// Cache folder for converted models.
#[derive(Debug)]
pub(crate) struct ConversionCache {
    folder: PathBuf,
    /// Maximum total size of all entries, bytes.
    max_bytes: u64,
}

impl ConversionCache {
    /// Opens the folder of `LIGNE_CACHE`, else the cache folder of the user, else a temporary folder.
    pub(crate) fn open() -> Result<Self, Error> {
        let folder =
            folder(|name| std::env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from));
        let shared = std::env::temp_dir().join("ligne");
        let made = folder.iter().chain([&shared]).map(|folder| folder.join("step")).find(|folder| {
            // An existing folder may be write-protected.
            fs::create_dir_all(folder).is_ok()
                && fs::metadata(folder).is_ok_and(|data| !data.permissions().readonly())
        });
        made.map(|folder| Self { folder, max_bytes: MAX_CACHE_BYTES }).ok_or_else(|| {
            Error::new("there is no folder for converted STEP models")
                .remedy("name one with LIGNE_CACHE=FOLDER")
        })
    }

    /// New temporary path for a file that is being written.
    pub(crate) fn unfinished(&self, ending: &str) -> PathBuf {
        static NUMBER: AtomicU32 = AtomicU32::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        self.folder.join(format!("tmp-{}-{number}.{ending}", std::process::id()))
    }

    /// The GLB with a key, and its up axis.
    pub(crate) fn get(&self, key: ConversionKey) -> Option<(Vec<u8>, UpAxis)> {
        let path = self.path(key);
        let mut bytes = fs::read(&path).ok()?;
        let head = bytes.first_chunk::<21>()?;
        let up = match head.strip_prefix(ENTRY_MAGIC)?.first()? {
            b'y' => UpAxis::Y,
            b'z' => UpAxis::Z,
            _ => return None,
        };
        let glb = bytes.get(21..)?;
        if ConversionKey::of(&[glb]).0.to_le_bytes() != bytes.get(5..21)? {
            return None;
        }
        // The modification time only decides which entries are removed first, so failures are ignored.
        let _ =
            File::options().append(true).open(&path).and_then(|file| file.set_modified(SystemTime::now()));
        bytes.drain(..21);
        Some((bytes, up))
    }

    /// Stores a GLB. Failures are ignored, since the cache only saves time.
    pub(crate) fn put(&self, key: ConversionKey, glb: &[u8], up: UpAxis) {
        let unfinished = self.unfinished(ENTRY_ENDING);
        let write = || {
            let mut file = File::create(&unfinished)?;
            file.write_all(ENTRY_MAGIC)?;
            file.write_all(if up == UpAxis::Z { b"z" } else { b"y" })?;
            file.write_all(&ConversionKey::of(&[glb]).0.to_le_bytes())?;
            file.write_all(glb)?;
            file.sync_all()?;
            fs::rename(&unfinished, self.path(key))
        };
        if write().is_err() {
            let _ = fs::remove_file(&unfinished);
        }
        self.prune();
    }

    fn path(&self, key: ConversionKey) -> PathBuf {
        self.folder.join(format!("{:032x}.{ENTRY_ENDING}", key.0))
    }

    /// Removes the oldest entries until the rest fits, and unfinished files of stopped runs.
    fn prune(&self) {
        let now = SystemTime::now();
        let mut entries: Vec<(SystemTime, u64, PathBuf)> = Vec::new();
        for entry in fs::read_dir(&self.folder).into_iter().flatten().flatten() {
            let path = entry.path();
            let Some((time, length)) =
                entry.metadata().ok().and_then(|data| Some((data.modified().ok()?, data.len())))
            else {
                continue;
            };
            if entry.file_name().to_string_lossy().starts_with("tmp-") {
                if now.duration_since(time).is_ok_and(|age| age > MAX_UNFINISHED_AGE) {
                    let _ = fs::remove_file(path);
                }
            } else if has_ending(&path) {
                entries.push((time, length, path));
            }
        }
        entries.sort();
        let mut left: u64 = entries.iter().map(|(_, length, _)| length).sum();
        for (_, length, path) in entries {
            if left <= self.max_bytes {
                break;
            }
            if fs::remove_file(path).is_ok() {
                left -= length;
            }
        }
    }
}

fn has_ending(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending == ENTRY_ENDING)
}

/// Cache folder from environment variables.
fn folder(variable: impl Fn(&str) -> Option<PathBuf>) -> Option<PathBuf> {
    let own = |name: &str| Some(variable(name)?.join("ligne"));
    let in_home = || {
        let below = if cfg!(target_os = "macos") { "Library/Caches" } else { ".cache" };
        Some(variable("HOME")?.join(below).join("ligne"))
    };
    let of_windows = || cfg!(windows).then(|| own("LOCALAPPDATA")).flatten();
    // XDG base directory specification: relative paths are invalid.
    let xdg = || own("XDG_CACHE_HOME").filter(|path| path.is_absolute());
    variable("LIGNE_CACHE").or_else(xdg).or_else(of_windows).or_else(in_home)
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    fn temporary_cache(name: &str, max_bytes: u64) -> ConversionCache {
        let folder = std::env::temp_dir().join(format!("ligne-step-cache-{name}-{}", std::process::id()));
        fs::create_dir_all(&folder).unwrap();
        ConversionCache { folder, max_bytes }
    }

    #[test]
    fn conversion_cache_returns_entries_and_ignores_damaged_ones() {
        let cache = temporary_cache("broken", 1000);
        let key = ConversionKey::of(&[b"a", b"bc"]);
        assert_ne!(key, ConversionKey::of(&[b"ab", b"c"]));
        assert_eq!(cache.get(key), None);
        cache.put(key, b"glTF and more", UpAxis::Z);
        assert_eq!(cache.get(key), Some((b"glTF and more".to_vec(), UpAxis::Z)));
        let whole = fs::read(cache.path(key)).unwrap();
        for length in 0..whole.len() {
            fs::write(cache.path(key), &whole[..length]).unwrap();
            assert_eq!(cache.get(key), None, "{length} bytes");
        }
        let mut changed = whole.clone();
        *changed.last_mut().unwrap() ^= 1;
        fs::write(cache.path(key), changed).unwrap();
        assert_eq!(cache.get(key), None);
        fs::remove_dir_all(&cache.folder).unwrap();
    }

    #[test]
    fn conversion_cache_evicts_the_oldest_entries_first() {
        let cache = temporary_cache("full", 150);
        let keys = [b"a", b"b", b"c"].map(|thing| ConversionKey::of(&[thing]));
        for (key, days) in keys.iter().zip([30, 20, 10]) {
            cache.put(*key, &[0; 40], UpAxis::Y);
            let old = SystemTime::now() - Duration::from_secs(days * 24 * 3600);
            if let Ok(file) = File::options().append(true).open(cache.path(*key)) {
                file.set_modified(old).unwrap();
            }
        }
        // Three entries of 61 bytes exceed the limit. The second one is renewed by reading it.
        let renewed = ConversionKey::of(&[b"d"]);
        assert!(cache.get(keys[0]).is_none() && cache.get(keys[1]).is_some());
        cache.put(renewed, &[0; 40], UpAxis::Y);
        let kept: Vec<bool> = keys.iter().chain([&renewed]).map(|key| cache.get(*key).is_some()).collect();
        assert_eq!(kept, [false, true, false, true]);
        fs::write(cache.folder.join("tmp-1-1.glb"), "half").unwrap();
        cache.prune();
        assert!(cache.folder.join("tmp-1-1.glb").exists(), "it may still be written");
        fs::remove_dir_all(&cache.folder).unwrap();
    }

    #[test]
    fn cache_folder_follows_environment_variables() {
        let with = |set: &[(&str, &str)]| {
            folder(|name| set.iter().find(|(known, _)| *known == name).map(|(_, value)| PathBuf::from(value)))
        };
        assert_eq!(with(&[("LIGNE_CACHE", "own"), ("HOME", "/home/a")]), Some("own".into()));
        assert_eq!(with(&[]), None);
        if cfg!(unix) {
            assert_eq!(with(&[("XDG_CACHE_HOME", "/c"), ("HOME", "/h")]), Some("/c/ligne".into()));
            let home = with(&[("XDG_CACHE_HOME", "relative"), ("HOME", "/h")]).unwrap();
            assert!(home.starts_with("/h") && home.ends_with("ligne"), "{}", home.display());
        }
    }
}
