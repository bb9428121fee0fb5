//! Reference page `docs/reference/style-keys.md`.

use std::fmt::Write as _;

use super::key_listing::default;
use crate::style::{KeyType, StyleKey};

const HEAD: &str = "# Style keys

<!-- Written by `ligne styles --keys --reference`. Do not edit: change src/style/keys/table.txt. -->

All keys of a style sheet. In the terminal, `ligne styles --keys` lists them and `--set KEY=VALUE` sets one.

- A length is a number of px, or text with a unit: `\"0.35mm\"`, `\"1cm\"`, `\"0.1in\"`, `\"1pt\"`. On a page in mm, 1 px is 25.4/96 mm.
- A colour is `\"#rgb\"`, `\"#rrggbb\"`, `\"#rrggbbaa\"` or a CSS name. An ink is a colour, or `{ shade = 0.5 }` for a darker shade of the material.
- A factor is a number, three numbers for red, green and blue, or a colour.
- A part that ends in `[]` is a list of tables: `[[hatching.layer]]`. `--set` takes such a list as a whole: `--set 'light.sources=[{ … }]'`.
- `color` is accepted for `colour`.
";

/// Text of the reference page.
pub(crate) fn page() -> String {
    let mut page = HEAD.to_owned();
    page += "\n## Types\n\n| type | written as |\n| --- | --- |\n";
    for kind in KeyType::all() {
        let _ = writeln!(page, "| {} | {} |", kind.name(), kind.form());
    }
    for (index, section) in StyleKey::sections().iter().enumerate() {
        let _ = write!(page, "\n## {}\n", section.title);
        let [first, others @ ..] = &section.prefixes[..] else { continue };
        if let [_, ..] = others {
            let names: Vec<String> = others.iter().map(|prefix| format!("`{prefix}`")).collect();
            let _ = write!(
                page,
                "\nUnder `{first}`, and for some lines or materials only under {}.\n",
                names.join(", ")
            );
        }
        if !section.note.is_empty() {
            let _ = write!(page, "\n{}\n", section.note);
        }
        page += "\n| key | type | default | meaning |\n| --- | --- | --- | --- |\n";
        let keys = StyleKey::all().iter().filter(|key| key.section == index && key.prefix == *first);
        keys.for_each(|key| row(&mut page, key));
    }
    page
}

fn row(page: &mut String, key: &StyleKey) {
    let values = match key.kind {
        KeyType::Switch => String::new(),
        KeyType::Choice | KeyType::Choices => {
            let words: Vec<String> = key.words.iter().map(|word| format!("`{word}`")).collect();
            format!(": {}", words.join(" "))
        }
        _ if key.range == "any" => String::new(),
        _ => Some(key.values())
            .filter(|values| !values.is_empty())
            .map(|values| format!(", {values}"))
            .unwrap_or_default(),
    };
    // The unit of lengths is explained at the top of the page.
    let unit = if key.unit.is_empty() || key.unit == "px" { String::new() } else { format!(" {}", key.unit) };
    let default = match default(key) {
        default if default == "-" => String::new(),
        default => format!("`{default}`"),
    };
    let _ =
        writeln!(page, "| `{}` | {}{values}{unit} | {default} | {} |", key.path, key.kind.name(), key.help);
}
