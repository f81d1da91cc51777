//! The smallest change of a user's shader after which no experiment shows a slip and the claims hold. Not in the paper.
//!
//! `syntax` reads the text as expressions, `edits` turns round what ports by hand get wrong, one place at a time. Each change is
//! read again and asked the experiments of [`cause`]; of those after which fewer slips are left the smallest are
//! changed once more. What is left without a slip has to pass every claim that the paper's own listing passes.

mod change;
mod edits;
mod syntax;

use super::cause::{self, Examination, Found};
use super::claims;
use super::results::Results;
use super::shaders;
use super::{Budget, Draw, Subject, Suite, run_claims};
use crate::scene::{Fragment, Scene};
use crate::shader::interpreter::DeviceModel;
use crate::shader::own::{self, Language, Options, OwnShader};
use crate::threshold::two_scale::Variant;
use change::{Change, lines_between};
use edits::{Sheet, Steps};
use rayon::prelude::*;
use std::collections::HashSet;
use std::sync::Mutex;
use syntax::Syntax;

/// Changes that follow each other, at most: as many slips as are told at once, and one that they hide.
const ROUNDS: usize = 3;

/// Changes that are tried together; the smallest that mends is looked for among them.
const TOGETHER: usize = 96;

/// How many times as many are tried once there is one with fewer slips, and none without.
const MORE: usize = 3;

/// Texts with fewer slips of which further changes are tried, in each round.
const KEPT: usize = 4;

/// Texts without a slip on which the claims are tried.
const TRIED: usize = 8;

/// Fragments by whose thresholds two texts are told apart.
const FRAGMENTS: usize = 200;

/// A shader in which something is to be mended.
pub struct Broken<'a> {
    /// Name of the file in messages.
    pub file: &'a str,
    /// GLSL or WGSL.
    pub language: Language,
    /// Its text.
    pub text: &'a str,
    /// What is asked of it.
    pub options: &'a Options,
    /// Which listing it follows.
    pub variant: Variant,
    /// Adds what else it claims of itself.
    pub claiming: &'a (dyn Fn(Subject<'static>) -> Subject<'static> + Sync),
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// No experiment shows a slip.
    Sound,
    /// A text without slips that passes the claims.
    Mended(Mended),
    /// No change was found; with the slips.
    Left(Vec<Found>),
}

/// A text that was mended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Mended {
    /// The text.
    pub text: String,
    /// What was wrong.
    pub found: Vec<Found>,
    /// Lines that are others.
    pub lines: usize,
    /// Whether the function calls one of ours now.
    pub is_replaced: bool,
}

/// A text that was tried.
struct Seen {
    text: String,
    examination: Examination,
    size: (usize, usize),
}

/// Looks for the smallest change. `progress` is told how many texts were read.
#[must_use]
pub fn mend(broken: &Broken<'_>, progress: &(dyn Fn(usize) + Sync)) -> Outcome {
    let Some(subject) = broken.subject(broken.text) else { return Outcome::Left(Vec::new()) };
    let examination = cause::examine(&subject);
    if examination.found.is_empty() && examination.follows {
        return Outcome::Sound;
    }
    let found = examination.found.clone();
    let mut search = Search {
        broken,
        is_explained: examination.is_explained,
        names: found.iter().map(|found| found.slip.name).collect(),
        places: Scene::all()[0].footprints().step_by(997).take(FRAGMENTS).map(Fragment::from).collect(),
        values: Mutex::default(),
        tries: TRIED,
        progress,
    };
    search.is_new(&subject);
    let mut open = vec![Seen { text: broken.text.to_owned(), examination, size: (0, 0) }];
    for _ in 0..ROUNDS {
        match search.round(&open) {
            Ok(text) => {
                let lines = lines_between(broken.text, &text);
                return Outcome::Mended(Mended { text, found, lines, is_replaced: false });
            }
            Err(better) => open = better,
        }
    }
    Outcome::Left(found)
}

impl Broken<'_> {
    fn shader(&self, text: &str) -> Option<OwnShader> {
        own::parse(self.file, self.language, text.as_bytes(), self.options).ok()
    }

    fn of_shader(&self, shader: &OwnShader) -> Option<Subject<'static>> {
        let subject = shaders::interpreted(self.file, shader, DeviceModel::ACCURATE, self.variant).ok()?;
        Some((self.claiming)(subject))
    }

    fn subject(&self, text: &str) -> Option<Subject<'static>> {
        self.of_shader(&self.shader(text)?)
    }

    /// Changes of a text, the smallest first.
    fn changes(&self, text: &str, wrong: Steps) -> Vec<Change> {
        let syntax = Syntax::of(text, self.language == Language::Wgsl);
        let Some(shader) = self.shader(text) else { return Vec::new() };
        let named = |value: &str| {
            let taken = shader.taken.iter().find(|taken| taken.meaning == value).map(|taken| taken.name.clone());
            let name = self.options.map.get(value).cloned().or(taken).unwrap_or_else(|| value.to_owned());
            syntax.has(&self.options.function, &name).then_some(name)
        };
        let sheet = Sheet {
            text,
            syntax: &syntax,
            function: &self.options.function,
            variant: self.variant,
            position: named("position"),
            derivatives: named("dpdx").zip(named("dpdy")).map(|(x, y)| [x, y]),
            hash_scale: named("hash_scale").or_else(|| syntax.hash_scale()),
            wrong,
        };
        let mut all = edits::changes(&sheet);
        all.sort_by_key(Change::size);
        all
    }
}

