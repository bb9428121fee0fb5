//! [`read`]: a parts list from a file, CSV with a header line or TOML with `[[item]]` tables.
//!
//! Each row takes the parts whose names match its pattern and that no row before took. Quantity and material
//! are taken from these parts if the row has none.

use std::path::Path;

use serde::Deserialize;

use super::parts_list_items::PartsListItem;
use crate::error::Error;
use crate::error::nearest::{nearest, suggestion};
use crate::geometry::names::glob::Glob;
use crate::scene::Scene;
use crate::style::{sheet_errors, toml_reader};

/// A row of the file.
#[derive(Debug, Clone, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct FileRow {
    /// Item number. Default: the next one.
    number: Option<String>,
    /// Pattern for the names of its parts. Default: the name.
    part: Option<String>,
    /// Name of the item.
    name: String,
    /// Quantity. Default: the number of parts.
    quantity: Option<usize>,
    material: Option<String>,
    remark: String,
}

#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields, default)]
struct FileRows {
    item: Vec<toml::Spanned<FileRow>>,
}

/// Column headings of CSV files with their synonyms; the key is first.
const CSV_HEADINGS: [&[&str]; 6] = [
    &["number", "item", "no", "pos"],
    &["part", "parts", "node"],
    &["name", "description", "designation", "title"],
    &["quantity", "qty", "count"],
    &["material"],
    &["remark", "remarks", "note", "notes"],
];

/// Reads the items of a scene from a file. Also returns the names of parts that belong to no item.
///
/// # Errors
/// Returns an error if the file cannot be read, a key or heading is unknown, or a row without a quantity
/// matches no part.
pub(crate) fn read(
    path: &Path,
    scene: &Scene,
    own: &[PartsListItem],
) -> Result<(Vec<PartsListItem>, Vec<String>), Error> {
    let text = std::fs::read_to_string(path).map_err(|error| {
        Error::new(format!("cannot be read: {error}")).in_file(path).remedy("check the path")
    })?;
    let is_toml = path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("toml"));
    let rows = if is_toml { rows_of_toml(&text) } else { rows_of_csv(&text) }
        .map_err(|error| error.in_file(path))?;
    let mut items = Vec::new();
    let mut taken = vec![false; scene.parts.len()];
    for (k, (place, row)) in rows.into_iter().enumerate() {
        let glob = Glob::new(row.part.as_deref().unwrap_or(&row.name));
        let fits = |part: &usize| !taken[*part] && glob.matches(&scene.parts[*part].name);
        let drawn = own.iter().flat_map(|item| item.parts.iter().copied());
        let mut parts: Vec<usize> = drawn.filter(fits).collect();
        parts.sort_unstable();
        if parts.is_empty() && row.quantity.is_none() {
            let wanted = row.part.as_deref().unwrap_or(&row.name);
            return Err(Error::new(format!("no part has the name `{wanted}`"))
                .at(place)
                .in_file(path)
                .remedy("name parts by `part`, where * matches any text, or give a quantity"));
        }
        parts.iter().for_each(|part| taken[*part] = true);
        let of_part = |part: &usize| own.iter().find(|item| item.parts.contains(part));
        let material = row.material.unwrap_or_else(|| {
            parts.first().and_then(of_part).map(|item| item.material.clone()).unwrap_or_default()
        });
        items.push(PartsListItem {
            number: row.number.unwrap_or_else(|| (k + 1).to_string()),
            count: row.quantity.unwrap_or(parts.len()),
            name: row.name,
            material,
            remark: row.remark,
            parts,
        });
    }
    let left = own.iter().flat_map(|item| item.parts.iter().copied()).filter(|part| !taken[*part]);
    let left = left.map(|part| scene.parts[part].name.clone()).collect();
    Ok((items, left))
}

