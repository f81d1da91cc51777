//! `check`: every claim on every subject that was asked for, judged against what is known.

use super::args::{CheckArgs, Format};
use super::failure::Failure;
use super::subjects::{self, Asked, Place};
use super::{Ending, drivers, growth, known, output, shader_files};
use hashed_alpha::check::cause::{self, Found};
use hashed_alpha::check::claims;
use hashed_alpha::check::diagnosis::diagnoses;
use hashed_alpha::check::growth::Plan;
use hashed_alpha::check::known::{Known, OF_THE_LISTINGS, mark};
use hashed_alpha::check::outcome::worst;
use hashed_alpha::check::{self, Claim, Draw, Outcome, Standing, Subject, Suite};
use hashed_alpha::report::annotations::{self, Written};
use hashed_alpha::report::by_model::by_model;
use hashed_alpha::report::cause::causes;
use hashed_alpha::report::html::Run;
use hashed_alpha::report::{directory, json, text};
use hashed_alpha::shader::spelling::likely;
use indicatif::ProgressBar;
use std::io::Write;
use std::path::Path;
use std::sync::atomic::AtomicU64;

/// Tries the claims, writes the report, then the results.
///
/// Whatever can be wrong with the arguments comes to light before the first claim is tried.
pub fn run(args: &CheckArgs) -> Result<Ending, Failure> {
    let typed = match args.subjects.as_slice() {
        [] if args.literal => &["paper".to_owned()],
        [] => &["robust".to_owned()],
        typed => typed,
    };
    let words: Vec<_> = typed.iter().map(String::as_str).collect();
    shader_files::refuse_strays(&words, &args.shader)?;
    drivers::silence_for(typed, &args.shader);
    let (asked, unread) = if args.keep_going {
        subjects::readable(typed, &args.shader)?
    } else {
        (subjects::subjects(typed, &args.shader)?, 0)
    };
    if asked.is_empty() {
        output::remark("note", "nothing is left to try");
        return Ok(if unread > 0 { Ending::Usage } else { Ending::Consistent });
    }
    let models = under_models(&asked);
    let written_in: Vec<Written> = asked.iter().filter_map(written).collect();
    let (subjects, is_file): (Vec<Subject<'static>>, Vec<bool>) =
        asked.into_iter().map(|asked| (asked.subject, asked.family.is_none())).unzip();
    let claims = chosen_claims(&args.only)?;
    let known = args.expect.as_deref().map(known::read).transpose()?.unwrap_or_default();
    let folder = (!args.no_report).then_some(args.out.as_path());
    folder.map_or(Ok(()), create)?;

    for word in typed.iter().filter(|word| subjects::is_in_rust(word, args.shader.on)) {
        output::remark("note", format_args!("{word} runs on the CPU, in Rust"));
    }
    let reach = args.suite.reach();
    let draw = Draw { seed: args.seed, budget: args.budget, reach, ..Draw::default() };
    if args.until_failure {
        if let format @ (Format::Sarif | Format::Github) = args.written_in() {
            let message = format!("--until-failure writes text or json, not {}", format.name());
            return Err(Failure::Usage(message));
        }
        return growth::run(args, Plan::new(&claims, subjects, draw, args.doublings));
    }
    subjects.iter().zip(&is_file).filter(|(_, is_file)| **is_file).for_each(|(subject, _)| foretell(subject));
    let mut outcomes = tried(&claims, &subjects, &draw);
    for (subject, remark) in subjects.iter().flat_map(|s| s.remarks().into_iter().map(move |r| (s, r))) {
        output::remark("note", format_args!("{}: {remark}", subject.name));
    }

    if args.suite == Suite::Paper {
        mark(&mut outcomes, OF_THE_LISTINGS);
    }
    mark(&mut outcomes, &known);
    let diagnoses = diagnoses(&outcomes, &subjects);
    if let Some(folder) = folder {
        directory::write_report(folder, &outcomes, &diagnoses, &written_in, &this_run(args.seed))?;
        output::remark("note", format_args!("the report is in {}", folder.join("index.html").display()));
    }
    let results = &mut output::results();
    let written = match args.written_in() {
        Format::Json => json::write_json_lines(&outcomes, &diagnoses, &mut *results),
        Format::Sarif => writeln!(results, "{:#}", annotations::sarif(&outcomes, &diagnoses, &written_in)),
        Format::Github => {
            let commands = annotations::github(&diagnoses, &written_in);
            writeln!(results, "{commands}{}", text::summary(&outcomes))
        }
        Format::Text => {
            let mut tables = text::table(&outcomes, &diagnoses, output::takes_colour());
            tables.extend(models.iter().map(|(name, models)| by_model(&outcomes, name, models)));
            // The first line has long left the screen of a terminal.
            if output::is_terminal() {
                tables += &causes(&diagnoses, text::COLUMNS);
            }
            results.write_all(tables.as_bytes())
        }
    };
    written.and_then(|()| results.flush()).map_err(Failure::Output)?;

    explain(&outcomes, &known);
    Ok(match worst(&outcomes) {
        _ if unread > 0 => Ending::Usage,
        Standing::Against => Ending::Rejected,
        Standing::Unanswered => Ending::NoVerdict,
        Standing::Known | Standing::AsExpected | Standing::NotApplicable => Ending::Consistent,
    })
}

/// Where a subject is written.
fn written(asked: &Asked) -> Option<Written> {
    let (path, place) = asked.written.clone()?;
    Some(Written { subject: asked.subject.name.clone(), path, place })
}

/// The names of what was asked for under models of devices, each with the models and what it is called under them.
fn under_models(asked: &[Asked]) -> Vec<(String, Vec<(&'static str, String)>)> {
    let mut found: Vec<(String, Vec<_>)> = Vec::new();
    for Asked { subject, name, place, .. } in asked {
        let &Place::Model(model) = place else { continue };
        let column = (model, subject.name.clone());
        match found.iter_mut().find(|(other, _)| other == name) {
            Some((_, columns)) => columns.push(column),
            None => found.push((name.clone(), vec![column])),
        }
    }
    found
}

fn create(folder: &Path) -> Result<(), Failure> {
    let refused = |source| Failure::File { action: "create", place: folder.display().to_string(), source };
    std::fs::create_dir_all(folder).map_err(refused)
}

/// Describes this run to the readers of the report.
fn this_run(seed: u64) -> Run {
    let typed = std::env::args_os().skip(1).map(|word| word.to_string_lossy().into_owned());
    let command: Vec<_> = std::iter::once("hashed-alpha".to_owned()).chain(typed).collect();
    Run { command: command.join(" "), seed, version: env!("CARGO_PKG_VERSION").to_owned() }
}

/// Picks the claims that were typed, by their identifier or family; all where nothing was.
fn chosen_claims(typed: &[String]) -> Result<Vec<Claim>, Failure> {
    let is_meant = |claim: &Claim, typed: &String| {
        claim.id.strip_prefix(typed.as_str()).is_some_and(|rest| rest.is_empty() || rest.starts_with('.'))
    };
    if let Some(unknown) = typed.iter().find(|typed| !claims::ALL.iter().any(|claim| is_meant(claim, typed)))
    {
        let names: Vec<_> = claims::ALL.iter().map(|claim| claim.id).collect();
        let likely = likely(unknown, &names);
        return Err(Failure::Usage(format!(
            "unknown claim `{unknown}`.{likely} Known are {}",
            names.join(", ")
        )));
    }
    let wanted = |claim: &&Claim| typed.is_empty() || typed.iter().any(|typed| is_meant(claim, typed));
    Ok(claims::ALL.iter().filter(wanted).copied().collect())
}

/// Runs the suite and shows on stderr how far it is: a bar on a terminal, elsewhere a line every ten seconds.
fn tried(claims: &[Claim], subjects: &[Subject<'_>], draw: &Draw) -> Vec<Outcome> {
    let (seed, count, budget) = (draw.seed, subjects.len(), draw.budget.name());
    let counted = |count: usize, what: &str| format!("{count} {what}{}", if count == 1 { "" } else { "s" });
    let (claimed, tried) = (counted(claims.len(), "claim"), counted(count, "subject"));
    let words = format_args!("seed {seed}, budget {budget}, {claimed} on {tried}");
    output::remark("note", words);
    let trials = (claims.len() * count) as u64;
    let bar = ProgressBar::new(trials);
    bar.tick();
    let told = AtomicU64::new(0);
    let outcomes = check::run_claims(claims, subjects, draw, || {
        bar.inc(1);
        let seconds = bar.elapsed().as_secs();
        if bar.is_hidden() && output::is_due(&told, seconds) {
            output::remark("note", format_args!("{} of {trials} trials after {seconds} s", bar.position()));
        }
    });
    bar.finish_and_clear();
    outcomes
}

/// Says on stderr what experiments show of a shader before its claims are tried, which takes longer.
fn foretell(subject: &Subject<'_>) {
    for Found { slip, shown, .. } in cause::examine(subject).found {
        let name = &subject.name;
        output::remark("note", format_args!("{name} so far: {} ({shown}); {}", slip.defect, slip.mend));
    }
}

/// Says on stderr what the exit code rests on.
fn explain(outcomes: &[Outcome], known: &[Known]) {
    for Outcome { check, subject, precision, verdict, .. } in
        outcomes.iter().filter(|outcome| outcome.standing().is_news())
    {
        output::remark("unexpected", format_args!("{check} of {subject} in {precision} is {verdict}"));
    }
    for Known { check, who, .. } in known.iter().filter(|known| known.is_stale(outcomes)) {
        output::remark("stale", format_args!("{check} of {who} is not rejected; take it off the list"));
    }
    let untried = known.iter().filter(|known| !known.was_tried(outcomes)).count();
    if untried > 0 {
        output::remark("note", format_args!("known findings that name nothing which was tried: {untried}"));
    }
}
