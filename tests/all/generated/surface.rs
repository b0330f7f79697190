//! Public names of the crate, one per line, so that a review shows every change.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use syn::{Attribute, ImplItem, Item, Meta, UseTree, Visibility};

/// Every public name as a path, with its kind.
pub fn surface() -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut names = BTreeSet::new();
    walk(&root.join("lib.rs"), &root, "touchpath", None, &mut names);
    names.into_iter().map(|name| name + "\n").collect()
}

fn public(visibility: &Visibility) -> bool {
    matches!(visibility, Visibility::Public(_))
}

/// Whether an item is hidden from the docs or a test, and therefore not public.
fn hidden(attributes: &[Attribute]) -> bool {
    attributes.iter().any(|attribute| {
        if attribute.path().is_ident("path") {
            return true;
        }
        let Meta::List(list) = &attribute.meta else {
            return false;
        };
        attribute.path().is_ident("doc") && list.tokens.to_string() == "hidden"
    })
}

/// Names, with their names after a re-export.
type Renamed = BTreeMap<String, String>;

/// Public names of a file; for a private module, those that its parents re-export.
fn walk(
    file: &Path,
    folder: &Path,
    module: &str,
    only: Option<&Renamed>,
    names: &mut BTreeSet<String>,
) {
    let text = std::fs::read_to_string(file).unwrap();
    let items = syn::parse_file(&text).unwrap().items;
    let shown = |name: &str| match only {
        Some(only) => only.get(name).cloned(),
        None => Some(name.to_owned()),
    };
    let mut reexported = Renamed::new();
    for item in &items {
        if let Item::Use(item) = item
            && public(&item.vis)
            && !hidden(&item.attrs)
        {
            let mut found = Renamed::new();
            uses(&item.tree, &mut found);
            // A re-export from another module or under another name belongs to this module, too.
            let elsewhere = matches!(&item.tree, UseTree::Path(path) if path.ident == "crate");
            if elsewhere || matches!(&item.tree, UseTree::Rename(_)) {
                names.extend(
                    found
                        .values()
                        .filter_map(|name| Some(format!("{module}::{} use", shown(name)?))),
                );
            }
            reexported.extend(found);
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
                let syn::Type::Path(of) = &*item.self_ty else {
                    continue;
                };
                let Some(of) = shown(&of.path.segments.last().unwrap().ident.to_string()) else {
                    continue;
                };
                for inner in &item.items {
                    if let ImplItem::Fn(method) = inner
                        && public(&method.vis)
                    {
                        names.insert(format!("{module}::{of}::{} fn", method.sig.ident));
                    }
                }
                continue;
            }
            Item::Mod(item) if item.content.is_none() && !hidden(&item.attrs) => {
                let name = item.ident.to_string();
                let [own, inside]: [PathBuf; 2] = [
                    folder.join(format!("{name}.rs")),
                    folder.join(&name).join("mod.rs"),
                ];
                let wasm = name == "wasm" || (name == "canvas" && module.ends_with("view"));
                // A private module exports what its parent re-exports, under the parent's name; two nested ones what both re-export.
                let both =
                    |(name, called): (&String, &String)| Some((name.clone(), shown(called)?));
                let through: Renamed = reexported.iter().filter_map(both).collect();
                let whole = items.iter().any(|item| hands_on_all(item, &name));
                let inner = if public(&item.vis) || whole {
                    only
                } else {
                    Some(&through)
                };
                let path = if inner.is_some() || whole {
                    module.to_owned()
                } else {
                    format!("{module}::{name}")
                };
                if !wasm {
                    let file = if own.exists() { own } else { inside };
                    walk(&file, &folder.join(&name), &path, inner, names);
                }
                continue;
            }
            _ => continue,
        };
        if let Some(name) = shown(&name.to_string()).filter(|_| public(visibility)) {
            names.insert(format!("{module}::{name} {kind}"));
        }
    }
}

/// Whether an item is `pub use name::*`.
fn hands_on_all(item: &Item, name: &str) -> bool {
    let Item::Use(item) = item else { return false };
    matches!(&item.tree, UseTree::Path(path) if path.ident == name && matches!(*path.tree, UseTree::Glob(_)))
        && public(&item.vis)
}

/// Names at the ends of a `use`, with their new names.
fn uses(tree: &UseTree, found: &mut Renamed) {
    match tree {
        UseTree::Path(inner) => uses(&inner.tree, found),
        UseTree::Name(name) => {
            found.insert(name.ident.to_string(), name.ident.to_string());
        }
        UseTree::Rename(name) => {
            found.insert(name.ident.to_string(), name.rename.to_string());
        }
        UseTree::Group(group) => group.items.iter().for_each(|inner| uses(inner, found)),
        UseTree::Glob(_) => {}
    }
}
