//! Which file uses which: every path of a file that begins at the crate, at a neighbour or at a name that it imported,
//! followed through re-exports to the file that defines what is named. Comments, strings and unit tests are left out.

use proc_macro2::{Delimiter, TokenStream, TokenTree};
use std::collections::{BTreeMap, BTreeSet};

/// Source text by its path below `src`.
pub type Sources = BTreeMap<String, String>;

/// The files that each file uses, itself left out.
pub type Imports = BTreeMap<String, BTreeSet<String>>;

type Path = Vec<String>;

/// A name that a `use` brings into a module.
struct Binding {
    module: Path,
    path: Path,
    name: String,
    is_public: bool,
}

/// What matters of a file.
#[derive(Default)]
struct File {
    bindings: Vec<Binding>,
    /// Paths of two segments and more outside of imports, with the module that they stand in.
    paths: Vec<(Path, Path)>,
    /// Every word outside of imports.
    words: BTreeSet<String>,
}

/// The module of a file.
fn module(file: &str) -> Path {
    let parts = file.trim_end_matches(".rs").split('/').map(str::to_owned);
    parts.filter(|part| !["mod", "lib", "main"].contains(&part.as_str())).collect()
}

fn is_punct(token: Option<&TokenTree>, sign: char) -> bool {
    matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == sign)
}

fn word(token: Option<&TokenTree>) -> Option<String> {
    match token {
        Some(TokenTree::Ident(ident)) => Some(ident.to_string()),
        _ => None,
    }
}

/// Whether two colons stand at an index.
fn is_joint(tokens: &[TokenTree], at: usize) -> bool {
    is_punct(tokens.get(at), ':') && is_punct(tokens.get(at + 1), ':')
}

impl File {
    /// Reads the tree of a `use` from an index on; returns the index behind it.
    fn read_use(
        &mut self,
        tokens: &[TokenTree],
        mut at: usize,
        module: &Path,
        prefix: &Path,
        is_public: bool,
    ) -> usize {
        let mut path = prefix.clone();
        loop {
            match tokens.get(at) {
                Some(TokenTree::Group(group)) => {
                    let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                    let mut next = 0;
                    while next < inner.len() {
                        next = self.read_use(&inner, next, module, &path, is_public) + 1;
                    }
                    return at + 1;
                }
                Some(TokenTree::Ident(ident)) => path.push(ident.to_string()),
                _ => return at + 1,
            }
            at += 1;
            if is_joint(tokens, at) {
                at += 2;
                continue;
            }
            if path.len() > 1 && path.last().is_some_and(|last| last == "self") {
                path.pop();
            }
            let mut name = path.last().cloned().unwrap_or_default();
            if word(tokens.get(at)).is_some_and(|word| word == "as") {
                name = word(tokens.get(at + 1)).unwrap_or_default();
                at += 2;
            }
            self.bindings.push(Binding { module: module.clone(), path, name, is_public });
            return at;
        }
    }

    fn read(&mut self, stream: TokenStream, module: &Path) {
        let tokens: Vec<TokenTree> = stream.into_iter().collect();
        let mut at = 0;
        while at < tokens.len() {
            match &tokens[at] {
                TokenTree::Punct(punct) if punct.as_char() == '#' => {
                    let attribute = tokens.get(at + 1).map(ToString::to_string).unwrap_or_default();
                    if attribute.replace(' ', "") == "[cfg(test)]" {
                        let is_end = |token: &TokenTree| match token {
                            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
                            other => is_punct(Some(other), ';'),
                        };
                        at += tokens[at..].iter().position(is_end).unwrap_or(tokens.len());
                    }
                }
                TokenTree::Ident(ident) if ident == "use" && !is_punct(tokens.get(at + 1), '<') => {
                    let before = |back: usize| at.checked_sub(back).and_then(|index| tokens.get(index));
                    let is_public =
                        [1, 2].iter().any(|back| word(before(*back)).is_some_and(|word| word == "pub"));
                    at = self.read_use(&tokens, at + 1, module, &Path::new(), is_public);
                    continue;
                }
                TokenTree::Ident(ident) if ident == "mod" => {
                    if let (Some(name), Some(TokenTree::Group(group))) =
                        (word(tokens.get(at + 1)), tokens.get(at + 2))
                    {
                        let inner = [module.as_slice(), &[name]].concat();
                        self.read(group.stream(), &inner);
                    }
                    at += 2;
                }
                TokenTree::Ident(ident) => {
                    let mut path = vec![ident.to_string()];
                    let is_start = at < 2 || !is_joint(&tokens, at - 2);
                    while let (true, Some(next)) = (is_joint(&tokens, at + 1), word(tokens.get(at + 3))) {
                        path.push(next);
                        at += 3;
                    }
                    self.words.extend(path.iter().cloned());
                    if is_start && path.len() > 1 {
                        self.paths.push((module.clone(), path));
                    }
                }
                TokenTree::Group(group) => self.read(group.stream(), module),
                _ => {}
            }
            at += 1;
        }
    }
}

/// All files, read, with the modules that they are.
struct Crate {
    files: BTreeMap<String, File>,
    modules: BTreeMap<Path, String>,
}

/// Whether a path is that of a module or leads to one.
fn leads_to_module(modules: &BTreeMap<Path, String>, path: &Path) -> bool {
    modules.range(path.clone()..).next().is_some_and(|(module, _)| module.starts_with(path))
}

