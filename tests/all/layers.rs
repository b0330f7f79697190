//! Rules for imports in the crate: imports point down, siblings do not import each other, browser APIs stay in `wasm` and `view`.

use std::path::{Path, PathBuf};

use touchpath::describe::DefaultEntry;

/// Layers from the bottom up; modules of one layer do not import each other, except where listed.
const LAYERS: &[&[&str]] = &[
    &["num", "text"],
    &["geom"],
    &["tolerance"],
    &["form", "formula"],
    &["path"],
    &["control", "cycle", "part", "view", "tool_length"],
    &["job"],
    &["config", "describe", "import", "border"],
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
            let relative = path
                .strip_prefix(&src)
                .unwrap()
                .to_string_lossy()
                .replace('\\', "/");
            let module = relative.split(['/', '.']).next().unwrap().to_owned();
            (module, relative, std::fs::read_to_string(&path).unwrap())
        })
        .filter(|(module, ..)| module != "lib")
        .collect()
}

fn layer(module: &str) -> usize {
    LAYERS
        .iter()
        .position(|l| l.contains(&module))
        .unwrap_or_else(|| panic!("{module} has no layer"))
}

/// Top module of a path in a file: `crate::path`, `super::super::path`; `None` within the module or outside the crate.
fn target(file: &str, path: &[String]) -> Option<String> {
    let mut place: Vec<&str> = file.trim_end_matches(".rs").split('/').collect();
    if place.last() == Some(&"mod") {
        place.pop();
    }
    match path.first()?.as_str() {
        "crate" => path.get(1).cloned(),
        "super" => {
            let ups = path.iter().take_while(|word| *word == "super").count();
            // A module inside the file, such as `tests`, is one deeper: it can only lead less far up.
            if ups >= place.len() {
                path.get(ups).cloned()
            } else {
                Some(place[0].to_owned())
            }
        }
        _ => None,
    }
}

fn trees(tree: &syn::UseTree, before: &mut Vec<String>, found: &mut Vec<Vec<String>>) {
    let mut leaf = |name: String| found.push(before.iter().cloned().chain([name]).collect());
    match tree {
        syn::UseTree::Path(path) => {
            before.push(path.ident.to_string());
            trees(&path.tree, before, found);
            before.pop();
        }
        syn::UseTree::Group(group) => group
            .items
            .iter()
            .for_each(|tree| trees(tree, before, found)),
        syn::UseTree::Name(name) => leaf(name.ident.to_string()),
        syn::UseTree::Rename(rename) => leaf(rename.ident.to_string()),
        syn::UseTree::Glob(_) => leaf("*".to_owned()),
    }
}

/// Every path that a file imports, also inside its modules and functions, and every path in its code that begins with `crate::`.
fn imports(text: &str) -> Vec<Vec<String>> {
    fn items(list: &[syn::Item], found: &mut Vec<Vec<String>>) {
        for item in list {
            match item {
                syn::Item::Use(item) => trees(&item.tree, &mut Vec::new(), found),
                syn::Item::Mod(inner) => {
                    items(inner.content.as_ref().map_or(&[], |(_, list)| list), found)
                }
                syn::Item::Fn(function) => function.block.stmts.iter().for_each(|statement| {
                    if let syn::Stmt::Item(syn::Item::Use(item)) = statement {
                        trees(&item.tree, &mut Vec::new(), found);
                    }
                }),
                _ => {}
            }
        }
    }
    let mut found = Vec::new();
    items(&syn::parse_file(text).unwrap().items, &mut found);
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    for (at, _) in text.match_indices("crate::") {
        let rest = &text[at + 7..];
        let name: String = rest.chars().take_while(|c| word(*c)).collect();
        found.push(vec!["crate".to_owned(), name]);
    }
    found
}

#[test]
fn imports_point_down() {
    let mut seen = 0;
    for (module, file, text) in all() {
        for path in imports(&text) {
            let Some(name) = target(&file, &path) else {
                continue;
            };
            if name == module
                || name.is_empty()
                || !LAYERS
                    .iter()
                    .flat_map(|l| l.iter())
                    .any(|known| *known == name)
            {
                // A path that is no top module of the crate could only be an item of the root, and the root has no items.
                assert!(
                    name == module || name.is_empty() || name == "*",
                    "{file} imports {name}, which has no layer"
                );
                continue;
            }
            seen += 1;
            let allowed = ALLOWED.contains(&(module.as_str(), name.as_str()));
            assert!(
                allowed || layer(&name) < layer(&module),
                "{file} imports {name}"
            );
        }
    }
    assert!(seen > 300, "the test reads the sources: {seen}");
}

