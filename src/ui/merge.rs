//! Lists that two tabs edit at once, brought together.
//!
//! In: the list as it was, as this tab has it, and as the other tab stored it. Out: a list with the edits of
//! both.

/// `stored` with the edits that made `mine` of `known`: items that were added, removed, or changed.
///
/// `key` tells items apart; of an item that both changed, this tab's form remains. Items that were added before
/// all known ones stay in front, others come last.
pub fn merged<T: Clone + PartialEq, K: PartialEq>(
    known: &[T],
    mine: &[T],
    stored: &[T],
    key: impl Fn(&T) -> K,
) -> Vec<T> {
    let find = |list: &[T], item: &T| list.iter().find(|other| key(other) == key(item)).cloned();
    let kept = stored.iter().filter_map(|item| match (find(known, item), find(mine, item)) {
        // This tab removed it, or both added it.
        (Some(_), None) => None,
        (None, mine) => Some(mine.unwrap_or_else(|| item.clone())),
        (Some(known), Some(mine)) => Some(if mine == known { item.clone() } else { mine }),
    });
    let mut all: Vec<T> = kept.collect();
    let is_added = |item: &T| find(known, item).is_none() && find(stored, item).is_none();
    let in_front = mine.iter().position(|item| !is_added(item)).unwrap_or(mine.len());
    let (front, back) = mine.split_at(in_front);
    all.splice(0..0, front.iter().cloned());
    all.extend(back.iter().filter(|item| is_added(item)).cloned());
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Items `a1 b1`: a key and a value each.
    fn list(text: &str) -> Vec<(char, char)> {
        text.split_whitespace()
            .map(|item| (item.as_bytes()[0].into(), item.as_bytes()[1].into()))
            .collect()
    }

    #[test]
    fn edits_of_both_tabs_remain() {
        for (known, mine, stored, expected) in [
            // Both add.
            ("a1", "x1 a1", "y1 a1", "x1 y1 a1"),
            ("a1", "a1 x1", "a1 y1", "a1 y1 x1"),
            ("", "x1", "y1", "x1 y1"),
            // One removes what the other leaves alone.
            ("a1 b1", "a1", "a1 b1", "a1"),
            ("a1 b1", "a1 b1", "b1", "b1"),
            // What one removes and the other changes is removed; what both change is mine.
            ("a1 b1", "a2 b1", "b1", "b1"),
            ("a1 b1", "b1", "a2 b1", "b1"),
            ("a1", "a2", "a3", "a2"),
            ("a1", "a1", "a3", "a3"),
            // Both add the same.
            ("", "x1", "x2 y1", "x1 y1"),
            ("a1", "a1", "a1", "a1"),
        ] {
            let found = merged(&list(known), &list(mine), &list(stored), |item| item.0);
            assert_eq!(found, list(expected), "{known} to {mine} and {stored}");
        }
    }
}
