//! The cause of a rejection where people work: first in the table, at the line of the function in SARIF and in a workflow.

use std::process::Command;

const BINARY: &str = env!("CARGO_BIN_EXE_hashed-alpha");

/// A port that takes the derivative along x twice, in the third line.
const PORT_WITH_A_SLIP: &str = "\
float hash(vec2 p) { return fract(1.0e4 * sin(17.0 * p.x + 0.1 * p.y) * (0.1 + abs(sin(13.0 * p.y + p.x)))); }
float hash3(vec3 p) { return hash(vec2(hash(p.xy), p.z)); }
float threshold(vec3 position) {
    float derivative = max(length(dFdx(position)), length(dFdx(position)));
    float scale = log2(1.0 / derivative);
    float t = fract(scale);
    float x = mix(hash3(floor(exp2(floor(scale)) * position)), hash3(floor(exp2(ceil(scale)) * position)), t);
    float a = min(t, 1.0 - t);
    float chi = x < a ? x * x / (2.0 * a * (1.0 - a))
        : x < 1.0 - a ? (x - 0.5 * a) / (1.0 - a) : 1.0 - (1.0 - x) * (1.0 - x) / (2.0 * a * (1.0 - a));
    return clamp(chi, 1.0e-6, 1.0);
}
";

#[test]
fn the_cause_is_told_first_and_at_the_line_of_the_function() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("port.frag");
    std::fs::write(&file, PORT_WITH_A_SLIP).unwrap();
    let file = file.to_str().unwrap();
    let asked = |more: &[&str]| {
        let common =
            ["check", file, "--on", "cpu", "--budget", "quick", "--only", "stability", "--no-report"];
        let output = Command::new(BINARY).args(common).args(more).output().unwrap();
        assert_eq!(output.status.code(), Some(1), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    let table = asked(&[]);
    assert!(
        table.starts_with("cause of port.frag in f32: dfdx-twice: the derivative along screen x stands in"),
        "{table}"
    );
    assert!(table.replace("\n    ", " ").contains("; take dFdy for the second derivative"), "{table}");
    let github = asked(&["--format", "github"]);
    let head = format!("::error file={},line=3,col=", file.replace(':', "%3A").replace(',', "%2C"));
    assert!(github.starts_with(&head) && github.contains("::dfdx-twice: "), "{github}");
    let sarif: serde_json::Value = serde_json::from_str(&asked(&["--format", "sarif"])).unwrap();
    let first = &sarif["runs"][0]["results"][0];
    assert_eq!(first["ruleId"], "dfdx-twice");
    assert_eq!(first["locations"][0]["physicalLocation"]["region"]["startLine"], 3);
    assert!(asked(&["--json"]).lines().all(|line| line.ends_with("\"causes\":[\"dfdx-twice\"]}")));
}

#[cfg(unix)]
#[test]
fn the_action_tries_the_shaders_of_a_change_and_no_others() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let git = |arguments: &[&str]| {
        let names = ["-c", "user.name=a", "-c", "user.email=a@example.org"];
        let done =
            Command::new("git").current_dir(folder.path()).args(names).args(arguments).output().unwrap();
        assert!(done.status.success(), "{done:?}");
    };
    git(&["init", "-q"]);
    std::fs::write(at("old.frag"), PORT_WITH_A_SLIP).unwrap();
    git(&["add", "."]);
    git(&["commit", "-qm", "before"]);
    let act = |base: &str| {
        let output = Command::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.ci/action"))
            .current_dir(folder.path())
            .env("HASHED_ALPHA", BINARY)
            .envs([("FILES", ""), ("FUNCTION", "threshold"), ("BASE", base), ("REPORT", "report")])
            .env("ARGUMENTS", "--budget quick --only stability")
            .env("GITHUB_OUTPUT", at("output"))
            .output()
            .unwrap();
        (output.status.code(), String::from_utf8(output.stdout).unwrap())
    };
    std::fs::write(at("notes.txt"), "threshold").unwrap();
    std::fs::write(at("other.frag"), "float x() { return 0.0; }").unwrap();
    git(&["add", "."]);
    git(&["commit", "-qm", "no threshold"]);
    // A shader of another purpose is passed over.
    assert_eq!(act(""), (Some(0), String::new()));
    std::fs::write(at("notes.txt"), "another").unwrap();
    git(&["add", "."]);
    git(&["commit", "-qm", "no shader"]);
    assert_eq!(act(""), (Some(0), "This change touches no shader.\n".to_owned()));
    std::fs::write(at("other.frag"), "float bloom() { return 1.0; }").unwrap();
    std::fs::write(at("new.frag"), PORT_WITH_A_SLIP).unwrap();
    git(&["add", "."]);
    git(&["commit", "-qm", "a threshold"]);
    let (code, text) = act("");
    assert_eq!(code, Some(1), "{text}");
    assert!(text.starts_with("::error file=new.frag,line=3,") && !text.contains("old.frag"), "{text}");
    assert!(at("report/check.sarif").exists() && at("report/index.html").exists());
    assert_eq!(std::fs::read_to_string(at("output")).unwrap(), "tried=false\ntried=false\ntried=true\n");
    // A first push names no commit: nothing is passed over in silence.
    let (code, text) = act(&"0".repeat(40));
    assert_eq!(code, Some(1), "{text}");
    assert!(
        text.starts_with("::notice::") && text.contains("file=old.frag") && text.contains("file=new.frag"),
        "{text}"
    );
}
