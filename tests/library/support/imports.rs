//! Import graph of a crate, from `use` declarations and paths in its source code.
//!
//! Each imported name is followed through re-exports to the file that defines it.

use std::collections::{BTreeMap, BTreeSet};

/// A path of names, starting at the crate root.
type NamePath = Vec<String>;

/// A file of a crate.
pub(crate) struct File {
    /// Its path below `src/`, with `/` as separator.
    pub path: String,
    /// Its code, without comments and tests.
    pub code: String,
}

/// The files that each file imports from, by path below `src/`.
///
/// An import through a re-export counts as an import of the defining file. Public re-exports in `mod.rs` and
/// `lib.rs` are not counted, because a folder's front may publish its children.
pub(crate) fn import_graph(files: &[File]) -> BTreeMap<&str, BTreeSet<&str>> {
    let scope = CrateNames::new(files);
    let of_file = |file: &File| {
        let own = module_path(&file.path);
        let is_front = ["mod.rs", "lib.rs"].iter().any(|name| file.path.ends_with(name));
        let (uses, rest) = split_imports(&file.code);
        let used = uses.into_iter().filter(|used| !(is_front && used.is_public)).map(|used| used.path);
        used.chain(crate_paths(&rest))
            .filter_map(|path| scope.defining_file(&scope.resolve(&own, &path)?, MAX_REEXPORTS_FOLLOWED))
            .filter(|other| *other != file.path)
            .collect()
    };
    files.iter().map(|file| (&*file.path, of_file(file))).collect()
}

/// Import cycles: in each, every file imports the next and the last imports the first.
///
/// Cycles that share an import with a reported cycle may be missing.
pub(crate) fn import_cycles<'a>(imports: &BTreeMap<&'a str, BTreeSet<&'a str>>) -> Vec<Vec<&'a str>> {
    let mut rest = imports.clone();
    let mut found = Vec::new();
    loop {
        // A file without imports among the remaining files is in no cycle.
        let is_leaf = |others: &BTreeSet<&str>| others.iter().all(|other| !rest.contains_key(other));
        let leaves: Vec<&str> = rest.iter().filter(|(_, to)| is_leaf(to)).map(|(file, _)| *file).collect();
        if !leaves.is_empty() {
            rest.retain(|file, _| !leaves.contains(file));
            continue;
        }
        let Some((first, _)) = rest.first_key_value() else { return found };
        let mut way = vec![*first];
        loop {
            let last = way[way.len() - 1];
            let next = *rest[last].iter().find(|other| rest.contains_key(*other)).unwrap();
            if let Some(start) = way.iter().position(|file| *file == next) {
                found.push(way.split_off(start));
                rest.get_mut(last).unwrap().remove(next);
                break;
            }
            way.push(next);
        }
    }
}

/// Maximum number of re-exports followed for one name.
const MAX_REEXPORTS_FOLLOWED: usize = 8;

/// The modules of a crate and the names that they import.
struct CrateNames<'a> {
    files: BTreeMap<NamePath, &'a str>,
    names: BTreeMap<NamePath, NamePath>,
}

impl<'a> CrateNames<'a> {
    fn new(files: &'a [File]) -> Self {
        let places = files.iter().map(|file| (module_path(&file.path), &*file.path)).collect();
        let mut scope = Self { files: places, names: BTreeMap::new() };
        // The second pass resolves imports through names that the first pass found.
        for _ in 0..2 {
            for file in files {
                let own = module_path(&file.path);
                for used in split_imports(&file.code).0 {
                    let name = [&own[..], &[used.name]].concat();
                    if let Some(path) = scope.resolve(&own, &used.path).filter(|path| *path != name) {
                        scope.names.insert(name, path);
                    }
                }
            }
        }
        scope
    }

