//! The smallest change of a user's shader after which no experiment shows a slip and the claims hold. Not in the paper.
//!
//! `syntax` reads the text as expressions, `edits` turns round what ports by hand get wrong, one place at a time. Each change is
//! read again and asked the experiments of [`cause`]; of those after which fewer slips are left the smallest are
//! changed once more. What is left without a slip has to pass every claim that the paper's own listing passes.

mod change;
mod edits;
mod ours;
mod syntax;

use super::cause::{self, Examination, Found, Step};
use super::claims;
use super::results::Results;
use super::shaders;
use super::{Budget, Claim, Draw, Subject, Suite, run_claims};
use crate::scene::Fragment;
use crate::shader::interpreter::DeviceModel;
use crate::shader::own::{self, Language, Options, OwnShader};
use crate::stats::seed;
use crate::threshold::footprint::Footprint;
use crate::threshold::two_scale::Variant;
use change::{Change, lines_between};
use edits::{Sheet, Steps};
use glam::{DVec2, DVec3};
use rayon::prelude::*;
use std::collections::HashSet;
use syntax::Syntax;

/// Changes that follow each other, at most: as many slips as are told at once, and one that they hide.
const ROUNDS: usize = 3;

/// Changes that are tried together; the smallest that mends is looked for among them.
const TOGETHER: usize = 96;

/// How often as many are tried once there is one with fewer slips, and none without.
const SOON: usize = 2;

/// The same where all of them are without the same slip.
const LATE: usize = 16;

/// Texts with fewer slips of which further changes are tried, in each round.
const KEPT: usize = 4;

/// Those of them with the same slips.
const ALIKE: usize = 2;

/// Texts without a slip on which the claims are tried.
const TRIED: usize = 6;

/// As many texts against which the same claims speak end the trials.
const AGAIN: usize = 3;

/// Ways of putting the paper's hash into a text that are tried.
const HASHES: usize = 3;

/// Families of claims that speak against a hash.
const OF_HASHES: [&str; 5] = ["hash.", "independence.", "atoms.", "cells.window", "uniform."];

/// Changes of one text that are tried, at most.
const MOST: usize = 3000;

/// The size of the noise at which two texts are told apart.
const HASH_SCALE: f64 = 0.4;

/// Most texts that are tried for one file.
const ALL: usize = 9000;

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
    /// What has to hold afterwards.
    pub claims: &'a [Claim],
    /// Adds what else it claims of itself.
    pub claiming: &'a (dyn Fn(Subject<'static>) -> Subject<'static> + Sync),
}

/// What came of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// No experiment shows a slip, and no claim speaks against it that the paper's own listing passes.
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
    /// How little nearer to a mended text it is than the one that it was made of.
    rank: usize,
}

/// Looks for the smallest change. `progress` is told how many texts were read.
#[must_use]
pub fn mend(broken: &Broken<'_>, progress: &(dyn Fn(usize) + Sync)) -> Outcome {
    let Some(subject) = broken.subject(broken.text) else { return Outcome::Left(Vec::new()) };
    let examination = cause::examine(&subject);
    let is_without_slip = examination.found.is_empty() && examination.follows;
    if is_without_slip && broken.against(&subject, broken.claims).is_empty() {
        return Outcome::Sound;
    }
    let found = examination.found.clone();
    let mut search = Search {
        broken,
        is_explained: examination.is_explained,
        names: found.iter().map(|found| found.slip.name).collect(),
        places: places(),
        known: HashSet::new(),
        tries: TRIED,
        tried: 0,
        failed: Vec::new(),
        progress,
    };
    search.known.extend(search.values(&subject));
    let mut open = vec![Seen { text: broken.text.to_owned(), examination, size: (0, 0), rank: 0 }];
    for _ in 0..ROUNDS {
        if search.tried > ALL {
            break;
        }
        match search.round(&open) {
            Ok(text) => {
                let lines = lines_between(broken.text, &text);
                return Outcome::Mended(Mended { text, found, lines, is_replaced: false });
            }
            Err(better) => open = better,
        }
    }
    // Where no small change mends it, its body goes.
    let syntax = broken.syntax(broken.text);
    let sheet = broken.sheet(broken.text, &syntax, Steps::ALL);
    search.tries = 1;
    match sheet.and_then(|sheet| ours::replaced(&sheet)).and_then(|text| search.passing(text)) {
        Some(text) => {
            let lines = lines_between(broken.text, &text);
            Outcome::Mended(Mended { text, found, lines, is_replaced: true })
        }
        None => Outcome::Left(found),
    }
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

    /// Those of some claims that speak against a subject and that the paper's own listing is not known for.
    fn against(&self, subject: &Subject<'_>, claims: &[Claim]) -> Vec<&'static str> {
        let draw = Draw { budget: Budget::Quick, reach: Suite::Paper.reach(), ..Draw::default() };
        let outcomes = run_claims(claims, core::slice::from_ref(subject), &draw, || {});
        Results::new(outcomes, Suite::Paper).news().map(|outcome| outcome.check).collect()
    }

    fn syntax(&self, text: &str) -> Syntax {
        Syntax::of(text, self.language == Language::Wgsl)
    }

    /// Changes of a text, the smallest first.
    fn changes(&self, text: &str, wrong: Steps) -> Vec<Change> {
        let syntax = self.syntax(text);
        let Some(sheet) = self.sheet(text, &syntax, wrong) else { return Vec::new() };
        let mut all = edits::changes(&sheet);
        all.sort_by_key(Change::size);
        all
    }

    /// What the names of a text mean.
    fn sheet<'s>(&'s self, text: &'s str, syntax: &'s Syntax, wrong: Steps) -> Option<Sheet<'s>> {
        let shader = self.shader(text)?;
        let named = |value: &str| {
            let taken =
                shader.taken.iter().find(|taken| taken.meaning == value).map(|taken| taken.name.clone());
            let name = self.options.map.get(value).cloned().or(taken).unwrap_or_else(|| value.to_owned());
            syntax.has(&self.options.function, &name).then_some(name)
        };
        // A member of a block or of a structure goes by both names.
        let member = || {
            let size = shader.taken.iter().find(|taken| taken.meaning == "hash_scale");
            let name = size.map_or("hash_scale", |taken| taken.name.as_str());
            let before = text.split_once(&format!(".{name}"))?.0;
            let of = before.rsplit(|c: char| !(c.is_ascii_alphanumeric() || c == '_')).next()?;
            (!of.is_empty()).then(|| format!("{of}.{name}"))
        };
        Some(Sheet {
            text,
            syntax,
            function: &self.options.function,
            variant: self.variant,
            position: named("position"),
            derivatives: named("dpdx").zip(named("dpdy")).map(|(x, y)| [x, y]),
            hash_scale: named("hash_scale").or_else(|| syntax.hash_scale()).or_else(member),
            has_hash_scale: shader.hash_scale().is_some(),
            wrong,
        })
    }
}

