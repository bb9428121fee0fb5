//! Output files: written under temporary names and renamed at the end, all or none.

use std::fs;
use std::io::{ErrorKind, Write};
use std::path::{Path, PathBuf};

use crate::error::Error;
use crate::load::ModelFormat;

/// Format of an output.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Format {
    Svg,
    Svgz,
    Png,
    #[cfg(feature = "pdf")]
    Pdf,
    Dxf,
    SvgToStdout,
}

/// Output of a drawing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Output {
    /// The path as it was typed.
    pub(crate) path: PathBuf,
    pub(crate) format: Format,
}

impl Output {
    /// Reads the format from the file ending.
    pub(crate) fn new(path: PathBuf) -> Result<Self, Error> {
        if is_stdout(&path) {
            return Ok(Self { path, format: Format::SvgToStdout });
        }
        let ending = path.extension().map(|ending| ending.to_string_lossy().to_ascii_lowercase());
        let format = match ending.as_deref() {
            Some("svg") => Format::Svg,
            Some("svgz") => Format::Svgz,
            Some("png") => Format::Png,
            Some("dxf") => Format::Dxf,
            #[cfg(feature = "pdf")]
            Some("pdf") => Format::Pdf,
            #[cfg(not(feature = "pdf"))]
            Some("pdf") => {
                return Err(Error::new("this program was built without PDF")
                    .of_kind(crate::error::ErrorKind::Unsupported)
                    .in_file(path)
                    .remedy("build it with the feature `pdf`, or write .svg"));
            }
            Some(other) if ModelFormat::of_ending(other).is_some() => {
                return Err(Error::new("this is a model, and a drawing is expected here")
                    .in_file(path)
                    .remedy("to draw several models, give --out-dir FOLDER"));
            }
            Some(other) => {
                return Err(Error::new(format!("ligne cannot write drawings as .{other}"))
                    .in_file(path)
                    .remedy(
                        "end the name with .svg, .png, .pdf or .dxf, or write - for SVG on standard output",
                    ));
            }
            None => {
                return Err(Error::new("the name of the drawing has no format")
                    .in_file(path)
                    .remedy("end it with .svg, .png, .pdf or .dxf, or write - for SVG on standard output"));
            }
        };
        Ok(Self { path, format })
    }

    /// Name of the output in messages.
    pub(crate) fn name(&self) -> String {
        match self.format {
            Format::SvgToStdout => "standard output".to_owned(),
            _ => self.path.display().to_string(),
        }
    }
}

/// Whether a path means standard output.
pub(crate) fn is_stdout(path: &Path) -> bool {
    path.as_os_str() == "-"
}

/// Refuses an output path that cannot be written, before any work is done.
pub(crate) fn check_place(path: &Path) -> Result<(), Error> {
    if is_stdout(path) {
        return Err(Error::new("this output cannot go to standard output").remedy("name a file"));
    }
    if path.is_dir() {
        return Err(Error::new("this is a folder").in_file(path).remedy("name a file in it"));
    }
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() && !folder.is_dir() => {
            Err(Error::new(format!("there is no folder {}", folder.display()))
                .in_file(path)
                .remedy("create the folder first"))
        }
        _ => Ok(()),
    }
}

/// Writes one file under a temporary name, and renames it.
pub(crate) fn write_file(path: &Path, bytes: &[u8]) -> Result<(), Error> {
    let mut staging = Staging::default();
    staging.add(path, bytes)?;
    staging.commit()
}

/// Files under temporary names next to their final paths. Files that are not committed are removed on drop.
#[derive(Debug, Default)]
pub(crate) struct Staging {
    files: Vec<StagedFile>,
    /// Folders that were created for the files.
    folders: Vec<PathBuf>,
}

#[derive(Debug)]
struct StagedFile {
    /// The path as it was typed, for messages.
    typed: PathBuf,
    /// Final path with symbolic links resolved.
    final_path: PathBuf,
    /// Path that is written: a temporary name, or the final path of a device or pipe.
    written: PathBuf,
}

