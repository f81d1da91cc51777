//! Footprints as comma-separated text, read and written line by line in constant memory.

use hashed_alpha::threshold::footprint::Footprint;
use hashed_alpha::threshold::real::Real;
use std::io::{self, BufRead, BufReader, Read, Write};
use std::marker::PhantomData;

/// The columns of a row, in order.
pub const COLUMNS: [&str; 9] = ["px", "py", "pz", "dxx", "dxy", "dxz", "dyx", "dyy", "dyz"];

/// The longest line that is read, in bytes: a file without line ends must not fill the memory.
const LONGEST_LINE: usize = 1 << 20;

/// The longest piece of input that a message repeats, in characters.
const LONGEST_QUOTE: usize = 40;

/// Why there are no more rows.
#[derive(Debug, thiserror::Error)]
pub enum RowError {
    /// The input cannot be read.
    #[error("cannot read line {line} of {place}")]
    Input {
        /// The name of the input.
        place: String,
        /// Number of the line, from 1.
        line: u64,
        /// What the system says.
        source: io::Error,
    },
    /// A row is not a footprint.
    #[error("{place}, line {line}{}: {problem}", column_phrase(*.column))]
    Row {
        /// The name of the input.
        place: String,
        /// Number of the line, from 1.
        line: u64,
        /// Index into [`COLUMNS`], where one field is to blame.
        column: Option<usize>,
        /// What is wrong with it.
        problem: Problem,
    },
}

/// What can be wrong with a row. Text that was read is shortened and made harmless to a terminal.
#[derive(Debug, PartialEq, thiserror::Error)]
pub enum Problem {
    #[error("longer than {LONGEST_LINE} bytes; write one footprint a line")]
    TooLong,
    #[error("9 fields are needed, not {found}; write {}", COLUMNS.join(","))]
    FieldCount { found: usize },
    #[error("`{text}` is no name of the header; it reads {}, or is left out", COLUMNS.join(","))]
    Header { text: String },
    #[error("`{text}` is not UTF-8 text; save the file as UTF-8")]
    NotUtf8 { text: String },
    #[error("`{text}` is not a number; write it like 0.25 or 1e-3")]
    NotANumber { text: String },
    #[error("`{text}` is not finite in {precision}; write a finite number or leave the row out")]
    NotFinite { text: String, precision: &'static str },
}

fn column_phrase(column: Option<usize>) -> String {
    column.map(|index| format!(", column {} ({})", index + 1, COLUMNS[index])).unwrap_or_default()
}

/// An iterator over the footprints of a text.
///
/// Spaces around fields, double quotes around a field, CRLF, a byte order mark, empty lines and lines that start with
/// `#` are all accepted. A first row whose first field is not a number is taken for a header.
pub struct Rows<I, R> {
    input: BufReader<I>,
    place: String,
    line: Vec<u8>,
    line_number: u64,
    at_first_row: bool,
    precision: PhantomData<R>,
}

impl<I: Read, R: Real> Rows<I, R> {
    /// Reads `input`, which messages call `place`.
    pub fn new(input: I, place: String) -> Self {
        let input = BufReader::with_capacity(1 << 16, input);
        Self { input, place, line: Vec::new(), line_number: 0, at_first_row: true, precision: PhantomData }
    }

    /// Tells whether everything that has arrived is read, so that the next row may be a long time in coming.
    pub fn may_wait(&self) -> bool {
        self.input.buffer().is_empty()
    }

    fn next_row(&mut self) -> Result<Option<Footprint<R>>, RowError> {
        while self.next_line()? {
            let text = self.line.trim_ascii();
            if text.is_empty() || text.starts_with(b"#") {
                continue;
            }
            let is_first = std::mem::replace(&mut self.at_first_row, false);
            match parse_row(text, is_first) {
                Ok(Some(row)) => return Ok(Some(row)),
                Ok(None) => {}
                Err((column, problem)) => return Err(self.error(column, problem)),
            }
        }
        Ok(None)
    }

    /// Reads one line; returns false at the end of the input.
    fn next_line(&mut self) -> Result<bool, RowError> {
        self.line.clear();
        let limit = LONGEST_LINE as u64 + 1;
        let read = self.input.by_ref().take(limit).read_until(b'\n', &mut self.line);
        self.line_number += 1;
        let length = read.map_err(|source| RowError::Input {
            place: self.place.clone(),
            line: self.line_number,
            source,
        })?;
        if length > LONGEST_LINE {
            return Err(self.error(None, Problem::TooLong));
        }
        if self.line_number == 1 && self.line.starts_with(b"\xef\xbb\xbf") {
            self.line.drain(..3);
        }
        Ok(length > 0)
    }

