//! The table of GDC 2017 ("Key: Coordinate Choice For Hash Input"), measured; it is kept in `docs/coordinates.md`, which
//! `HASHED_ALPHA_BLESS=all cargo test --test main coordinates::` writes anew.

use hashed_alpha::check::Draw;
use hashed_alpha::check::coordinates::{Coordinates, Stated, TableCell, table};
use hashed_alpha::check::input::motion::Motion;
use std::fmt::Write as _;
use std::path::Path;

/// What the slides print in a cell.
fn mark(stated: Stated) -> &'static str {
    match stated {
        Stated::Stable => "✓",
        Stated::Generous => "✓*",
        Stated::Unstable => "✗",
        Stated::BeforeDeformation => "?",
    }
}

fn page(entries: &[TableCell]) -> String {
    let mut page = "# In which coordinates to hash\n\n\
        The table of GDC 2017 (\"Key: Coordinate Choice For Hash Input\"), measured: a point of a surface is followed over \
        one\nframe of a motion, and its threshold is asked for before and after, hashed in each kind of coordinates with the\n\
        derivatives of those coordinates. A cell holds what the slides say and the share of points that keep their \
        threshold but\nfor what the change of its scale explains. A `?` of the slides is about coordinates that are \
        hashed before the deformation,\nas here; after it they are those of the world.\n\n\
        The marks with a star (\"somewhat generous\") do not hold for a camera that moves by a few pixels: another pixel is\n\
        another cell. All others do. Written by `HASHED_ALPHA_BLESS=all cargo test --test main coordinates::`.\n\n|"
        .to_owned();
    for motion in Motion::ALL {
        write!(page, " | {}", motion.name()).expect("writing into memory cannot fail");
    }
    page.push_str(" |\n|---|---|---|---|---|---|---|\n");
    for (coordinates, row) in Coordinates::ALL.iter().zip(entries.chunks(Motion::ALL.len())) {
        write!(page, "| {}", coordinates.name()).expect("writing into memory cannot fail");
        for entry in row {
            write!(page, " | {} {:.1} %", mark(entry.stated), 100.0 * entry.kept)
                .expect("writing into memory cannot fail");
        }
        page.push_str(" |\n");
    }
    page
}

/// Every cell of the slides holds but the three with a star: a camera that moves takes each point to another pixel, so
/// what is hashed by eye, device or screen coordinates is drawn anew.
#[test]
fn the_table_of_the_slides_is_confirmed_but_for_its_stars() {
    let entries = table(&Draw::default());
    for entry in &entries {
        assert!(entry.points > 1000, "{entry:?}");
        assert_eq!(entry.is_confirmed(), entry.stated != Stated::Generous, "{entry:?}");
    }
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/coordinates.md");
    if std::env::var_os("HASHED_ALPHA_BLESS").is_some() {
        std::fs::write(&path, page(&entries)).expect("the page can be written");
    }
    let committed = std::fs::read_to_string(&path).expect("docs/coordinates.md is there");
    assert_eq!(committed, page(&entries), "HASHED_ALPHA_BLESS=all cargo test --test main coordinates::");
}
