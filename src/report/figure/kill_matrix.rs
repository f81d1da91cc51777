//! Which claims reject which specimens, as a table of squares.

use super::raster::Raster;
use super::style::{
    BLUE, GRID, Key, LEGEND_ROW, TITLE_STRIP, VERMILLION, WIDTH, legend, on_top, picture, plain,
};
use plotters::style::FontTransform;
use plotters::style::text_anchor::{HPos, VPos};

/// What one claim says of one specimen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kill {
    /// It is not rejected.
    None,
    /// It is rejected.
    Rejected,
    /// It is rejected by the claim that the specimen names.
    Named,
}

/// One specimen and what the claims say of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct KillRow {
    /// Name of the specimen.
    pub name: String,
    /// One entry a claim.
    pub kills: Vec<Kill>,
}

/// Height of a row, in units of the picture.
const ROW: i32 = 30;
/// Room for the names of specimens, and for those of claims.
const NAMES: [i32; 2] = [470, 380];
const TEXT: i32 = 24;
const MARGIN: i32 = 30;

/// Draws the table: a row a specimen, a column a claim.
#[must_use]
pub fn kill_matrix(title: &str, claims: &[&str], rows: &[KillRow]) -> String {
    let entries = [
        (Key::Field(VERMILLION), "rejected by the claim that it was made for"),
        (Key::Field(BLUE), "rejected"),
    ];
    let width = (WIDTH as i32 - NAMES[0] - MARGIN) / claims.len().max(1) as i32;
    let top = LEGEND_ROW + NAMES[1];
    let height = ROW * rows.len() as i32;
    let frame = picture(title, TITLE_STRIP + top + height + MARGIN, |area| {
        legend(&area.split_vertically(LEGEND_ROW).0.margin(0, 0, MARGIN, MARGIN), &entries)?;
        for (row, KillRow { name, .. }) in rows.iter().enumerate() {
            let at = (NAMES[0] - 12, top + ROW * row as i32 + ROW / 2);
            area.draw_text(name, &plain(TEXT, HPos::Right, VPos::Center), at)?;
        }
        let upwards = plain(TEXT, HPos::Left, VPos::Center).transform(FontTransform::Rotate270);
        for (column, claim) in claims.iter().enumerate() {
            area.draw_text(claim, &upwards, (NAMES[0] + width * column as i32 + width / 2, top - 12))?;
        }
        Ok(())
    });
    // Every other row and column is shaded, so that the eye finds its way.
    let palette = [VERMILLION, BLUE, GRID];
    let level = |row: usize, column: usize, kill: &Kill| match kill {
        Kill::Named => 0,
        Kill::Rejected => 1,
        Kill::None if row.is_multiple_of(2) || column.is_multiple_of(2) => 2,
        Kill::None => palette.len(),
    };
    let levels: Vec<usize> = rows
        .iter()
        .enumerate()
        .flat_map(|(row, of)| of.kills.iter().enumerate().map(move |(column, kill)| level(row, column, kill)))
        .collect();
    let corner = [NAMES[0], TITLE_STRIP + top];
    let size = [width * claims.len() as i32, height];
    let squares = Raster { corner, size, columns: claims.len(), levels: &levels, palette: &palette };
    on_top(frame, &squares.svg())
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn every_row_and_column_has_its_name() {
        let rows = [KillRow { name: "no-cdf".to_owned(), kills: vec![Kill::Named, Kill::None] }];
        let svg = kill_matrix("matrix", &["uniform.by_lerp_factor", "range"], &rows);
        is_sound(&svg, &["no-cdf", "uniform.by_lerp_factor", "range"]);
        is_sound(&kill_matrix("nothing", &[], &[]), &["nothing"]);
    }
}