    fn error(&self, column: Option<usize>, problem: Problem) -> RowError {
        RowError::Row { place: self.place.clone(), line: self.line_number, column, problem }
    }
}

impl<I: Read, R: Real> Iterator for Rows<I, R> {
    type Item = Result<Footprint<R>, RowError>;

    fn next(&mut self) -> Option<Self::Item> {
        self.next_row().transpose()
    }
}

/// Reads the nine fields of a row; `None` is the header, which only the first row can be.
fn parse_row<R: Real>(text: &[u8], is_first: bool) -> Result<Option<Footprint<R>>, (Option<usize>, Problem)> {
    let mut fields = [&b""[..]; COLUMNS.len()];
    let mut found = 0;
    for field in text.split(|&byte| byte == b',') {
        if let Some(slot) = fields.get_mut(found) {
            *slot = unquote(field.trim_ascii());
        }
        found += 1;
    }
    if found != COLUMNS.len() {
        return Err((None, Problem::FieldCount { found }));
    }
    if is_first && matches!(parse_number::<R>(fields[0]), Err(Problem::NotANumber { .. })) {
        return match (0..COLUMNS.len()).find(|&column| fields[column] != COLUMNS[column].as_bytes()) {
            Some(column) => Err((Some(column), Problem::Header { text: quote(fields[column]) })),
            None => Ok(None),
        };
    }
    let mut numbers = [R::default(); COLUMNS.len()];
    for (column, field) in fields.into_iter().enumerate() {
        numbers[column] = parse_number(field).map_err(|problem| (Some(column), problem))?;
    }
    let [px, py, pz, dxx, dxy, dxz, dyx, dyy, dyz] = numbers;
    Ok(Some(Footprint {
        position: [px, py, pz].into(),
        dpdx: [dxx, dxy, dxz].into(),
        dpdy: [dyx, dyy, dyz].into(),
    }))
}

/// Reads decimal text straight into `R`: by way of `f64` it would be rounded twice.
fn parse_number<R: Real>(field: &[u8]) -> Result<R, Problem> {
    let text = str::from_utf8(field).map_err(|_| Problem::NotUtf8 { text: quote(field) })?;
    let number: R = text.parse().map_err(|_| Problem::NotANumber { text: quote(field) })?;
    if number.is_finite() {
        Ok(number)
    } else {
        Err(Problem::NotFinite { text: quote(field), precision: R::NAME })
    }
}

fn unquote(field: &[u8]) -> &[u8] {
    field.strip_prefix(b"\"").and_then(|rest| rest.strip_suffix(b"\"")).map_or(field, <[u8]>::trim_ascii)
}

/// Shortens a piece of input for a message and escapes its control characters.
fn quote(field: &[u8]) -> String {
    // A character has at most four bytes, so that the cut leaves enough of them.
    let text = String::from_utf8_lossy(&field[..field.len().min(4 * LONGEST_QUOTE + 4)]);
    let mut quoted = String::new();
    for (index, character) in text.chars().enumerate() {
        if index == LONGEST_QUOTE {
            quoted.push_str("...");
            break;
        } else if character.is_control() {
            quoted.extend(character.escape_default());
        } else {
            quoted.push(character);
        }
    }
    quoted
}

/// Writes the names of the columns.
pub fn write_header(output: &mut impl Write) -> io::Result<()> {
    writeln!(output, "{}", COLUMNS.join(","))
}

/// Writes a footprint as a row that reads back to the same bits.
pub fn write_row<R: Real>(output: &mut impl Write, footprint: &Footprint<R>) -> io::Result<()> {
    let vectors = [footprint.position, footprint.dpdx, footprint.dpdy];
    write_fields(output, vectors.into_iter().flat_map(Into::<[R; 3]>::into))
}

/// Writes one line of fields, numbers in the shortest form that reads back to the same bits.
pub fn write_fields<F: std::fmt::Debug>(
    output: &mut impl Write,
    fields: impl IntoIterator<Item = F>,
) -> io::Result<()> {
    for (index, field) in fields.into_iter().enumerate() {
        let separator = if index == 0 { "" } else { "," };
        write!(output, "{separator}{field:?}")?;
    }
    writeln!(output)
}

#[cfg(test)]
mod tests {
    use super::*;

    const ROW: &str = "0.25,-1.5,2,0.5,0,0,0,0.5,1e-3";

    fn read(text: &[u8]) -> Result<Vec<[f32; 3]>, String> {
        Rows::<_, f32>::new(text, "rows.csv".to_owned())
            .map(|row| row.map(|footprint| footprint.position.into()).map_err(|error| error.to_string()))
            .collect()
    }

