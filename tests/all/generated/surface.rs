//! The names that a user of the crate can reach, one a line: a change of them is seen in a review.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use syn::{ImplItem, Item, UseTree, Visibility};

/// Every public name, as a path, with what it is.
pub fn surface() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut names = BTreeSet::new();
    walk(&root.join("lib.rs"), &root, "touchpath", None, &mut names);
    names.into_iter().map(|name| name + "\n").collect()
}

fn public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

/// The public names of a file. Of a private module only what its parent names in a `pub use`.
fn walk(file: &Path, folder: &Path, module: &str, only: Option<&BTreeSet<String>>, names: &mut BTreeSet<String>) {
    let text = std::fs::read_to_string(file).unwrap();
    let items = syn::parse_file(&text).unwrap().items;
    let shown = |name: &str| only.is_none_or(|only| only.contains(name));
    let mut reexported = BTreeSet::new();
    for item in &items {
        if let Item::Use(item) = item
            && public(&item.vis)
        {
            uses(&item.tree, &mut Vec::new(), &mut reexported);
        }
    }
    for item in &items {
        let (name, kind, visibility) = match item {
            Item::Fn(item) => (&item.sig.ident, "fn", &item.vis),
            Item::Struct(item) => (&item.ident, "struct", &item.vis),
            Item::Enum(item) => (&item.ident, "enum", &item.vis),
            Item::Trait(item) => (&item.ident, "trait", &item.vis),
            Item::Type(item) => (&item.ident, "type", &item.vis),
            Item::Const(item) => (&item.ident, "const", &item.vis),
            Item::Static(item) => (&item.ident, "static", &item.vis),
            Item::Impl(item) if item.trait_.is_none() => {
                let syn::Type::Path(of) = &*item.self_ty else { continue };
                let of = of.path.segments.last().unwrap().ident.to_string();
                for inner in item.items.iter().filter(|_| shown(&of)) {
                    if let ImplItem::Fn(method) = inner
                        && public(&method.vis)
                    {
                        names.insert(format!("{module}::{of}::{} fn", method.sig.ident));
                    }
                }
                continue;
            }
            Item::Mod(item) if item.content.is_none() => {
                let name = item.ident.to_string();
                let [own, inside]: [PathBuf; 2] = [folder.join(format!("{name}.rs")), folder.join(&name).join("mod.rs")];
                let wasm = name == "wasm" || (name == "canvas" && module.ends_with("view"));
                let inner = if public(&item.vis) { None } else { Some(&reexported) };
                // Behind a private module, and under the parent's name, stands what the parent re-exports.
                let path = if inner.is_some() { module.to_owned() } else { format!("{module}::{name}") };
                if !wasm {
                    let file = if own.exists() { own } else { inside };
                    walk(&file, &folder.join(&name), &path, inner, names);
                }
                continue;
            }
            _ => continue,
        };
        let name = name.to_string();
        if public(visibility) && shown(&name) {
            names.insert(format!("{module}::{name} {kind}"));
        }
    }
}

/// The names at the ends of a `use`.
fn uses(tree: &UseTree, path: &mut Vec<String>, found: &mut BTreeSet<String>) {
    match tree {
        UseTree::Path(inner) => {
            path.push(inner.ident.to_string());
            uses(&inner.tree, path, found);
            path.pop();
        }
        UseTree::Name(name) => {
            found.insert(name.ident.to_string());
        }
        UseTree::Rename(name) => {
            found.insert(name.ident.to_string());
        }
        UseTree::Group(group) => group.items.iter().for_each(|inner| uses(inner, path, found)),
        UseTree::Glob(_) => {}
    }
}