impl Crate {
    fn new(sources: &Sources) -> Self {
        let mut files = BTreeMap::new();
        for (name, text) in sources {
            let mut file = File::default();
            file.read(text.parse().unwrap_or_else(|error| panic!("{name}: {error}")), &module(name));
            files.insert(name.clone(), file);
        }
        let modules = sources.keys().map(|name| (module(name), name.clone())).collect();
        Self { files, modules }
    }

    /// What `name` is bound to in a module by an import.
    fn binding(&self, module: &Path, name: &str) -> Option<&Binding> {
        let file = &self.files[self.file_of(module)?];
        file.bindings.iter().find(|binding| binding.module == *module && binding.name == name)
    }

    /// The file that a module, which may be an inline one, stands in.
    fn file_of(&self, module: &Path) -> Option<&String> {
        (0..=module.len()).rev().find_map(|length| self.modules.get(&module[..length]))
    }

    /// The file that defines what a path names, if it is one of ours and no module.
    fn definition(&self, module: &Path, path: &[String], depth: usize) -> Option<&String> {
        let (first, mut rest) = path.split_first()?;
        let mut current = match first.as_str() {
            "crate" | "hashed_alpha" => Path::new(),
            "self" => module.clone(),
            "super" => module[..module.len().saturating_sub(1)].to_vec(),
            name => {
                let child = [module.as_slice(), &[name.to_owned()]].concat();
                match self.binding(module, name) {
                    _ if leads_to_module(&self.modules, &child) => child,
                    // An import of a name from a crate of the same name.
                    Some(binding) if depth < 8 && binding.path[0] != *name => {
                        let path = [binding.path.as_slice(), rest].concat();
                        return self.definition(module, &path, depth + 1);
                    }
                    _ => return None,
                }
            }
        };
        while let Some((next, after)) = rest.split_first() {
            let child = [current.as_slice(), std::slice::from_ref(next)].concat();
            if next == "super" {
                current.pop();
            } else if leads_to_module(&self.modules, &child) {
                current = child;
            } else if let (Some(binding), true) = (self.binding(&current, next), depth < 8) {
                return self.definition(&current, &[binding.path.as_slice(), after].concat(), depth + 1);
            } else {
                return self.file_of(&current);
            }
            rest = after;
        }
        None
    }
}

/// Which file uses which.
///
/// A re-export of what lies below a module is no use of it, unless the module's own code has the name as well.
pub fn imports(sources: &Sources) -> Imports {
    let all = Crate::new(sources);
    let mut imports = Imports::new();
    for (name, file) in &all.files {
        let mut used: BTreeSet<String> = BTreeSet::new();
        for binding in &file.bindings {
            let Some(target) = all.definition(&binding.module, &binding.path, 0) else { continue };
            let is_below = module(target).starts_with(&binding.module);
            if !(binding.is_public && is_below) || file.words.contains(&binding.name) {
                used.insert(target.clone());
            }
        }
        used.extend(file.paths.iter().filter_map(|(module, path)| all.definition(module, path, 0)).cloned());
        used.remove(name);
        imports.insert(name.clone(), used);
    }
    imports
}

/// Sets of files that use each other, directly or through others, each in order.
pub fn circles(imports: &Imports) -> Vec<Vec<String>> {
    let reached = |from: &String| {
        let mut reached = BTreeSet::new();
        let mut open = vec![from];
        while let Some(file) = open.pop() {
            open.extend(
                imports.get(file).into_iter().flatten().filter(|next| reached.insert((*next).clone())),
            );
        }
        reached
    };
    let all: BTreeMap<&String, BTreeSet<String>> = imports.keys().map(|file| (file, reached(file))).collect();
    let mut circles = BTreeSet::new();
    for (file, reached) in &all {
        if reached.contains(*file) {
            let circle = reached.iter().filter(|other| all[other].contains(*file)).cloned();
            circles.insert(circle.collect::<Vec<_>>());
        }
    }
    circles.into_iter().collect()
}

#[test]
fn paths_are_followed_to_what_they_name() {
    let sources = |files: &[(&str, &str)]| -> Sources {
        files.iter().map(|(name, text)| ((*name).to_owned(), (*text).to_owned())).collect()
    };
    let found = imports(&sources(&[
        ("lib.rs", "pub mod a; pub mod b; pub use a::deep::Deep;"),
        (
            "a/mod.rs",
            "mod deep; mod other; pub use deep::Deep; pub use other::Other; fn f() -> Other { todo!() }",
        ),
        ("a/deep.rs", "pub struct Deep;"),
        ("a/other.rs", "pub struct Other; // crate::b::Thing\n const S: &str = \"crate::b::Thing\";"),
        (
            "b.rs",
            "use crate::{Deep, a::{self as first, f}}; fn g(x: first::Other) {} #[cfg(test)] mod tests { use crate::c::C; }",
        ),
        (
            "c.rs",
            "pub struct C(glam::Vec3); mod inner { use super::C; fn h() -> super::super::b::B { todo!() } }",
        ),
    ]));
    let of = |file: &str| found[file].iter().map(String::as_str).collect::<Vec<_>>();
    assert_eq!(of("lib.rs"), [""; 0]);
    assert_eq!(of("a/mod.rs"), ["a/other.rs"]);
    assert_eq!(of("a/other.rs"), [""; 0]);
    assert_eq!(of("b.rs"), ["a/deep.rs", "a/mod.rs", "a/other.rs"]);
    assert_eq!(of("c.rs"), ["b.rs"]);
}