    /// Resolves a path used in the module `own` to a path from the crate root; `None` for other crates.
    fn resolve(&self, own: &[String], path: &[String]) -> Option<NamePath> {
        let supers = path.iter().take_while(|name| *name == "super").count();
        let (start, rest) = match path.first()?.as_str() {
            "crate" => (&own[..0], &path[1..]),
            "self" => (own, &path[1..]),
            "super" => (&own[..own.len().checked_sub(supers)?], &path[supers..]),
            first => {
                let inner = [own, &[first.to_owned()]].concat();
                let is_here = self.files.contains_key(&inner) || self.names.contains_key(&inner);
                (is_here.then_some(own)?, path)
            }
        };
        Some([start, rest].concat())
    }

    /// The file that defines the item at a path from the crate root.
    fn defining_file(&self, path: &[String], hops: usize) -> Option<&'a str> {
        let is_module = |count: &usize| self.files.contains_key(&path[..*count]);
        let known = (0..=path.len()).rev().find(is_module)?;
        let beyond = (known + 1).min(path.len());
        match self.names.get(&path[..beyond]).filter(|_| hops > 0 && known < path.len()) {
            Some(meant) => self.defining_file(&[meant, &path[beyond..]].concat(), hops - 1),
            None => self.files.get(&path[..known]).copied(),
        }
    }
}

/// The module path of a source file.
fn module_path(place: &str) -> NamePath {
    let mut path: NamePath = place.trim_end_matches(".rs").split('/').map(str::to_owned).collect();
    path.pop_if(|last| ["mod", "lib"].contains(&last.as_str()));
    path
}

/// An imported name.
struct ImportedName {
    path: NamePath,
    /// The name in the importing module, after any `as`.
    name: String,
    is_public: bool,
}

/// The imports of a source text, and the text without its `use` declarations.
fn split_imports(code: &str) -> (Vec<ImportedName>, String) {
    let (mut uses, mut others) = (Vec::new(), String::new());
    let mut rest = code;
    while let Some(line) = rest.split_inclusive('\n').next() {
        let bare = line.trim_start();
        let public = bare.strip_prefix("pub").and_then(|after| after.split_once("use "));
        let public = public.filter(|(between, _)| between.trim().is_empty() || between.ends_with(") "));
        let tree = bare.strip_prefix("use ").or(public.map(|(_, tree)| tree));
        let Some(tree) = tree.map(|tree| &rest[line.len() - tree.len()..]) else {
            others.push_str(line);
            rest = &rest[line.len()..];
            continue;
        };
        let (tree, after) = tree.split_once(';').unwrap_or((tree, ""));
        add_leaves(tree, &[], public.is_some(), &mut uses);
        rest = after;
    }
    (uses, others)
}

/// Adds the names of a `use` tree such as `a::{self, b::C as D}` below the path `before`.
fn add_leaves(tree: &str, before: &[String], is_public: bool, out: &mut Vec<ImportedName>) {
    let (head, list) = tree.split_once('{').map_or((tree, None), |(head, list)| (head, Some(list)));
    let (head, alias) = head.split_once(" as ").map_or((head, None), |(head, alias)| (head, Some(alias)));
    let names = head.split("::").map(str::trim).filter(|name| !name.is_empty());
    // Inside braces, `self` stands for the path before them.
    let names = names.filter(|name| before.is_empty() || *name != "self").map(str::to_owned);
    let path: NamePath = before.iter().cloned().chain(names).collect();
    let Some(list) = list else {
        let name = alias.map(str::trim).or(path.last().map(String::as_str)).unwrap_or_default().to_owned();
        out.push(ImportedName { path, name, is_public });
        return;
    };
    let (mut depth, mut start) = (0, 0);
    for (at, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth > 0 => depth -= 1,
            ',' | '}' if depth == 0 => {
                let inner = &list[start..at];
                if !inner.trim().is_empty() {
                    add_leaves(inner, &path, is_public, out);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
}

/// Paths in code that begin with `crate::`, `self::` or `super::`.
fn crate_paths(code: &str) -> Vec<NamePath> {
    let is_of_path = |c: char| c.is_alphanumeric() || c == '_' || c == ':';
    code.split(|c| !is_of_path(c))
        .filter(|path| ["crate::", "self::", "super::"].iter().any(|root| path.starts_with(root)))
        .map(|path| path.split("::").filter(|name| !name.is_empty()).map(str::to_owned).collect())
        .collect()
}