/// Fragments that have nothing in common.
fn places() -> Vec<Fragment> {
    let rng = &mut seed::rng("mend", 0);
    let mut between = |low: f64, high: f64| low + (high - low) * seed::uniform01(rng);
    let mut vector = |reach: f64| DVec3::from_array([(); 3].map(|()| between(-reach, reach)));
    let draw = |index: usize| {
        let [position, dpdx, dpdy, other] = [vector(8.0), vector(0.2), vector(0.2), vector(8.0)];
        let shrink = libm::exp2(-((index % 4) as f64));
        let footprint = Footprint { position, dpdx: dpdx * shrink, dpdy };
        Fragment {
            world: position,
            eye: position,
            pixel: DVec2::new(index as f64, (index / 3) as f64) + 0.5,
            texcoord: DVec2::new(other.x, other.y),
            lod: other.z.abs(),
            frame: index as u32 % 7,
            layer: index as u32 % 5,
            ..Fragment::from(Footprint { position, ..footprint })
        }
    };
    let mut places: Vec<_> = (0..FRAGMENTS).map(draw).collect();
    // Many hashes of cell (0, 0, 0) are 0, where a clamp shows.
    for place in places.iter_mut().step_by(16) {
        place.footprint.position *= 1.0e-3;
    }
    places
}

