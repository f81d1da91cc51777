//! Files that would take a parser down: damage, size, depth.

use super::*;
use hashed_alpha::threshold::pipeline::Pipeline;

#[test]
fn files_are_limited_and_known_by_their_ending_or_their_words() {
    let folder = tempfile::tempdir().unwrap();
    let large = folder.path().join("large.wgsl");
    std::fs::write(&large, vec![b'/'; LARGEST_FILE as usize + 3]).unwrap();
    let error = read(&large, &options(&[])).unwrap_err();
    assert!(error.message.contains("has 4194307 bytes; at most 4194304"), "{error}");
    // What has another ending is what its words say.
    let unknown = folder.path().join("shader.any");
    std::fs::write(&unknown, "float threshold(vec3 position) { return fract(position.x); }").unwrap();
    assert!(read(&unknown, &options(&[])).is_ok());
    std::fs::write(&unknown, "Dear reader, there is no shader here.").unwrap();
    let error = read(&unknown, &options(&[])).unwrap_err();
    assert!(error.message.contains("no word of it is one of GLSL, HLSL or WGSL"), "{error}");
    assert!(read(&folder.path().join("absent.any"), &options(&[])).is_err());
    assert!(read(&folder.path().join("absent.wgsl"), &options(&[])).is_err());
    let directory = folder.path().join("directory.wgsl");
    std::fs::create_dir(&directory).unwrap();
    assert!(read(&directory, &options(&[])).is_err());
}

#[test]
fn deep_nesting_is_a_message() {
    let deep =
        format!("fn threshold() -> f32 {{ return {}1.0{}; }}", "(".repeat(100_000), ")".repeat(100_000));
    assert!(wgsl(&deep, &options(&[])).unwrap_err().contains("nested too deeply"));
    let chain = format!("float threshold() {{ return {}1.0; }}", "- ".repeat(100_000));
    assert!(glsl(&chain, &options(&[])).unwrap_err().contains("nested too deeply"));
    let elses = "else if (x > 1.0) { x = 1.0; } ".repeat(900);
    let text = format!(
        "float threshold(float lod) {{ float x = lod; if (x < 0.0) {{ x = 0.0; }} {elses} return x; }}"
    );
    assert!(glsl(&text, &options(&[])).is_ok());
}

#[test]
fn what_would_take_a_parser_down_is_a_message() {
    let body =
        |expression: String| format!("fn threshold(position: vec3<f32>) -> f32 {{ return {expression}; }}");
    let glsl_body = |expression: String| format!("float threshold(vec3 position) {{ return {expression}; }}");
    let sum = "position.x + ".repeat(100_000) + "1.0";
    let swizzles = format!("position{}.x", ".xyz".repeat(100_000));
    for (text, wanted) in [(sum, "10000 operators"), (swizzles, "10000 operators")] {
        assert!(wgsl(&body(text.clone()), &options(&[])).unwrap_err().contains(wanted));
        assert!(glsl(&glsl_body(text), &options(&[])).unwrap_err().contains(wanted));
    }
    let indices = format!("position{}", "[0]".repeat(100_000));
    assert!(wgsl(&body(indices), &options(&[])).unwrap_err().contains("10000 operators"));
    let choices = "position.x > 0.5 ? 1.0 : ".repeat(30_000) + "0.5";
    assert!(glsl(&glsl_body(choices), &options(&[])).unwrap_err().contains("200 `&&`, `||` or `?`"));
    let bomb = "#define A0 1.0\n".to_owned()
        + &(1..40).map(|i| format!("#define A{i} A{0} + A{0}\n", i - 1)).collect::<String>()
        + &glsl_body("A39".to_owned());
    let error = glsl(&bomb, &options(&[])).unwrap_err();
    assert!(error.starts_with("own.glsl:41:41: more than"), "{error}");
    let body_of = |statements: usize| "x += position.x;\n".repeat(statements);
    let many = format!("float threshold(vec3 position) {{ float x = 0.0; {} return x; }}", body_of(100_000));
    let error = glsl(&many, &options(&[])).unwrap_err();
    assert!(error.contains(": more than 80000 words and signs in one function"), "{error}");
    let unread = format!("float lost(vec3 position) {{ float x = 0.0; {} return x; }}", body_of(100_000));
    let both = format!("{unread}\n{}", glsl_body("position.x".to_owned()));
    assert!(glsl(&both, &options(&[])).is_ok());
    let many =
        format!("fn threshold(position: vec3<f32>) -> f32 {{ var x = 0.0; {} return x; }}", body_of(100_000));
    let error = wgsl(&many, &options(&[])).unwrap_err();
    assert!(error.contains(": more than 80000 words and signs in one function"), "{error}");
    // What is within the limits is read, and said again, on whatever stack the caller has.
    let long = "position.x + ".repeat(4_900) + "1.0";
    assert!(wgsl(&body(long.clone()), &options(&[])).unwrap().wgsl().is_ok());
    assert!(glsl(&glsl_body(long), &options(&[])).is_ok());
    let calls = "fn g0(x: f32) -> f32 { return x; }".to_owned()
        + &(1..300)
            .map(|i| format!("fn g{i}(x: f32) -> f32 {{ return g{}(x); }}\n", i - 1))
            .collect::<String>()
        + &body("g299(position.x)".to_owned());
    let shader = wgsl(&calls, &options(&[])).unwrap();
    assert!(shader.program().unwrap_err().to_string().contains("nested more than 200 deep"));
}

