//! The house rules of the crate: imports point down, siblings do not know each other, browsers stay at the edge.
#![cfg(not(target_arch = "wasm32"))]

use std::path::{Path, PathBuf};

use touchpath::describe::DefaultEntry;

/// Layers from the bottom up; modules of one layer do not import each other, except where listed.
const LAYERS: &[&[&str]] = &[
    &["num"],
    &["geom"],
    &["tolerance"],
    &["form", "formula"],
    &["path"],
    &["control", "cycle", "part", "view", "tool_length"],
    &["job"],
    &["describe", "import"],
    &["wasm"],
];

/// A picture shows what happens on the part.
const ALLOWED: &[(&str, &str)] = &[("view", "part"), ("view", "tool_length")];

fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else {
            found.push(path);
        }
    }
    found
}

fn all() -> Vec<(String, String, String)> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    sources(&src)
        .into_iter()
        .map(|path| {
            let relative = path.strip_prefix(&src).unwrap().to_string_lossy().replace('\\', "/");
            let module = relative.split(['/', '.']).next().unwrap().to_owned();
            (module, relative, std::fs::read_to_string(&path).unwrap())
        })
        .filter(|(module, ..)| module != "lib")
        .collect()
}

fn layer(module: &str) -> usize {
    LAYERS.iter().position(|l| l.contains(&module)).unwrap_or_else(|| panic!("{module} has no layer"))
}

#[test]
fn imports_point_down() {
    let mut seen = 0;
    for (module, file, text) in all() {
        for (at, _) in text.match_indices("crate::") {
            let name: String = text[at + 7..].chars().take_while(|c| c.is_ascii_lowercase() || *c == '_').collect();
            if name.is_empty() || name == module {
                continue;
            }
            seen += 1;
            let allowed = ALLOWED.contains(&(module.as_str(), name.as_str()));
            assert!(allowed || layer(&name) < layer(&module), "{file} imports {name}");
        }
    }
    assert!(seen > 20, "the test reads the sources");
}

#[test]
fn browsers_stay_at_the_edge() {
    for (_, file, text) in all() {
        let edge = file.starts_with("wasm/") || file == "view/canvas.rs";
        for name in ["wasm_bindgen", "web_sys", "js_sys"] {
            assert!(edge || !text.contains(&format!("{name}::")), "{file} names {name}");
        }
        assert!(!text.contains("unsafe "), "{file}");
    }
}

#[test]
fn moves_are_matched_exhaustively_in_controls_and_views() {
    let mut seen = 0;
    for (module, file, text) in all().into_iter().filter(|(module, ..)| matches!(module.as_str(), "control" | "view")) {
        for (at, _) in text.match_indices("match step.purpose") {
            let body = &text[at..text[at..].find("\n    }").map_or(text.len(), |end| at + end)];
            assert!(!body.contains("_ =>"), "{module}: {file} matches moves with `_`");
            seen += 1;
        }
    }
    assert!(seen >= 3, "the test reads the sources");
}

#[test]
fn the_forms_choices_are_the_registered_posts() {
    let keys: Vec<&str> = touchpath::control::POSTS.iter().map(|p| p.key).collect();
    let catalog = touchpath::describe::catalog();
    let control = catalog.sections.iter().find(|s| s.path == "control").unwrap();
    let post = control.fields.iter().find(|f| f.key == "post").unwrap();
    let choices: Vec<&str> = post
        .choices
        .iter()
        .map(|c| match c.value {
            DefaultEntry::Text(word) => word,
            _ => panic!("a control's name"),
        })
        .collect();
    assert_eq!(choices, keys);
}