/// Slips on the way to a scale.
const OF_SCALE: [&str; 20] = [
    "dfdx-twice", "min-for-max", "fwidth", "length-of-sum", "sum-of-lengths", "area-of-a-pixel", "largest-component",
    "derivative-without-z", "hash-scale-ignored", "hash-scale-divides", "squared-length", "one-plus-derivative",
    "missing-sqrt-half", "noise-of-another-size", "half-the-noise", "inverse-scale", "natural-logarithm", "axes-exchanged",
    "other-variant", "no-octaves",
];

/// Slips of the join and behind it.
const OF_JOIN: [&str; 46] = [
    "coarser-for-finer", "octave-skipped", "one-octave-for-both", "coarse-octave-alone", "nearest-octave", "octave-rounded",
    "linear-weight", "weight-of-the-scale", "smoothstep-weight", "second-hash-from-the-first", "weights-that-add-up-to-more",
    "geometric-mean", "weights-swapped", "weight-always-half", "no-cdf", "case-by-lerp-factor", "divisor-without-two",
    "a-without-min", "first-cases-swapped", "last-case-missing", "middle-case-unshifted", "last-case-unmirrored",
    "cdf-of-equal-weights", "inverse-for-cdf", "density-for-cdf", "smoothstep-for-cdf", "cdf-twice", "larger-of-two",
    "product-of-two", "mean-of-two", "sum-that-wraps", "clamped-at-zero", "coarse-steps", "half-precision", "gamma-curve",
    "srgb-curve", "around-a-cutoff", "safe-middle", "clamped-by-255ths", "clamped-below-opaque", "", "", "", "", "", "",
];

/// The steps in which something is wrong: all but the hash where that is not known.
fn wrong(examination: &Examination) -> Steps {
    let mut steps = Steps::default();
    for name in examination.found.iter().map(|found| found.slip.name) {
        let is_of = [OF_SCALE.contains(&name), OF_JOIN.contains(&name)];
        match is_of {
            [true, _] => steps.scale = true,
            [_, true] => steps.join = true,
            [false, false] => steps.hash = true,
        }
    }
    if examination.found.is_empty() { Steps::ALL } else { steps }
}

struct Search<'a> {
    broken: &'a Broken<'a>,
    /// Names of the slips that were found.
    names: Vec<&'static str>,
    /// Whether a way is known to what the text makes of its cells.
    is_explained: bool,
    places: Vec<Fragment>,
    /// Thresholds of the texts that were tried.
    values: Mutex<HashSet<Vec<u64>>>,
    tries: usize,
    progress: &'a (dyn Fn(usize) + Sync),
}