/// The steps in which something is wrong: all but the hash where that is not known.
fn wrong(examination: &Examination) -> Steps {
    let mut steps = Steps::default();
    for found in &examination.found {
        match found.slip.step() {
            Step::Scale => steps.scale = true,
            Step::Join => steps.join = true,
            Step::Hash => steps.hash = true,
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
    known: HashSet<Vec<u64>>,
    tries: usize,
    /// Texts that were read.
    tried: usize,
    /// What spoke against texts without a slip.
    failed: Vec<Vec<&'static str>>,
    progress: &'a (dyn Fn(usize) + Sync),
}

impl Search<'_> {
    /// What a text makes of the places, in bits.
    fn values(&self, subject: &Subject<'_>) -> Option<Vec<u64>> {
        // At a size of 1 a factor and a divisor are one.
        let rescaled = subject.at_hash_scale(HASH_SCALE);
        let values = rescaled.as_ref().unwrap_or(subject).thresholds(&self.places);
        subject.failure().is_none().then(|| values.into_iter().map(f64::to_bits).collect())
    }

    /// Reads some changed texts and asks the experiments of those that differ in their thresholds from all before.
    fn seen(&mut self, some: &[(&Seen, Change, (usize, usize))]) -> Vec<Seen> {
        let read = |(seen, change, size): &(&Seen, Change, (usize, usize))| {
            let text = change.applied(&seen.text);
            let subject = self.broken.subject(&text)?;
            let values = self.values(&subject)?;
            Some((text, subject, values, *size))
        };
        let read: Vec<_> = some.par_iter().filter_map(read).collect();
        let others = read.into_iter().filter(|(_, _, values, _)| self.known.insert(values.clone()));
        let others: Vec<_> = others.collect();
        let names = &self.names;
        let examined = |(text, subject, _, size): (String, Subject<'static>, Vec<u64>, (usize, usize))| {
            let examination = cause::examine_among(&subject, names);
            Seen { text, examination, size, rank: 0 }
        };
        others.into_par_iter().map(examined).collect()
    }

    /// Tries the changes of some texts: a mended one, or those that are nearer to one.
    fn round(&mut self, open: &[Seen]) -> Result<String, Vec<Seen>> {
        let mut all: Vec<(&Seen, Change, (usize, usize))> = Vec::new();
        for seen in open {
            let changes = self.broken.changes(&seen.text, wrong(&seen.examination)).into_iter().take(MOST);
            all.extend(changes.map(|change| {
                let size = (seen.size.0 + change.lines, seen.size.1 + change.bytes);
                (seen, change, size)
            }));
        }
        all.sort_by_key(|(seen, _, size)| (seen.rank, *size));
        let mut better = Vec::new();
        let mut nearer_after = None;
        let mut ways = HashSet::new();
        for (count, some) in all.chunks(TOGETHER).enumerate() {
            let tried = self.seen(some);
            (self.progress)(some.len());
            self.tried += some.len();
            if self.tried > ALL {
                break;
            }
            for seen in tried {
                let Examination { found, follows, .. } = &seen.examination;
                if found.is_empty() && *follows {
                    if let Some(text) = self.passing(seen.text) {
                        return Ok(text);
                    }
                } else if !found.is_empty()
                    && let Some(rank) = self.rank(&seen, open)
                {
                    if rank == 0 {
                        nearer_after.get_or_insert(count);
                        ways.insert(names(&seen));
                    }
                    better.push(Seen { rank, ..seen });
                }
            }
            // Each slip may be the one that goes first.
            let patience = if ways.len() > 1 { SOON } else { LATE };
            if nearer_after.is_some_and(|first| count > first + patience) {
                break;
            }
        }
        Err(self.nearer(better))
    }

    /// A text that passes the claims: one without a slip, or that with the root of one half as the listing has it, or with the
    /// hash of the paper where the claims speak against its own.
    fn passing(&mut self, text: String) -> Option<String> {
        let examined = cause::examine(&self.broken.subject(&text)?);
        if !examined.found.is_empty() || !examined.follows || self.tries == 0 {
            return None;
        }
        // Another root moves all cells a little, and one claim is enough to see it.
        let listed =
            edits::with_listed_root(&self.broken.syntax(&text), &text).map(|change| change.applied(&text));
        let text = match listed {
            Some(listed) if !self.against(&text, &[claims::exact::CELLS])?.is_empty() => listed,
            Some(_) | None => text,
        };
        // A clamp in the wrong place is cheap to see.
        if !self.broken.claims.is_empty() && !self.against(&text, &[claims::range::RANGE])?.is_empty() {
            return None;
        }
        self.tries -= 1;
        let against = self.against(&text, self.broken.claims)?;
        if against.is_empty() {
            return Some(text);
        }
        // What other changes of the same text do not help.
        self.failed.push(against.clone());
        match self.failed.iter().filter(|other| **other == against).count() {
            1 => {}
            AGAIN.. => {
                self.tries = 0;
                return None;
            }
            _ => return None,
        }
        if !against.iter().any(|claim| OF_HASHES.iter().any(|family| claim.starts_with(family))) {
            return None;
        }
        let changes = self.broken.changes(&text, Steps { hash: true, ..Steps::default() });
        let is_sine = |change: &&Change| change.edits.iter().any(|edit| edit.with.contains(edits::SINE));
        let texts = changes.iter().filter(is_sine).map(|change| change.applied(&text));
        let is_sound = |text: &String| {
            let examined = self.broken.subject(text).map(|subject| cause::examine(&subject));
            examined.is_some_and(|examined| examined.found.is_empty() && examined.follows)
        };
        let mut sound = texts.filter(is_sound).take(HASHES);
        sound.find(|text| self.against(text, self.broken.claims).is_some_and(|against| against.is_empty()))
    }

    fn against(&self, text: &str, claims: &[Claim]) -> Option<Vec<&'static str>> {
        Some(self.broken.against(&self.broken.subject(text)?, claims))
    }

    /// How much nearer a text is than those that it was made of: with fewer slips and no new one first, then with fewer, then with
    /// others.
    fn rank(&self, seen: &Seen, open: &[Seen]) -> Option<usize> {
        let before = open.iter().map(|seen| seen.examination.found.len()).min().unwrap_or(0);
        let names = names(seen);
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
    fn nearer(&self, mut better: Vec<Seen>) -> Vec<Seen> {
        better.sort_by_key(|seen| (seen.rank, seen.examination.found.len(), seen.size));
        let mut kept: Vec<Seen> = Vec::new();
        for seen in better {
            let same = kept.iter().filter(|other| names(other) == names(&seen)).count();
            if kept.len() < KEPT && same < ALIKE {
                kept.push(seen);
            }
        }
        kept
    }
}

/// The slips of a text.
fn names(seen: &Seen) -> Vec<&'static str> {
    seen.examination.found.iter().map(|found| found.slip.name).collect()
}
