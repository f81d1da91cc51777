//! The report page in a real browser.
//!
//! Without Chromium the trials are ignored and say so; with `HASHED_ALPHA_REQUIRE=browser` that is a failure.

use libtest_mimic::{Arguments, Failed, Trial};
use std::path::{Path, PathBuf};
use std::process::Command;
use std::{env, fs};

fn main() {
    let arguments = Arguments::from_args();
    let browser = ["chromium", "chromium-browser", "google-chrome"].into_iter().find_map(in_path);
    let is_required =
        env::var("HASHED_ALPHA_REQUIRE").is_ok_and(|list| list.split(',').any(|item| item == "browser"));
    let trial = match browser {
        Some(browser) => {
            Trial::test("the_report_page_shows_every_claim_and_picture", move || shows_report(&browser))
        }
        None if is_required => Trial::test("the_report_page_shows_every_claim_and_picture", || {
            Err(Failed::from("no Chromium in PATH, and HASHED_ALPHA_REQUIRE asks for a browser"))
        }),
        None => Trial::test("the_report_page_shows_every_claim_and_picture (no Chromium in PATH)", || Ok(()))
            .with_ignored_flag(true),
    };
    libtest_mimic::run(&arguments, vec![trial]).exit();
}

fn in_path(name: &str) -> Option<PathBuf> {
    env::split_paths(&env::var_os("PATH")?).map(|folder| folder.join(name)).find(|path| path.is_file())
}

fn shows_report(browser: &Path) -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let report = folder.path().join("report");
    let output = Command::new(env!("CARGO_BIN_EXE_hashed-alpha"))
        .args(["check", "paper:isotropic", "--json", "--out"])
        .arg(&report)
        .output()?;
    let claims = String::from_utf8(output.stdout)?.lines().count();
    let page = report.join("index.html");
    let screenshot = folder.path().join("page.png");

    let run = |what: &str| {
        Command::new(browser)
            .args(["--headless", "--no-sandbox", "--disable-gpu", "--no-first-run"])
            .args(["--disable-background-networking", "--disable-component-update", "--disable-sync"])
            .args(["--disable-quic", "--window-size=1000,3000", what])
            .arg(format!("--user-data-dir={}", folder.path().join("profile").display()))
            .arg(format!("file://{}", page.display()))
            .output()
    };
    let dom = String::from_utf8(run("--dump-dom")?.stdout)?;
    let pictures = fs::read_dir(&report)?
        .filter_map(Result::ok)
        .filter(|entry| entry.path().extension().is_some_and(|extension| extension == "svg"));
    let pictures: Vec<String> =
        pictures.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    assert!(claims > 8 && pictures.len() > 8, "{claims} claims, {} pictures", pictures.len());
    for picture in &pictures {
        assert!(dom.contains(picture.as_str()), "the page does not show {picture}");
    }
    let rows = dom.matches("<tr").count();
    assert!(rows >= claims, "{rows} rows for {claims} claims");

    run(&format!("--screenshot={}", screenshot.display()))?;
    let png = fs::read(&screenshot)?;
    // A blank page of this size packs into a few kilobytes.
    assert!(png.len() > 50_000, "the screenshot has {} bytes", png.len());
    Ok(())
}