impl Staging {
    /// Writes a file under a temporary name next to its final path.
    pub(crate) fn add(&mut self, path: &Path, bytes: &[u8]) -> Result<(), Error> {
        check_place(path)?;
        let place = path.canonicalize().unwrap_or_else(|_| path.to_path_buf());
        let existing = fs::metadata(&place).ok();
        if let Some(existing) = &existing {
            if existing.permissions().readonly() {
                return Err(Error::new("the file is write-protected")
                    .in_file(path)
                    .remedy("make it writable, or give the output another name"));
            }
            if !existing.is_file() {
                let file = fs::OpenOptions::new().write(true).open(&place);
                return file.and_then(|mut file| file.write_all(bytes)).map_err(|e| cannot_write(path, e));
            }
        }
        let (written, mut file) = create_beside(&place).map_err(|error| cannot_write(path, error))?;
        // Registered before it is filled, so it is removed if the disc is full.
        self.files.push(StagedFile {
            typed: path.to_path_buf(),
            final_path: place,
            written: written.clone(),
        });
        file.write_all(bytes).map_err(|error| cannot_write(path, error))?;
        if let Some(existing) = existing {
            fs::set_permissions(&written, existing.permissions()).map_err(|e| cannot_write(path, e))?;
        }
        Ok(())
    }

    /// Creates a file under a temporary name that the caller fills. It is renamed with the others.
    pub(crate) fn create(&mut self, path: &Path) -> Result<fs::File, Error> {
        self.add(path, &[])?;
        let written = self.files.last().map(|file| file.written.as_path());
        let file = fs::OpenOptions::new().read(true).write(true).open(written.unwrap_or(path));
        file.map_err(|error| cannot_write(path, error))
    }

    /// Temporary path of the last file.
    pub(crate) fn last(&self) -> Option<&Path> {
        self.files.last().map(|file| file.written.as_path())
    }

    /// Creates a folder if it does not exist.
    pub(crate) fn make_folder(&mut self, path: &Path) -> Result<(), Error> {
        if !path.is_dir() {
            fs::create_dir(path).map_err(|error| cannot_write(path, error))?;
            self.folders.push(path.to_path_buf());
        }
        Ok(())
    }

    /// Renames all files to their final paths.
    pub(crate) fn commit(mut self) -> Result<(), Error> {
        while let Some(file) = self.files.first() {
            fs::rename(&file.written, &file.final_path).map_err(|error| cannot_write(&file.typed, error))?;
            self.files.remove(0);
        }
        Ok(())
    }
}

impl Drop for Staging {
    fn drop(&mut self) {
        for file in &self.files {
            // Failures to remove a file are ignored.
            let _ = fs::remove_file(&file.written);
        }
        for folder in &self.folders {
            // A folder with other files in it stays.
            let _ = fs::remove_dir(folder);
        }
    }
}

/// Creates a file with an unused temporary name in the folder of `final_path`.
fn create_beside(place: &Path) -> std::io::Result<(PathBuf, fs::File)> {
    let name = place.file_name().unwrap_or(place.as_os_str()).to_string_lossy();
    for attempt in 0_u32.. {
        let beside = place.with_file_name(format!(".{name}.{}-{attempt}.tmp", std::process::id()));
        match fs::File::create_new(&beside) {
            Err(error) if error.kind() == ErrorKind::AlreadyExists && attempt < 100 => {}
            created => return created.map(|file| (beside, file)),
        }
    }
    Err(ErrorKind::AlreadyExists.into())
}

/// File name that belongs to a temporary name of [`Staging`].
pub(crate) fn staged_target(name: &str) -> Option<&str> {
    let (drawing, by) = name.strip_prefix('.')?.strip_suffix(".tmp")?.rsplit_once('.')?;
    let (process, attempt) = by.split_once('-')?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    (is_number(process) && is_number(attempt)).then_some(drawing)
}

