//! Three-way merge of lists that two tabs edit at once.
//!
//! In: the list as it was, as this tab has it, and as the other tab stored it. Out: a list with the edits of
//! both.

/// `theirs` with the edits that made `ours` of `base`: items that were added, removed, or changed.
///
/// `key` tells items apart; of an item that both changed, this tab's form remains. Items that were added before
/// all of `base` stay in front, others come last.
pub fn merged<T: Clone + PartialEq, K: PartialEq>(
    base: &[T],
    ours: &[T],
    theirs: &[T],
    key: impl Fn(&T) -> K,
) -> Vec<T> {
    let find = |list: &[T], item: &T| list.iter().find(|other| key(other) == key(item)).cloned();
    let kept = theirs.iter().filter_map(|item| match (find(base, item), find(ours, item)) {
        // This tab removed it, or both added it.
        (Some(_), None) => None,
        (None, ours) => Some(ours.unwrap_or_else(|| item.clone())),
        (Some(base), Some(ours)) => Some(if ours == base { item.clone() } else { ours }),
    });
    let mut all: Vec<T> = kept.collect();
    let is_added = |item: &T| find(base, item).is_none() && find(theirs, item).is_none();
    let in_front = ours.iter().position(|item| !is_added(item)).unwrap_or(ours.len());
    let (front, back) = ours.split_at(in_front);
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
        for (base, ours, theirs, expected) in [
            // Both add.
            ("a1", "x1 a1", "y1 a1", "x1 y1 a1"),
            ("a1", "a1 x1", "a1 y1", "a1 y1 x1"),
            ("", "x1", "y1", "x1 y1"),
            // One removes what the other leaves alone.
            ("a1 b1", "a1", "a1 b1", "a1"),
            ("a1 b1", "a1 b1", "b1", "b1"),
            // What one removes and the other changes is removed; what both change is ours.
            ("a1 b1", "a2 b1", "b1", "b1"),
            ("a1 b1", "b1", "a2 b1", "b1"),
            ("a1", "a2", "a3", "a2"),
            ("a1", "a1", "a3", "a3"),
            // Both add the same.
            ("", "x1", "x2 y1", "x1 y1"),
            ("a1", "a1", "a1", "a1"),
        ] {
            let found = merged(&list(base), &list(ours), &list(theirs), |item| item.0);
            assert_eq!(found, list(expected), "{base} to {ours} and {theirs}");
        }
    }
}
