//! Whole files in the manner of engines and of other people's projects, with all that stands around a threshold there: lights, textures,
//! includes that are nowhere, conditions, several entry points. Written by somebody who had the list of obstacles and not the reader.
//!
//! `shipped/answers.tsv` has what has to be typed for each, and what is wrong with it. The reader was made with the first 28, which run
//! without a word or with a value for a uniform; of the other 25, by somebody else, 13 ran when they were tried for the first time, and
//! what stopped the others was mended. Of a third set of 25 (the file of O3DE is left out: its `ShaderResourceGroup` is no HLSL) 7 ran when
//! they were tried for the first time, and 15 once a message was followed. Of a fourth set of 15, which looked for what is hard, 3
//! and 4; ten of them are here, and what still stops the others is in docs/your_shader.md. `ForwardLitPass.hlsl` takes the ceiling for both octaves, which looks like a sum that wraps
//! around; that is what is told. `-` stands for a slip that no experiment tells: a natural logarithm in the weight alone.

use hashed_alpha::check::{cause, shaders};
use hashed_alpha::shader::interpreter::DeviceModel;
use hashed_alpha::shader::own::{self, Language, Options, THRESHOLD};
use hashed_alpha::threshold::two_scale::Variant;
use rayon::prelude::*;
use std::path::Path;

#[test]
fn files_run_as_they_are_and_the_cause_is_told() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/shipped");
    let table = std::fs::read_to_string(folder.join("answers.tsv")).unwrap();
    let rows: Vec<Vec<&str>> = table.lines().skip(1).map(|line| line.split('\t').collect()).collect();
    let mut files: Vec<_> = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.retain(|path| Language::of(path).is_some());
    assert_eq!(files.len(), rows.len(), "a file for each row");
    let wrong: Vec<String> = rows.par_iter().filter_map(|row| wrong(&folder, row)).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// What is not as the row says; nothing where the compiler of its language is missing.
fn wrong(folder: &Path, row: &[&str]) -> Option<String> {
    let &[file, function, variant, hash_scale, map, set, slip] = row else {
        panic!("seven columns, not {row:?}")
    };
    let pairs = |text: &str| {
        let pairs = text.split(' ').filter_map(|pair| pair.split_once('='));
        pairs.map(|(name, value)| (name.to_owned(), value.to_owned())).collect()
    };
    let function = if function.is_empty() { THRESHOLD } else { function }.to_owned();
    let options = Options { function, settings: pairs(set), map: pairs(map), include: Vec::new() };
    let shader = match own::read(&folder.join(file), &options) {
        Ok(shader) => shader,
        Err(error)
            if ["glslangValidator", "slangc, which"]
                .iter()
                .any(|compiler| error.message.contains(compiler)) =>
        {
            return None;
        }
        Err(error) => return Some(error.to_string()),
    };
    let variant = if variant == "isotropic" { Variant::Isotropic } else { Variant::Anisotropic };
    let mut subject = match shaders::interpreted(file, &shader, DeviceModel::ACCURATE, variant) {
        Ok(subject) => subject,
        Err(error) => return Some(error.to_string()),
    };
    subject.hash_scale = hash_scale.parse().expect("a size");
    let examination = cause::examine(&subject);
    let found: Vec<_> = examination.found.iter().map(|found| found.slip.name).collect();
    let wanted: Vec<_> = (!matches!(slip, "" | "-")).then_some(slip).into_iter().collect();
    let is_sound = slip.is_empty() == examination.follows;
    (found != wanted || !is_sound)
        .then(|| format!("{file}: {found:?}, not {wanted:?}, {}", examination.follows))
}
