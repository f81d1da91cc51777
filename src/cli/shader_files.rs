//! What a typed shader file means: which function of it, and with which values.

use super::args::{ClaimArgs, ShaderArgs};
use super::failure::Failure;
use super::output;
use hashed_alpha::shader::export::VERIFY;
use hashed_alpha::shader::own::{self, Language};
use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

/// A shader file as it was typed: `FILE`, or `FILE#FUNCTION`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ShaderFile<'a> {
    /// The file.
    pub path: &'a str,
    /// Its function, where it is named here.
    pub function: Option<&'a str>,
}

impl<'a> ShaderFile<'a> {
    /// Reads a word; nothing where it does not name a file of a shader.
    pub fn of(word: &'a str) -> Option<Self> {
        // A file of any other ending may be one, too.
        let is_shader = |path: &str| {
            let path = Path::new(path);
            Language::of(path).is_some() || path.extension().is_some() && path.is_file()
        };
        if is_shader(word) {
            return Some(Self { path: word, function: None });
        }
        let (path, function) = word.rsplit_once('#')?;
        is_shader(path).then_some(Self { path, function: Some(function) })
    }

    /// Returns the name of the file alone, with that of the function where it was typed.
    pub fn name(&self) -> String {
        let path = Path::new(self.path);
        let file = path.file_name().map_or_else(|| self.path.into(), |name| name.to_string_lossy());
        self.function.map_or_else(|| file.to_string(), |function| format!("{file}#{function}"))
    }

    /// Returns what the file is meant to be: as was typed, or where nothing was, as the one line of it says that `shader` wrote.
    pub fn claims(&self, args: &ShaderArgs) -> ClaimArgs {
        if args.claims != ClaimArgs::UNSTATED {
            return args.claims.clone();
        }
        let text = fs::read(self.path).unwrap_or_default();
        let text = String::from_utf8_lossy(&text);
        let mut said =
            text.lines().filter_map(|line| line.split_once(VERIFY)).map(|(_, options)| options.trim());
        let (Some(options), None) = (said.next(), said.next()) else { return args.claims.clone() };
        match ClaimArgs::read(options) {
            Some(claims) if claims != args.claims => {
                let name = self.name();
                output::remark("note", format_args!("{name} is tried as it says itself: {options}"));
                claims
            }
            _ => args.claims.clone(),
        }
    }

    /// Returns what is asked of the file: values that name it go before those that hold for every file.
    pub fn options(&self, args: &ShaderArgs) -> Result<own::Options, Failure> {
        let function = self.function.unwrap_or(&args.function).to_owned();
        let (settings, map) = (self.own(&SET, &args.set)?, self.own(&MAP, &args.map)?);
        Ok(own::Options { function, settings, map, include: args.include.clone() })
    }

    /// What an option says for this file: values that name it go before those that hold for every file.
    fn own(&self, option: &Pairs, typed: &[String]) -> Result<BTreeMap<String, String>, Failure> {
        let (own, shared): (Vec<_>, Vec<_>) =
            option.read(typed)?.into_iter().partition(|((file, _), _)| file.is_some());
        let own = own.into_iter().filter(|((file, _), _)| *file == Some(self.path));
        let pair = |((_, key), value): ((Option<&str>, &str), &str)| (key.to_owned(), value.to_owned());
        Ok(shared.into_iter().chain(own).map(pair).collect())
    }
}

/// Refuses a value for a file that is not among the subjects `typed`.
pub fn refuse_strays(typed: &[&str], args: &ShaderArgs) -> Result<(), Failure> {
    for (option, typed_pairs) in [(SET, &args.set), (MAP, &args.map)] {
        for ((file, key), value) in option.read(typed_pairs)? {
            if let Some(file) = file
                && !typed.iter().filter_map(|word| ShaderFile::of(word)).any(|typed| typed.path == file)
            {
                return Err(Failure::Usage(format!(
                    "{} {file}#{key}={value}: {file} is none of the files of this run",
                    option.name
                )));
            }
        }
    }
    Ok(())
}