#[test]
fn every_form_of_an_import_is_read() {
    let found = |file: &str, text: &str| -> Vec<String> {
        let mut names: Vec<String> = imports(text)
            .iter()
            .filter_map(|path| target(file, path))
            .collect();
        names.dedup();
        names
    };
    assert_eq!(
        found("path/mod.rs", "use crate::{geom::Vec3, job as j};"),
        ["geom", "job", ""]
    );
    assert_eq!(
        found("cycle/ency/mod.rs", "use super::super::control::POSTS;"),
        ["control"]
    );
    assert_eq!(found("path/mod.rs", "use super::cycle;"), ["cycle"]);
    assert_eq!(
        found("cycle/ency/picked_touches.rs", "use super::{Pick, words};"),
        ["cycle"]
    );
    assert_eq!(
        found("part/mod.rs", "fn f() { use crate::view; }"),
        ["view"]
    );
    assert_eq!(
        found("part/mod.rs", "fn f() { crate::view::draw(); }"),
        ["view"]
    );
    assert_eq!(
        found(
            "part/mod.rs",
            "mod tests { use super::*; use crate::wasm::x; }"
        ),
        ["*", "wasm"]
    );
}

/// A control depends on features and on no cycle by name; a cycle depends on no control, except for the control of its default job.
#[test]
fn controls_and_cycles_do_not_name_each_other() {
    for (module, file, text) in all() {
        for (number, line) in text
            .lines()
            .enumerate()
            .filter(|(_, line)| !line.trim_start().starts_with("//"))
        {
            let names = |name: &str| line.contains(&format!("\"{name}\""));
            let cycles = touchpath::cycle::CYCLES.iter().any(|def| names(def.key));
            let controls = touchpath::control::POSTS.iter().any(|post| names(post.key));
            assert!(
                module != "control" || !cycles,
                "{file}:{}: {line}",
                number + 1
            );
            assert!(
                module != "cycle" || !controls || line.contains("default_control:"),
                "{file}:{}: {line}",
                number + 1
            );
        }
    }
}

#[test]
fn browsers_stay_at_the_edge() {
    for (_, file, text) in all() {
        let edge = file.starts_with("wasm/") || file.starts_with("view/canvas/");
        for name in ["wasm_bindgen", "web_sys", "js_sys"] {
            assert!(
                edge || !text.contains(&format!("{name}::")),
                "{file} names {name}"
            );
        }
        assert!(!text.contains("unsafe "), "{file}");
    }
}

#[test]
fn moves_are_matched_exhaustively_in_controls_and_views() {
    let mut seen = 0;
    for (module, file, text) in all()
        .into_iter()
        .filter(|(module, ..)| matches!(module.as_str(), "control" | "view"))
    {
        for (at, _) in text.match_indices("match step.purpose") {
            let body = &text[at..text[at..]
                .find("\n    }")
                .map_or(text.len(), |end| at + end)];
            assert!(
                !body.contains("_ =>"),
                "{module}: {file} matches moves with `_`"
            );
            seen += 1;
        }
    }
    assert!(seen >= 3, "the test reads the sources");
}