fn cannot_write(path: &Path, error: std::io::Error) -> Error {
    let remedy = match error.kind() {
        ErrorKind::NotFound => "create the folder first",
        ErrorKind::PermissionDenied => "choose a folder that you can write to",
        ErrorKind::StorageFull => "free some space",
        _ => "check the path",
    };
    Error::io("cannot write", error).in_file(path).remedy(remedy)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Creates an empty folder for one test.
    fn empty_folder(name: &str) -> std::io::Result<PathBuf> {
        let folder = std::env::temp_dir().join(format!("ligne-output-{name}-{}", std::process::id()));
        let _ = fs::remove_dir_all(&folder);
        fs::create_dir_all(&folder)?;
        Ok(folder)
    }

    fn file_names(folder: &Path) -> std::io::Result<Vec<String>> {
        let mut names = Vec::new();
        for entry in fs::read_dir(folder)? {
            names.push(entry?.file_name().to_string_lossy().into_owned());
        }
        names.sort();
        Ok(names)
    }

    #[test]
    fn staged_target_returns_the_file_of_a_temporary_name() {
        assert_eq!(staged_target(".gear.v2.svg.812-0.tmp"), Some("gear.v2.svg"));
        for other in
            ["gear.svg", ".gear.svg", ".tmp", ".gear.svg.812.tmp", ".gear.svg.x-0.tmp", "gear.svg.812-0.tmp"]
        {
            assert_eq!(staged_target(other), None, "{other}");
        }
    }

    #[test]
    fn staging_changes_no_file_before_commit() -> Result<(), Box<dyn std::error::Error>> {
        let folder = empty_folder("commit")?;
        let (old, new) = (folder.join("old.svg"), folder.join("new.svg"));
        fs::write(&old, "before")?;
        let mut staging = Staging::default();
        staging.add(&old, b"after")?;
        staging.add(&new, b"new")?;
        assert_eq!((fs::read(&old)?.as_slice(), new.exists()), (b"before".as_slice(), false));
        staging.commit()?;
        assert_eq!((fs::read(&old)?, fs::read(&new)?), (b"after".to_vec(), b"new".to_vec()));
        assert_eq!(file_names(&folder)?, ["new.svg", "old.svg"]);
        fs::remove_dir_all(folder)?;
        Ok(())
    }

    #[test]
    fn failed_staging_leaves_existing_files_unchanged() -> Result<(), Box<dyn std::error::Error>> {
        let folder = empty_folder("failure")?;
        let old = folder.join("old.svg");
        fs::write(&old, "before")?;
        let mut staging = Staging::default();
        staging.add(&old, b"after")?;
        let error = staging.add(&folder.join("no/such/folder.svg"), b"x").expect_err("no such folder");
        assert!(error.to_string().ends_with("create the folder first"), "{error}");
        assert!(staging.add(&folder, b"x").is_err());
        drop(staging);
        assert_eq!(fs::read(&old)?, b"before");
        assert_eq!(file_names(&folder)?, ["old.svg"]);
        fs::remove_dir_all(folder)?;
        Ok(())
    }

    #[test]
    fn staging_removes_created_folders_unless_committed() -> Result<(), Box<dyn std::error::Error>> {
        let folder = empty_folder("made")?;
        let made = folder.join("maps");
        let mut staging = Staging::default();
        staging.make_folder(&made)?;
        staging.add(&made.join("a.png"), b"a")?;
        drop(staging);
        assert!(!made.exists());
        let mut staging = Staging::default();
        staging.make_folder(&made)?;
        staging.add(&made.join("a.png"), b"a")?;
        staging.commit()?;
        assert_eq!(file_names(&made)?, ["a.png"]);
        fs::remove_dir_all(folder)?;
        Ok(())
    }

    #[cfg(unix)]
    #[test]
    fn commit_keeps_symbolic_links_and_permissions() -> Result<(), Box<dyn std::error::Error>> {
        use std::os::unix::fs::{PermissionsExt, symlink};
        let folder = empty_folder("links")?;
        let (real, link) = (folder.join("real.svg"), folder.join("link.svg"));
        fs::write(&real, "before")?;
        fs::set_permissions(&real, fs::Permissions::from_mode(0o640))?;
        symlink(&real, &link)?;
        let mut staging = Staging::default();
        staging.add(&link, b"after")?;
        staging.commit()?;
        assert!(fs::symlink_metadata(&link)?.is_symlink());
        assert_eq!(fs::read(&real)?, b"after");
        assert_eq!(fs::metadata(&real)?.permissions().mode() & 0o777, 0o640);
        fs::set_permissions(&real, fs::Permissions::from_mode(0o440))?;
        assert!(Staging::default().add(&link, b"again").is_err());
        fs::remove_dir_all(folder)?;
        Ok(())
    }
}