#[test]
fn damaged_spir_v_gives_a_shader_or_a_message() {
    let whole = export(Pipeline::default(), export::Language::SpirV).unwrap().into_bytes();
    let reads = |bytes: &[u8]| parse("own.spv", Language::SpirV, bytes, &options(&[])).is_ok();
    assert!(reads(&whole));
    for end in (0..whole.len()).step_by(whole.len() / 40) {
        assert!(!reads(&whole[..end]), "{end}");
    }
    // Counts and identifiers beyond everything.
    for word in (0..whole.len() / 4).step_by(whole.len() / 4 / 150) {
        for value in [u32::MAX, 0x7fff_ffff, 0] {
            let mut bytes = whole.clone();
            bytes[4 * word..][..4].copy_from_slice(&value.to_le_bytes());
            let _ = reads(&bytes);
        }
    }
}

fn damaged() -> impl Strategy<Value = (usize, Vec<(usize, u8)>, Option<usize>)> {
    let bytes = proptest::collection::vec((0..5000_usize, any::<u8>()), 0..6);
    (0..10_usize, bytes, proptest::option::of(0..5000_usize))
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::default() })]

    /// Any damage to a shader gives a shader or a message.
    #[test]
    fn damaged_text_gives_a_shader_or_a_message((index, edits, end) in damaged()) {
        let path = &examples()[index];
        let mut bytes = std::fs::read(path).unwrap();
        for (at, byte) in edits {
            let length = bytes.len();
            bytes[at % length] = byte;
        }
        if let Some(end) = end {
            bytes.truncate(end);
        }
        let language = Language::of(path).unwrap();
        if let Err(error) = parse("damaged", language, &bytes, &options_of(path)) {
            prop_assert!(!error.message.is_empty());
            if let Some(Place { line, column }) = error.place {
                let lines: Vec<_> = bytes.split(|&byte| byte == b'\n').collect();
                prop_assert!((1..=lines.len()).contains(&line), "{error}");
                prop_assert!((1..=lines[line - 1].len() + 1).contains(&column), "{error}");
            }
        }
    }

    /// So does text that never was a shader.
    #[test]
    fn any_text_gives_a_message(text in "[-a-z0-9(){};=+*/.,<>#\n ]{0,60}") {
        for language in [Language::Wgsl, Language::Glsl, Language::SpirV] {
            prop_assert!(parse("any", language, text.as_bytes(), &options(&[])).is_err());
        }
    }

    /// Quotes of all kinds, opened and closed or not.
    #[test]
    fn any_quotes_give_a_shader_or_a_message(text in "[-`'\"R()\\\\${}/*+,;a-f\n é]{0,60}") {
        let asked = Options { function: "f".to_owned(), ..Options::default() };
        for text in [text.clone(), format!("{text} float f() {{ return 1.0; }} {text}")] {
            if let Err(error) = parse("any.js", Language::Quoted, text.as_bytes(), &asked) {
                prop_assert!(!error.message.is_empty());
            }
        }
    }
}