/// An option that takes pairs, each for every file or for one.
struct Pairs {
    name: &'static str,
    form: &'static str,
}

const SET: Pairs = Pairs { name: "--set", form: "KEY=VALUE, as in hash_scale=2" };
const MAP: Pairs = Pairs { name: "--map", form: "KEY=NAME, as in position=pos" };

impl Pairs {
    /// Reads what was typed, by file, where one is named, and key.
    fn read<'t>(
        &self,
        typed: &'t [String],
    ) -> Result<BTreeMap<(Option<&'t str>, &'t str), &'t str>, Failure> {
        let Self { name, form } = self;
        let mut pairs = BTreeMap::new();
        for pair in typed {
            let (key, value) =
                pair.split_once('=').ok_or_else(|| Failure::Usage(format!("{name} {pair}: write {form}")))?;
            let (file, key) = key.rsplit_once('#').map_or((None, key), |(file, key)| (Some(file), key));
            if let Some(before) = pairs.insert((file, key.trim()), value.trim()) {
                let key = key.trim();
                return Err(Failure::Usage(format!("{name} {pair}: {key} has a value already, {before}")));
            }
        }
        Ok(pairs)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::Parser;

    #[derive(Parser)]
    struct Typed {
        #[command(flatten)]
        shader: ShaderArgs,
    }

    fn args(options: &[&str]) -> ShaderArgs {
        Typed::parse_from(["hashed-alpha"].iter().chain(options)).shader
    }

    #[test]
    fn a_file_may_name_its_function() {
        let file = |path, function| Some(ShaderFile { path, function });
        assert_eq!(ShaderFile::of("a/b.glsl"), file("a/b.glsl", None));
        assert_eq!(ShaderFile::of("a/b.glsl#c"), file("a/b.glsl", Some("c")));
        assert_eq!(ShaderFile::of("a#b.glsl"), file("a#b.glsl", None));
        assert_eq!(ShaderFile::of("robust"), None);
        assert_eq!(ShaderFile::of("robust#a"), None);
        assert_eq!(ShaderFile::of("a/b.glsl#c").unwrap().name(), "b.glsl#c");
    }

    #[test]
    fn what_names_a_file_goes_before_what_holds_for_all() {
        let typed = args(&["--function", "f", "--set", "k=1", "--set", "a.glsl#k=2", "--set", "j = 3"]);
        let options = |word: &str| ShaderFile::of(word).unwrap().options(&typed).unwrap();
        let values = |word: &str| options(word).settings.into_values().collect::<Vec<_>>();
        assert_eq!(values("a.glsl#g"), ["3", "2"]);
        assert_eq!(values("b.glsl"), ["3", "1"]);
        assert_eq!(
            (options("a.glsl#g").function, options("b.glsl").function),
            ("g".to_owned(), "f".to_owned())
        );
        let mapped = args(&["--map", "position=q", "--map", "a.glsl#position=p"]);
        let map = |word: &str| {
            ShaderFile::of(word).unwrap().options(&mapped).unwrap().map.into_values().collect::<Vec<_>>()
        };
        assert_eq!((map("a.glsl"), map("b.glsl")), (vec!["p".to_owned()], vec!["q".to_owned()]));
        assert!(refuse_strays(&["b.glsl"], &mapped).is_err());
        assert!(refuse_strays(&["a.glsl#g"], &typed).is_ok());
        let error = refuse_strays(&["b.glsl"], &typed).unwrap_err().to_string();
        assert!(error.ends_with("a.glsl is none of the files of this run"), "{error}");
    }

    #[test]
    fn a_setting_has_a_key_and_one_value() {
        let error = |options: &[&str]| SET.read(&args(options).set).unwrap_err().to_string();
        assert!(error(&["--set", "hash_scale"]).contains("write KEY=VALUE"));
        let twice = error(&["--set", "k=1", "--set", "k=2"]);
        assert_eq!(twice, "--set k=2: k has a value already, 1");
        let without = MAP.read(&["position".to_owned()]).unwrap_err().to_string();
        assert_eq!(without, "--map position: write KEY=NAME, as in position=pos");
    }
}