#[test]
fn the_forms_choices_are_the_registered_posts() {
    let keys: Vec<&str> = touchpath::control::POSTS.iter().map(|p| p.key).collect();
    let catalog = touchpath::describe::catalog();
    let control = catalog
        .sections
        .iter()
        .find(|s| s.path == "control")
        .unwrap();
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

/// Lines and comments of programs are parsed in one place. A dump of parameters is no program.
#[test]
fn one_lexer_reads_programs() {
    const SIGNS: [&str; 6] = [
        ".lines()",
        "memchr2(b'\\n'",
        "split(['\\n'",
        "split_once(';')",
        "memchr2(b'(', b';'",
        "find(|c| c == ';'",
    ];
    let readers = |file: &str| file.starts_with("control/") || file.starts_with("import/");
    let own = ["control/iso/lex.rs", "import/codes.rs"];
    let mut seen = 0;
    for (_, file, text) in all().into_iter().filter(|(_, file, _)| readers(file)) {
        let plain: String = text
            .split("#[cfg(test)]")
            .next()
            .unwrap_or_default()
            .to_owned();
        for sign in SIGNS {
            let found = plain.contains(sign);
            seen += usize::from(found && own.contains(&file.as_str()));
            assert!(
                !found || own.contains(&file.as_str()),
                "{file} finds lines or comments by itself: {sign}"
            );
        }
    }
    assert!(seen >= 2, "the one lexer has these signs: {seen}");
}

/// Reading, following and judging share no code with writing: one mistake would hide the other.
#[test]
fn reading_and_writing_share_no_code() {
    const READING: &[&str] = &[
        "prove", "safety", "trace", "release", "read", "script", "lex", "lines", "memory",
        "targets", "parse", "words", "codes",
    ];
    const WRITING: &[&str] = &[
        "writer::", "print::", "moves::", "header::", "::writer", "::print;", "{writer", "{print",
    ];
    let mut read = 0;
    for (_, file, text) in all().iter().filter(|(module, ..)| module == "control") {
        let name = file.trim_end_matches(".rs").rsplit('/').next().unwrap();
        if READING.contains(&name) || file.contains("/machine/") {
            read += 1;
            let code: String = text
                .lines()
                .filter(|line| !line.trim_start().starts_with("//"))
                .collect();
            assert!(
                WRITING.iter().all(|writing| !code.contains(writing)),
                "{file}"
            );
        }
    }
    assert!(read >= 15, "{read}");
}

/// Files that may import each other, with the reason.
const CIRCLES: &[(&str, &str)] = &[
    // A kind of value reads itself from a section, which consists of fields.
    ("form::checker", "form::field"),
];

/// Names that a file re-exports from the files below it, with their files.
fn handed_on(names: &[String], own: &str, text: &str) -> Vec<(String, usize)> {
    let mut found = Vec::new();
    for item in syn::parse_file(text).unwrap().items {
        let syn::Item::Use(item) = item else { continue };
        if matches!(item.vis, syn::Visibility::Inherited) {
            continue;
        }
        let mut paths = Vec::new();
        trees(&item.tree, &mut Vec::new(), &mut paths);
        for path in paths {
            let below = format!("{own}::{}", path[0]);
            let file = names.iter().position(|name| *name == below);
            found.extend(
                file.zip(path.last().cloned())
                    .map(|(file, name)| (name, file)),
            );
        }
    }
    found
}

/// Every path in code that begins with `crate::`.
fn in_code(text: &str) -> Vec<Vec<String>> {
    let code: String = text
        .lines()
        .filter(|line| !line.trim_start().starts_with("//"))
        .map(|line| format!("{line}\n"))
        .collect();
    let word = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == ':';
    let paths = code.match_indices("crate::").map(|(at, _)| {
        code[at..]
            .chars()
            .take_while(|c| word(*c))
            .collect::<String>()
    });
    paths
        .map(|path| {
            path.split("::")
                .filter(|word| !word.is_empty())
                .map(str::to_owned)
                .collect()
        })
        .collect()
}

/// Files of a module import each other in one direction only. Items of a parent for its children (`control/mod.rs` for `control/fanuc`) are no cycle.
#[test]
fn files_make_no_circles() {
    let name = |file: &str| {
        file.trim_end_matches(".rs")
            .trim_end_matches("/mod")
            .replace('/', "::")
    };
    let files = all();
    let names: Vec<String> = files.iter().map(|(_, file, _)| name(file)).collect();
    let on: Vec<Vec<(String, usize)>> = files
        .iter()
        .zip(&names)
        .map(|((_, _, text), own)| handed_on(&names, own, text))
        .collect();
    // File of a path: the longest one that is a module, or its re-export.
    let file_of = |own: &str, path: &[String]| -> Option<usize> {
        let mut place: Vec<&str> = match path.first()?.as_str() {
            "crate" => Vec::new(),
            "self" | "super" => own.split("::").collect(),
            _ => return None,
        };
        for word in path {
            match word.as_str() {
                "crate" | "self" => {}
                "super" => drop(place.pop()),
                word => place.push(word),
            }
        }
        let named = |count: usize| {
            names
                .iter()
                .position(|name| *name == place[..count].join("::"))
        };
        let (count, file) = (1..=place.len())
            .rev()
            .find_map(|count| Some((count, named(count)?)))?;
        let through = on[file]
            .iter()
            .find(|(name, _)| place.get(count) == Some(&name.as_str()));
        Some(through.map_or(file, |(_, below)| *below))
    };
    let mut edges: Vec<Vec<usize>> = Vec::new();
    for ((_, _, text), own) in files.iter().zip(&names) {
        // Imports of a file's tests do not count.
        let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
        let above =
            |target: &usize| format!("{own}::").starts_with(&format!("{}::", names[*target]));
        let excepted = |target: &usize| CIRCLES.contains(&(own.as_str(), names[*target].as_str()));
        let paths = imports(code).into_iter().chain(in_code(code));
        edges.push(
            paths
                .filter_map(|path| file_of(own, &path))
                .filter(|target| !above(target) && !excepted(target))
                .collect(),
        );
    }
    let reached = |from: usize| {
        let (mut seen, mut next) = (vec![false; names.len()], edges[from].clone());
        while let Some(at) = next.pop() {
            if !std::mem::replace(&mut seen[at], true) {
                next.extend(&edges[at]);
            }
        }
        seen
    };
    let circles: Vec<&String> = (0..names.len())
        .filter(|own| reached(*own)[*own])
        .map(|own| &names[own])
        .collect();
    assert!(circles.is_empty(), "these import each other: {circles:?}");
    let count: usize = edges.iter().map(Vec::len).sum();
    assert!(count > 400, "{count} imports were followed");
}
