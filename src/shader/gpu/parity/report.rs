//! What one device makes of every stage.

use super::{Agreement, Class, stages};
use crate::shader::gpu::{Device, Error};
use core::fmt;

/// One line of a report.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// The stage.
    pub stage: &'static str,
    /// What is owed there.
    pub class: Class,
    /// How far the device agrees.
    pub agreement: Agreement,
    /// The words of the input with the greatest distance in units in the last place; empty where all bits are equal.
    pub worst_input: Vec<u32>,
}

/// Every stage that has values to compare, in the order of a threshold.
#[derive(Clone, Debug, PartialEq)]
pub struct Report {
    /// The name of the device.
    pub adapter: String,
    /// One a stage; those of [`Class::Law`] share no value and are left out.
    pub rows: Vec<Row>,
}

impl Report {
    /// Runs every stage over `count` inputs.
    ///
    /// # Errors
    ///
    /// Those of [`Program::map`](crate::shader::gpu::Program::map).
    pub fn of(device: &Device, count: u32) -> Result<Self, Error> {
        let mut rows = Vec::new();
        for stage in stages().filter(|stage| stage.class != Class::Law) {
            let outputs = stage.outputs(device, &stage.kernel()?, count)?;
            let agreement = stage.agreement(&outputs);
            let worst_input = agreement.worst_input.map_or_else(Vec::new, |input| {
                outputs.inputs.chunks(stage.words[0]).nth(input).unwrap_or_default().to_vec()
            });
            rows.push(Row { stage: stage.name, class: stage.class, agreement, worst_input });
        }
        Ok(Self { adapter: device.name().to_owned(), rows })
    }

    /// Returns the first stage with a difference; `None` where every bit is equal. Each stage is fed by Rust, so this is
    /// where a difference of a whole threshold starts.
    #[must_use]
    pub fn first_difference(&self) -> Option<&Row> {
        self.rows.iter().find(|row| row.agreement.equal < 1.0)
    }
}

impl fmt::Display for Report {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.adapter)?;
        for Row { stage, class, agreement, worst_input } in &self.rows {
            let class = match class {
                Class::Bits => "bits",
                Class::Bounded { .. } => "bounded",
                Class::Law => "law",
            };
            write!(f, "  {stage:42} {class:8} {:8.4} % equal", 100.0 * agreement.equal)?;
            if !worst_input.is_empty() {
                let Agreement { worst_ulp, worst_absolute, .. } = agreement;
                write!(f, ", worst {worst_ulp} ULP at {worst_input:08x?}, {worst_absolute:.1e} absolute")?;
            }
            writeln!(f, "{}", if agreement.violation.is_some() { ", BEYOND ITS BOUND" } else { "" })?;
        }
        match self.first_difference() {
            Some(row) => write!(f, "  differences start at: {}", row.stage),
            None => write!(f, "  no difference"),
        }
    }
}
