//! The world is 3-D and the page is 2-D. An area uses the vectors of one of them, unless it translates between both.

use super::sources;

/// Areas of the world. They use no curve or point of the page (the crate kurbo).
const WORLD: [&str; 9] =
    ["mesh", "surface", "scene", "animation", "load", "view", "light", "lines", "motion"];

/// Areas of the page. They use no vector or matrix of the world (the 3-D types of the crate glam).
const PAGE: [&str; 8] = ["colour", "drawing", "text", "chains", "export", "diff", "testing", "style"];

/// 3-D types of glam.
const WORLD_TYPES: [&str; 8] = ["DVec3", "Vec3", "DMat3", "DMat4", "Mat4", "DQuat", "DAffine3", "Quat"];

/// Whether a line of code contains a word.
fn has_word(line: &str, word: &str) -> bool {
    line.split(|c: char| !c.is_alphanumeric() && c != '_').any(|own| own == word)
}

#[test]
fn areas_of_the_world_use_no_page_and_areas_of_the_page_use_no_world() {
    let mut faults = Vec::new();
    let (mut in_world, mut on_page) = (0, 0);
    for source in sources().iter().filter(|s| !s.is_test()) {
        for (number, line) in source.code() {
            let is_world = WORLD_TYPES.iter().any(|name| has_word(line, name));
            let is_page = has_word(line, "kurbo");
            in_world += usize::from(is_world);
            on_page += usize::from(is_page);
            let area = source.area.as_str();
            if is_page && WORLD.contains(&area) || is_world && PAGE.contains(&area) {
                faults.push(format!("{}:{number}: {}", source.name(), line.trim()));
            }
        }
    }
    assert!(in_world > 100 && on_page > 100, "{in_world} lines of the world, {on_page} of the page");
    assert!(faults.is_empty(), "the other dimension in:\n{}", faults.join("\n"));
}
