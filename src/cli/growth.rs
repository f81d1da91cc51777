//! `check --until-failure`: the samples of every claim are doubled until it fails.

use super::args::{CheckArgs, Format};
use super::failure::Failure;
use super::{Ending, output};
use hashed_alpha::check::growth::{End, Plan, Step, grow};
use hashed_alpha::report::directory::write_atomically;
use hashed_alpha::report::growth::{self, Row, StateFile, rows};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::Write;
use std::process;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

/// How often the time and Ctrl-C are looked at.
const TICK: Duration = Duration::from_millis(200);

/// Exit code of a process that Ctrl-C has ended: 128 and the number of the signal.
const INTERRUPTED: i32 = 130;

/// Lets the claims grow until all have ended, the time is up, or Ctrl-C; then says what is known.
///
/// A step that is under way at the end is lost, and taken again when the run is continued.
pub fn run(args: &CheckArgs, plan: Plan<'static>) -> Result<Ending, Failure> {
    let path = args.out.join("growth.jsonl");
    let place = || path.display().to_string();
    let (mut state, mut steps) =
        StateFile::open(&path, &plan).map_err(|source| Failure::State { place: place(), source })?;
    if !steps.is_empty() {
        output::remark("note", format_args!("goes on from the {} steps in {}", steps.len(), place()));
    }
    let interrupted = interruption();
    let plan = Arc::new(plan);
    let told = told_at_start(&plan, args.hours);
    output::remark("note", told);

    let stopped = Arc::new(AtomicBool::new(false));
    let (sender, receiver) = mpsc::channel();
    let begun = Instant::now();
    {
        // Not waited for at the end: a step may take hours.
        let (plan, known, stopped) = (Arc::clone(&plan), steps.clone(), Arc::clone(&stopped));
        std::thread::spawn(move || {
            let hand_over = |step| {
                // Nobody is left to hear of it when the run has ended.
                let _ = sender.send(step);
            };
            grow(&plan, &known, || stopped.load(Ordering::Relaxed), hand_over);
        });
    }
    let until = args.hours.map(|hours| begun + Duration::from_secs_f64(hours * 3600.0));
    let progress = Progress::new(until, begun);
    loop {
        match receiver.recv_timeout(TICK) {
            Ok(step) => {
                state.add(&step, &plan).map_err(|source| Failure::File {
                    action: "write",
                    place: place(),
                    source,
                })?;
                steps.push(step);
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => break,
        }
        progress.tell(&plan, &steps);
        if interrupted.load(Ordering::Relaxed) || until.is_some_and(|until| Instant::now() >= until) {
            break;
        }
    }
    stopped.store(true, Ordering::Relaxed);
    progress.bar.finish_and_clear();
    for (subject, remark) in plan.subjects.iter().flat_map(|s| s.remarks().into_iter().map(move |r| (s, r))) {
        output::remark("note", format_args!("{}: {remark}", subject.name));
    }
    finish(args, &rows(&plan, &steps))
}

/// Writes the figure and the results.
fn finish(args: &CheckArgs, rows: &[Row<'_>]) -> Result<Ending, Failure> {
    let picture = args.out.join("growth.svg");
    write_atomically(&picture, growth::figure(rows).as_bytes())?;
    output::remark("note", format_args!("the figure is {}", picture.display()));
    let results = &mut output::results();
    let written = match args.written_in() {
        Format::Json => growth::write_json_lines(rows, args.seed, &mut *results),
        Format::Text | Format::Sarif | Format::Github => results.write_all(growth::table(rows).as_bytes()),
    };
    written.and_then(|()| results.flush()).map_err(Failure::Output)?;
    let any = |end: End| rows.iter().any(|row| row.end == Some(end));
    let is_known = |row: &Row<'_>| !row.steps.is_empty() && row.end != Some(End::NotApplicable);
    Ok(if any(End::Failed) {
        Ending::Rejected
    } else if any(End::Unavailable) || !rows.iter().any(is_known) {
        Ending::NoVerdict
    } else {
        Ending::Consistent
    })
}

/// Returns what Ctrl-C, or a request to end, sets the first time; the second time it ends the process.
fn interruption() -> Arc<AtomicBool> {
    let interrupted = Arc::new(AtomicBool::new(false));
    let set = Arc::clone(&interrupted);
    let handled = ctrlc::set_handler(move || {
        if set.swap(true, Ordering::Relaxed) {
            process::exit(INTERRUPTED);
        }
    });
    if let Err(error) = handled {
        output::remark("note", format_args!("Ctrl-C ends without the results: {error}"));
    }
    interrupted
}

fn told_at_start(plan: &Plan<'_>, hours: Option<f64>) -> String {
    let (seed, budget) = (plan.draw.seed, plan.draw.budget.name());
    let time =
        hours.map_or("until Ctrl-C at the latest".to_owned(), |hours| format!("for {hours} hours at most"));
    let (claims, subjects) = (plan.claims.len(), plan.subjects.len());
    format!("seed {seed}, budget {budget}, {claims} claims on {subjects} subjects until they fail, {time}")
}

/// How far the run is: a line that is renewed on a terminal, elsewhere a line every ten seconds.
struct Progress {
    bar: ProgressBar,
    told: AtomicU64,
    begun: Instant,
    until: Option<Instant>,
}

impl Progress {
    fn new(until: Option<Instant>, begun: Instant) -> Self {
        let bar = ProgressBar::new_spinner();
        if let Ok(style) = ProgressStyle::with_template("{spinner} {elapsed_precise} {wide_msg}") {
            bar.set_style(style);
        }
        Self { bar, told: AtomicU64::new(0), begun, until }
    }

    fn tell(&self, plan: &Plan<'_>, steps: &[Step]) {
        let seconds = self.begun.elapsed().as_secs();
        let is_hidden = self.bar.is_hidden();
        if is_hidden && !output::is_due(&self.told, seconds) {
            return;
        }
        let rows = rows(plan, steps);
        let left = self.until.map_or(String::new(), |until| {
            let left = until.saturating_duration_since(Instant::now()).as_secs();
            format!("{} min {} s left, ", left / 60, left % 60)
        });
        let words = format!("{left}{} steps; {}", steps.len(), growth::summary(&rows));
        if is_hidden {
            output::remark("note", format_args!("after {seconds} s: {words}"));
        } else {
            self.bar.set_message(words);
            self.bar.tick();
        }
    }
}