    #[test]
    fn a_row_is_a_position_and_two_derivatives() {
        let mut rows = Rows::<_, f64>::new(ROW.as_bytes(), String::new());
        let footprint = rows.next().unwrap().unwrap();
        assert_eq!(footprint.position, glam::dvec3(0.25, -1.5, 2.0));
        assert_eq!(footprint.dpdx, glam::dvec3(0.5, 0.0, 0.0));
        assert_eq!(footprint.dpdy, glam::dvec3(0.0, 0.5, 1.0e-3));
        assert!(rows.next().is_none());
    }

    #[test]
    fn layout_does_not_matter() {
        let header = COLUMNS.join(",");
        let quoted_header = format!("\"{}\"", COLUMNS.join("\",\""));
        for text in [
            ROW.to_owned(),
            format!("{ROW}\n"),
            format!("{header}\n{ROW}\n"),
            format!("\u{feff}{quoted_header}\r\n{ROW}\r\n"),
            format!("# a remark\n\n  {header}\n \t\n{ROW}\n# another\n"),
            format!("  {}  ", ROW.replace(',', " ,\t")),
        ] {
            assert_eq!(read(text.as_bytes()), Ok(vec![[0.25, -1.5, 2.0]]), "{text}");
        }
        assert_eq!(read(b""), Ok(vec![]));
        assert_eq!(read(header.as_bytes()), Ok(vec![]));
    }

    #[test]
    fn decimal_text_is_rounded_once() {
        // Just above half way between two values of f32; f64 rounds it down to the middle, and f32 then to even.
        let text = ROW.replacen("0.25", "1.00000005960464477540", 1);
        assert_eq!(read(text.as_bytes()).unwrap()[0][0], 1.0 + f32::EPSILON);
    }

    #[test]
    fn a_bad_row_names_its_place_and_the_way_out() {
        let row_with =
            |field: &str| format!("# one\n{ROW}\n{}\n", ROW.replacen("0.5", field, 1)).into_bytes();
        for (text, expected) in [
            (row_with("abc"), "line 3, column 4 (dxx): `abc` is not a number; write it like 0.25 or 1e-3"),
            (row_with(""), "line 3, column 4 (dxx): `` is not a number; write it like 0.25 or 1e-3"),
            (row_with("nan"), "line 3, column 4 (dxx): `nan` is not finite in f32"),
            (row_with("-1e39"), "line 3, column 4 (dxx): `-1e39` is not finite in f32"),
            (row_with("\u{1b}[2J"), "line 3, column 4 (dxx): `\\u{1b}[2J` is not a number"),
            (row_with("1,2"), "line 3: 9 fields are needed, not 10; write px,py,pz,dxx,dxy,dxz,dyx,dyy,dyz"),
            (b"1;2;3".to_vec(), "line 1: 9 fields are needed, not 1; write px"),
            (
                b"px,py,z,a,b,c,d,e,f".to_vec(),
                "line 1, column 3 (pz): `z` is no name of the header; it reads px",
            ),
            (b"0,0,\xff,0,0,0,0,0,0".to_vec(), "line 1, column 3 (pz): `\u{fffd}` is not UTF-8 text"),
        ] {
            let error = read(&text).unwrap_err();
            assert!(error.starts_with(&format!("rows.csv, {expected}")), "{error}");
        }
    }

    #[test]
    fn a_header_stands_in_the_first_row_only() {
        let text = format!("{ROW}\n{}\n", COLUMNS.join(","));
        assert!(read(text.as_bytes()).unwrap_err().contains("line 2, column 1 (px): `px` is not a number"));
    }

    #[test]
    fn long_input_is_neither_kept_nor_repeated() {
        let endless = Rows::<_, f32>::new(std::io::repeat(b'1'), "pipe".to_owned()).next().unwrap();
        assert!(endless.unwrap_err().to_string().starts_with("pipe, line 1: longer than 1048576 bytes"));
        let error = read(ROW.replacen("0.25", &"é".repeat(500_000), 1).as_bytes()).unwrap_err();
        assert!(error.contains(&format!("`{}...`", "é".repeat(LONGEST_QUOTE))), "{error}");
    }

    #[test]
    fn a_row_reads_back_to_the_same_bits() {
        let footprint = Footprint::<f32> {
            position: glam::vec3(0.1, -1.0e-30, 3.0e20),
            dpdx: glam::vec3(-0.0, f32::MIN_POSITIVE, f32::MAX),
            dpdy: glam::vec3(1.0 / 3.0, 7.0, 1.0e-45),
        };
        let mut text = Vec::new();
        write_header(&mut text).unwrap();
        write_row(&mut text, &footprint).unwrap();
        assert!(text.len() < 150, "{}", String::from_utf8_lossy(&text));
        let back = Rows::<_, f32>::new(text.as_slice(), String::new()).next().unwrap().unwrap();
        assert_eq!(back, footprint);
    }
}