impl Search<'_> {
    /// Whether no text with these thresholds was tried before.
    fn is_new(&self, subject: &Subject<'_>) -> bool {
        let values = subject.thresholds(&self.places);
        let bits = values.into_iter().map(f64::to_bits).collect();
        subject.failure().is_none() && self.values.lock().is_ok_and(|mut seen| seen.insert(bits))
    }

    fn seen(&self, text: String, size: (usize, usize)) -> Option<Seen> {
        use std::sync::atomic::{AtomicU64, Ordering::Relaxed};
        static T: [AtomicU64; 8] = [const { AtomicU64::new(0) }; 8];
        let t = std::time::Instant::now();
        let add = |i: usize, t: std::time::Instant| { T[i].fetch_add(t.elapsed().as_micros() as u64, Relaxed); T[i + 1].fetch_add(1, Relaxed); };
        let subject = self.broken.subject(&text);
        add(0, t);
        let subject = subject?;
        let t = std::time::Instant::now();
        let new = self.is_new(&subject);
        add(2, t);
        let t = std::time::Instant::now();
        let examination = new.then(|| cause::examine_among(&subject, &self.names))?;
        add(4, t);
        if T[5].load(Relaxed) % 200 == 0 { eprintln!("DEBUG T {:?}", T.each_ref().map(|t| t.load(Relaxed))); }
        Some(Seen { text, examination, size })
    }

    /// Tries the changes of some texts: a mended one, or those that are nearer to one.
    fn round(&mut self, open: &[Seen]) -> Result<String, Vec<Seen>> {
        let mut all: Vec<(&Seen, Change, (usize, usize))> = Vec::new();
        for seen in open {
            let changes = self.broken.changes(&seen.text, wrong(&seen.examination)).into_iter();
            all.extend(changes.map(|change| {
                let size = (seen.size.0 + change.lines, seen.size.1 + change.bytes);
                (seen, change, size)
            }));
        }
        all.sort_by_key(|(_, _, size)| *size);
        if std::env::var("V").is_ok() { eprintln!("DEBUG {} changes {:?}", all.len(), [1, 2, 3, 4].map(|n| all.iter().filter(|(_, c, _)| c.lines == n).count())); for s in open { eprintln!("OPEN {:?} {:?}", s.examination.found.iter().map(|f| f.slip.name).collect::<Vec<_>>(), similar_lines(self.broken.text, &s.text)); } if std::env::var("VV").is_ok() { for (s, c, _) in &all { eprintln!("C {:?}", c.edits.iter().map(|e| (&s.text[e.at.clone()], &e.with)).collect::<Vec<_>>()); } } }
        let mut better = Vec::new();
        let mut nearer_after = None;
        for (count, some) in all.chunks(TOGETHER).enumerate() {
            let tried: Vec<Seen> = some
                .par_iter()
                .filter_map(|(seen, change, size)| self.seen(change.applied(&seen.text), *size))
                .collect();
            (self.progress)(some.len());
            for seen in tried {
                let Examination { found, follows, .. } = &seen.examination;
                if found.is_empty() && *follows {
                    if self.tries > 0 && self.passes(&seen.text) {
                        return Ok(seen.text);
                    }
                } else if !found.is_empty() {
                    if self.rank(&seen, open) == Some(0) {
                        nearer_after.get_or_insert(count);
                    }
                    better.push(seen);
                }
            }
            if nearer_after.is_some_and(|first| count > first + MORE) {
                break;
            }
        }
        Err(self.nearer(better, open))
    }

    /// Whether a text has no slip at all and passes the claims.
    fn passes(&mut self, text: &str) -> bool {
        let Some(subject) = self.broken.subject(text) else { return false };
        let examined = cause::examine(&subject);
        if !examined.found.is_empty() || !examined.follows {
            return false;
        }
        self.tries -= 1;
        passes(&subject)
    }

    /// How much nearer a text is than those that it was made of: with fewer slips and no new one first, then with fewer, then with
    /// others.
    fn rank(&self, seen: &Seen, open: &[Seen]) -> Option<usize> {
        let before = open.iter().map(|seen| seen.examination.found.len()).min().unwrap_or(0);
        let names: Vec<&str> = seen.examination.found.iter().map(|found| found.slip.name).collect();
        let is_known = names.iter().all(|name| self.names.contains(name));
        if !seen.examination.is_explained && self.is_explained {
            return None;
        }
        let is_gone = self.names.iter().any(|name| !names.contains(name));
        match (names.len() < before, is_known) {
            (true, true) => Some(0),
            (true, false) => Some(1),
            (false, false) if names.len() == before && is_gone => Some(2),
            (false, _) => None,
        }
    }

    /// The smallest texts with the fewest slips.
    fn nearer(&self, better: Vec<Seen>, open: &[Seen]) -> Vec<Seen> {
        let mut ranked: Vec<(usize, Seen)> =
            better.into_iter().filter_map(|seen| Some((self.rank(&seen, open)?, seen))).collect();
        ranked.sort_by_key(|(rank, seen)| (*rank, seen.examination.found.len(), seen.size));
        let mut kept: Vec<Seen> = Vec::new();
        for (_, seen) in ranked {
            let names = |seen: &Seen| -> Vec<&str> { seen.examination.found.iter().map(|f| f.slip.name).collect() };
            let same = kept.iter().filter(|other| names(other) == names(&seen)).count();
            if kept.len() < KEPT && same < 2 {
                kept.push(seen);
            }
        }
        kept
    }
}

/// Whether nothing speaks against a subject that the paper's own listing is not known for.
#[must_use]
pub fn passes(subject: &Subject<'_>) -> bool {
    let draw = Draw { budget: Budget::Quick, reach: Suite::Paper.reach(), ..Draw::default() };
    let outcomes = run_claims(claims::ALL, core::slice::from_ref(subject), &draw, || {});
    Results::new(outcomes, Suite::Paper).is_consistent()
}

fn similar_lines(a: &str, b: &str) -> Vec<String> { let a: Vec<_> = a.lines().collect(); b.lines().filter(|l| !a.contains(l)).map(str::to_owned).collect() }
