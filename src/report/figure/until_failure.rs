//! How many samples it takes until a claim fails: one bar a claim.

use super::style::{
    Axis, BAND, BLUE, Drawn, Key, LABEL_SIZE, TICK_SIZE, TITLE_STRIP, VERMILLION, WIDTH, block, chart,
    legend, legend_height, picture, plain, shorten,
};
use plotters::style::text_anchor::{HPos, VPos};

/// Room for the names of claims.
const NAMES: i32 = 620;
/// Height of a bar and the gap after it.
const ROW: i32 = 44;
/// Part of a row that is a bar.
const BAR: f64 = 0.62;
/// Room above a chart without a title.
const TOP: i32 = 18;

/// One claim.
#[derive(Clone, Debug, PartialEq)]
pub struct FailureBar {
    /// Its name, with that of the subject where there are several.
    pub name: String,
    /// Logarithm to base two of the samples at which it failed, or up to which it held.
    pub log2_n: f64,
    /// Whether it failed.
    pub failed: bool,
    /// Whether it can have no more samples.
    pub full: bool,
}

/// Draws the bars from top to bottom: failed ones end, those that held go on as far as the picture does, in a paler colour.
#[must_use]
pub fn until_failure(title: &str, bars: &[FailureBar]) -> String {
    let entries = [
        (Key::Field(VERMILLION), "fails"),
        (Key::Field(BLUE), "holds so far"),
        (Key::Field(BAND), "not tried"),
        (Key::Note, "a bar with a stroke at its end can have no more samples"),
    ];
    let last = bars.iter().map(|bar| bar.log2_n).fold(8.0, f64::max);
    let end = last.ceil() + 2.0;
    let x = Axis::new("samples [log2]", 0.0..end, 12);
    let y = Axis { numbered: false, ..Axis::new("", 0.0..bars.len().max(1) as f64, 1) };
    let strip = legend_height(&entries, WIDTH as i32 - 120);
    let rows = ROW * bars.len().max(1) as i32;
    picture(title, TITLE_STRIP + strip + TOP + rows + x.bottom_room(), |area| {
        let (top, body) = area.split_vertically(strip);
        legend(&top.margin(0, 0, 60, 20), &entries)?;
        let (names, right) = body.split_horizontally(NAMES);
        let mut chart = chart(&right, "", &x, &y)?;
        bars.iter().enumerate().try_for_each(|(index, bar)| -> Drawn {
            let middle = TOP + ROW * index as i32 + ROW / 2;
            let name = shorten(&bar.name, TICK_SIZE, NAMES - 30);
            names.draw_text(&name, &plain(TICK_SIZE, HPos::Right, VPos::Center), (NAMES - 10, middle))?;
            let centre = (bars.len() - index) as f64 - 0.5;
            let (low, high) = (centre - BAR / 2.0, centre + BAR / 2.0);
            let colour = if bar.failed { VERMILLION } else { BLUE };
            if !bar.failed {
                block(&mut chart, [(bar.log2_n, low), (end, high)], BAND)?;
            }
            block(&mut chart, [(0.0, low), (bar.log2_n, high)], colour)?;
            if bar.full {
                block(&mut chart, [(bar.log2_n, centre - 0.45), (bar.log2_n + 0.06, centre + 0.45)], colour)?;
            }
            Ok(())
        })?;
        if bars.is_empty() {
            let style = plain(LABEL_SIZE, HPos::Center, VPos::Center);
            names.draw_text("no claim", &style, (NAMES / 2, TOP + ROW / 2))?;
        }
        Ok(())
    })
}

#[cfg(test)]
mod tests {
    use super::super::style::tests::is_sound;
    use super::*;

    #[test]
    fn every_claim_has_a_bar() {
        let bar =
            |name: &str, log2_n, failed| FailureBar { name: name.to_owned(), log2_n, failed, full: !failed };
        let bars = [bar("hash.values", 18.0, true), bar("hash.children", 27.5, false)];
        let svg = until_failure("until failure", &bars);
        is_sound(&svg, &["hash.values", "hash.children", "samples [log2]", "holds so far"]);
        assert_eq!(svg, until_failure("until failure", &bars));
        is_sound(&until_failure("nothing", &[]), &["nothing", "no claim"]);
    }
}
