//! What was seen in the whole domain, in each level of each of its dimensions, and in each setting.

use crate::check::input::everywhere::{Dimension, Setting, Settings};
use rustc_hash::FxHashMap;

/// Something that was counted, with what it counts as a whole and by parts.
pub(crate) struct Pools<T> {
    all: T,
    levels: FxHashMap<(Dimension, i32), (String, T)>,
    settings: Vec<(String, T)>,
}

impl<T: Clone> Pools<T> {
    /// Nothing counted yet.
    pub fn new(empty: T) -> Self {
        Self { all: empty, levels: FxHashMap::default(), settings: Vec::new() }
    }

    /// Adds what was counted in one setting.
    pub fn add(&mut self, settings: &Settings, setting: &Setting, counted: T, merge: impl Fn(&mut T, &T)) {
        merge(&mut self.all, &counted);
        for dimension in Dimension::ALL {
            match self.levels.entry((dimension, setting.level(dimension))) {
                std::collections::hash_map::Entry::Occupied(mut entry) => {
                    merge(&mut entry.get_mut().1, &counted)
                }
                std::collections::hash_map::Entry::Vacant(entry) => {
                    entry.insert((setting.told(dimension, &settings.scales), counted.clone()));
                }
            }
        }
        self.settings.push((setting.words(&settings.scales), counted));
    }

    /// Every part that holds more than a setting, by name: the whole domain first, then each level of each dimension.
    pub fn levels(&self) -> impl Iterator<Item = (&str, &T)> {
        let mut levels: Vec<_> = self.levels.iter().collect();
        levels.sort_unstable_by_key(|(key, _)| **key);
        let named = levels.into_iter().map(|(_, (name, counted))| (name.as_str(), counted));
        std::iter::once(("the whole domain", &self.all)).chain(named)
    }

    /// Every setting, by its levels in words.
    pub fn settings(&self) -> impl Iterator<Item = (&str, &T)> {
        self.settings.iter().map(|(name, counted)| (name.as_str(), counted))
    }
}
