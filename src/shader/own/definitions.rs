//! What has to be defined so that all that a function comes to is there: helpers and macros of an engine stand behind conditions as the
//! function itself does.

use super::conditions::needed;
use super::head::File;
use super::statements::is_name;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// Finds, for each name that a function comes to and that is nowhere without one, the macros that the first of its definitions stands behind;
/// those of `set` are defined already.
pub(super) fn wanted(
    file: &File<'_, '_>,
    function: &str,
    set: &BTreeMap<String, String>,
) -> Vec<(String, BTreeMap<String, String>)> {
    // From which byte on which macros are asked for.
    let mut regions = vec![(0, BTreeMap::new())];
    regions.extend(file.directives.iter().map(|line| (line.at.end, needed(file.directives, line.at.end))));
    let mut set: BTreeSet<String> = set.keys().cloned().collect();
    let asked = |at: usize, set: &BTreeSet<String>| {
        let region = regions.partition_point(|(start, _)| *start <= at).saturating_sub(1);
        let missing = regions[region].1.iter().filter(|(name, _)| !set.contains(*name));
        missing.map(|(name, value)| (name.clone(), value.clone())).collect::<BTreeMap<_, _>>()
    };
    // Where each name is defined, and the words of it there.
    let mut definitions: HashMap<&str, Vec<(usize, Vec<usize>)>> = HashMap::new();
    for item in file.items {
        let tokens: Vec<usize> = item.tokens.clone().filter(|&at| !file.in_directive[at]).collect();
        for name in &item.names {
            // What stands before the name may be behind a condition of its own.
            let place = item.function.or_else(|| tokens.iter().copied().find(|&at| file.word(at) == *name));
            let Some(place) = place else { continue };
            definitions.entry(name).or_default().push((file.tokens[place].at.start, tokens.clone()));
        }
    }
    for line in file.directives.iter().filter(|line| line.name() == "define") {
        if let Some(name) = line.words.get(2) {
            definitions.entry(name).or_default().push((line.at.start, line.tokens.clone().skip(3).collect()));
        }
    }
    let (mut open, mut seen) = (vec![function], BTreeSet::from([function]));
    let mut found = Vec::new();
    while let Some(name) = open.pop() {
        let Some(places) = definitions.get(name) else { continue };
        if !places.iter().any(|(at, _)| asked(*at, &set).is_empty()) {
            let more = asked(places[0].0, &set);
            set.extend(more.keys().cloned());
            found.push((name.to_owned(), more));
        }
        for (_, tokens) in places.iter().filter(|(at, _)| asked(*at, &set).is_empty()) {
            let read = tokens.iter().filter(|&&at| asked(file.tokens[at].at.start, &set).is_empty());
            let words = read.map(|&at| file.word(at)).filter(|word| is_name(word));
            open.extend(words.filter(|word| seen.insert(*word)));
        }
    }
    found
}
