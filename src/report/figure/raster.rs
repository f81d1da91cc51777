//! A grid of coloured squares as SVG, one path a colour: a tenth of the size of one rectangle a square.

use super::style::hex;
use plotters::style::RGBColor;
use std::fmt::Write as _;

/// A grid of squares, each of one of few colours.
pub(super) struct Raster<'a> {
    /// Left edge, top edge, in units of the picture.
    pub corner: [i32; 2],
    /// Width and height of the whole, in units of the picture.
    pub size: [i32; 2],
    /// Squares in a row.
    pub columns: usize,
    /// Index into `palette` of every square, row by row from the top; squares past its end are left out.
    pub levels: &'a [usize],
    /// The colours.
    pub palette: &'a [RGBColor],
}

impl Raster<'_> {
    /// Returns the grid as one group; equal neighbours in a row are one rectangle.
    pub fn svg(&self) -> String {
        let rows = self.levels.len().div_ceil(self.columns.max(1)).max(1);
        let mut paths = vec![String::new(); self.palette.len()];
        for (y, row) in self.levels.chunks(self.columns.max(1)).enumerate() {
            let mut x = 0;
            for run in row.chunk_by(|a, b| a == b) {
                if let Some(path) = paths.get_mut(run[0]) {
                    write!(path, "M{x} {y}h{length}v1h-{length}z", length = run.len()).expect(IN_MEMORY);
                }
                x += run.len();
            }
        }
        let [left, top] = self.corner;
        let scale = |size: i32, cells: usize| f64::from(size) / cells as f64;
        let (across, down) = (scale(self.size[0], self.columns.max(1)), scale(self.size[1], rows));
        let mut svg = format!(
            "<g transform=\"translate({left} {top}) scale({across:.5} {down:.5})\" shape-rendering=\"crispEdges\">\n"
        );
        for (path, &colour) in paths.iter().zip(self.palette).filter(|(path, _)| !path.is_empty()) {
            writeln!(svg, "<path fill=\"{}\" d=\"{path}\"/>", hex(colour)).expect(IN_MEMORY);
        }
        svg.push_str("</g>\n");
        svg
    }
}

const IN_MEMORY: &str = "writing into memory cannot fail";

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn equal_neighbours_become_one_run() {
        let palette = [RGBColor(0, 0, 0), RGBColor(255, 255, 255)];
        let levels = [0, 0, 0, 1, 1, 0, 9, 0];
        let svg =
            Raster { corner: [5, 6], size: [8, 4], columns: 4, levels: &levels, palette: &palette }.svg();
        assert!(svg.contains("translate(5 6) scale(2.00000 2.00000)"), "{svg}");
        assert!(svg.contains("fill=\"#000000\" d=\"M0 0h3v1h-3zM1 1h1v1h-1zM3 1h1v1h-1z\""), "{svg}");
        assert!(svg.contains("fill=\"#ffffff\" d=\"M3 0h1v1h-1zM0 1h1v1h-1z\""), "{svg}");
    }
}
