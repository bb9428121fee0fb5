//! The public items of the library are those of `docs/dev/public-items.txt`.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Adds the names of a file's public items, and those of its public modules.
fn add_items(file: &Path, module: &str, items: &mut BTreeSet<String>) {
    let text = fs::read_to_string(file).unwrap();
    let folder = file.parent().unwrap();
    // Multi-line imports on one line.
    let mut lines: Vec<String> = Vec::new();
    for line in text.lines() {
        match lines.last_mut() {
            Some(last) if last.starts_with("pub use") && !last.ends_with(';') => last.push_str(line.trim()),
            _ => lines.push(line.to_owned()),
        }
    }
    for (number, line) in lines.iter().enumerate() {
        let attributes = || lines[..number].iter().rev().take_while(|line| line.starts_with("#["));
        if attributes().any(|line| line == "#[doc(hidden)]") {
            continue;
        }
        let mut add = |name: &str| items.insert(format!("{module}{name}"));
        if let Some(import) = line.strip_prefix("pub use ") {
            let import = import.trim_end_matches(';');
            let (_, names) =
                import.rsplit_once("::").filter(|_| !import.contains('{')).unwrap_or(("", import));
            let names = names.split_once('{').map_or(names, |(_, names)| names.trim_end_matches('}'));
            for name in names.split(',').map(str::trim).filter(|name| !name.is_empty()) {
                add(name.rsplit(" as ").next().unwrap());
            }
        } else if let Some(name) = line.strip_prefix("pub mod ").and_then(|rest| rest.strip_suffix(';')) {
            add(name);
            let inner = folder.join(name).join("mod.rs");
            let inner = if inner.exists() { inner } else { folder.join(name).with_extension("rs") };
            add_items(&inner, &format!("{module}{name}::"), items);
        } else if let Some(rest) = line.strip_prefix("pub ") {
            let mut words =
                rest.split(|c: char| !c.is_alphanumeric() && c != '_').filter(|word| !word.is_empty());
            let kind = words.next().unwrap_or_default();
            if ["struct", "enum", "fn", "const", "static", "type", "trait"].contains(&kind) {
                add(words.find(|word| *word != "fn").unwrap());
            }
        }
    }
}

#[test]
fn public_items_are_those_of_the_list() {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    let mut items = BTreeSet::new();
    add_items(&root.join("src/lib.rs"), "", &mut items);
    let found: String = items.iter().map(|item| format!("{item}\n")).collect();
    let list = root.join("docs/dev/public-items.txt");
    if std::env::var_os("LIGNE_BLESS").is_some() {
        fs::write(&list, &found).unwrap();
    }
    let listed = fs::read_to_string(&list).unwrap_or_default();
    let kept: BTreeSet<String> = listed.lines().map(str::to_owned).collect();
    let new: Vec<_> = items.difference(&kept).collect();
    let gone: Vec<_> = kept.difference(&items).collect();
    assert!(
        listed == found,
        "public items changed; new: {new:?}, gone: {gone:?}. LIGNE_BLESS=1 writes docs/dev/public-items.txt"
    );
    assert!(items.len() <= 190, "{} public items and modules", items.len());
}