fn rows_of_toml(text: &str) -> Result<Vec<(String, FileRow)>, Error> {
    let rows: FileRows =
        toml_reader::from_text(text).map_err(|error| sheet_errors::in_sheet(text, &error))?;
    let line = |at: usize| text.get(..at).map_or(0, |before| before.matches('\n').count()) + 1;
    let placed = |row: toml::Spanned<FileRow>| (format!("line {}", line(row.span().start)), row.into_inner());
    Ok(rows.item.into_iter().map(placed).collect())
}

fn rows_of_csv(text: &str) -> Result<Vec<(String, FileRow)>, Error> {
    let text = text.trim_start_matches('\u{feff}');
    let head = text.lines().next().unwrap_or_default();
    let separator = [';', '\t', ','].into_iter().max_by_key(|c| head.matches(*c).count()).unwrap_or(',');
    let mut records = records(text, separator).into_iter();
    let Some((_, headings)) = records.next() else { return Ok(Vec::new()) };
    let mut columns = Vec::new();
    for heading in &headings {
        let word = heading.trim().to_lowercase();
        let key = CSV_HEADINGS.iter().position(|names| names.contains(&word.as_str()));
        let known = CSV_HEADINGS.map(|names| names[0]);
        columns.push(key.ok_or_else(|| {
            Error::new(format!("there is no column `{}`", heading.trim()))
                .at("line 1")
                .remedy(suggestion(nearest(&word, &known), || format!("there are {}", known.join(", "))))
        })?);
    }
    let mut rows = Vec::new();
    for (line, cells) in records.filter(|(_, cells)| cells.iter().any(|cell| !cell.trim().is_empty())) {
        let place = format!("line {line}");
        let mut row = FileRow::default();
        for (key, cell) in columns.iter().zip(&cells) {
            let cell = cell.trim();
            let told = || Some(cell.to_owned()).filter(|cell| !cell.is_empty());
            match key {
                0 => row.number = told(),
                1 => row.part = told(),
                2 => row.name = cell.to_owned(),
                3 if cell.is_empty() => {}
                3 => {
                    let wrong = |_| {
                        Error::new(format!("`{cell}` is not a quantity"))
                            .at(&*place)
                            .remedy("write a whole number")
                    };
                    row.quantity = Some(cell.parse().map_err(wrong)?);
                }
                4 => row.material = told(),
                _ => row.remark = cell.to_owned(),
            }
        }
        rows.push((place, row));
    }
    Ok(rows)
}

/// The records of a CSV text with their first lines; cells may be quoted.
fn records(text: &str, separator: char) -> Vec<(usize, Vec<String>)> {
    let mut all = Vec::new();
    let (mut line, mut start) = (1, 1);
    let mut record: Vec<String> = Vec::new();
    let mut cell = String::new();
    let mut quoted = false;
    let mut chars = text.chars().peekable();
    while let Some(c) = chars.next() {
        line += usize::from(c == '\n');
        match c {
            '"' if quoted && chars.peek() == Some(&'"') => {
                chars.next();
                cell.push('"');
            }
            '"' if quoted || cell.trim().is_empty() => {
                quoted = !quoted;
            }
            c if c == separator && !quoted => record.push(std::mem::take(&mut cell)),
            '\n' if !quoted => {
                record.push(std::mem::take(&mut cell));
                all.push((start, std::mem::take(&mut record)));
                start = line;
            }
            '\r' if !quoted => {}
            c => cell.push(c),
        }
    }
    if !cell.is_empty() || !record.is_empty() {
        record.push(cell);
        all.push((start, record));
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn csv_cells_may_be_quoted() {
        let text = "name;remark\nbolt;\"M6; \"\"long\"\"\"\n\nnut;\n";
        let rows = rows_of_csv(text).unwrap();
        assert_eq!(rows.len(), 2);
        assert_eq!((rows[0].0.as_str(), rows[0].1.remark.as_str()), ("line 2", "M6; \"long\""));
        assert_eq!((rows[1].0.as_str(), rows[1].1.name.as_str()), ("line 4", "nut"));
        assert!(rows_of_csv("nam\n").is_err() && rows_of_csv("name,qty\na,b\n").is_err());
        assert!(rows_of_csv("").unwrap().is_empty());
    }
}
