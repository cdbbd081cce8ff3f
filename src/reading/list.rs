//! Lists with a largest length, which holds while the list is read.

use std::{fmt, marker::PhantomData};

use serde::{
    Deserialize, Deserializer,
    de::{DeserializeSeed, Error, SeqAccess, Visitor},
};

/// Reads a list of at most `MAX` entries, for `#[serde(deserialize_with)]`.
///
/// # Errors
/// Those of the entries; and that there is an entry more than `MAX`, without reading those after it.
pub fn at_most<'de, const MAX: usize, T, D>(deserializer: D) -> Result<Vec<T>, D::Error>
where
    T: Deserialize<'de>,
    D: Deserializer<'de>,
{
    AtMost { max: MAX, entry: PhantomData }.deserialize(deserializer)
}

/// Reads a list of at most `max` entries of type `T`.
pub struct AtMost<T> {
    max: usize,
    entry: PhantomData<T>,
}

impl<T> AtMost<T> {
    /// A list of at most `max` entries.
    pub fn new(max: usize) -> Self {
        Self { max, entry: PhantomData }
    }
}

impl<'de, T: Deserialize<'de>> DeserializeSeed<'de> for AtMost<T> {
    type Value = Vec<T>;

    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<Vec<T>, D::Error> {
        deserializer.deserialize_seq(self)
    }
}

impl<'de, T: Deserialize<'de>> Visitor<'de> for AtMost<T> {
    type Value = Vec<T>;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a list")
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Vec<T>, A::Error> {
        // What a list says of its own length reserves nothing.
        let mut entries = Vec::new();
        while entries.len() < self.max {
            match list.next_element()? {
                Some(entry) => entries.push(entry),
                None => return Ok(entries),
            }
        }
        match list.next_element_seed(Surplus)? {
            None => Ok(entries),
            Some(()) => {
                let max = self.max;
                let message = format!(
                    "has more than {max} entries, and at most {max} are read: remove the others"
                );
                Err(A::Error::custom(message))
            }
        }
    }
}

/// Notices an entry without reading it.
struct Surplus;

impl<'de> DeserializeSeed<'de> for Surplus {
    type Value = ();

    fn deserialize<D: Deserializer<'de>>(self, _: D) -> Result<(), D::Error> {
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering};

    use super::*;

    /// Number of entries that were read.
    static READ: AtomicUsize = AtomicUsize::new(0);

    struct Counted;

    impl<'de> Deserialize<'de> for Counted {
        fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
            READ.fetch_add(1, Ordering::Relaxed);
            u8::deserialize(deserializer).map(|_| Self)
        }
    }

    #[test]
    fn no_entry_beyond_the_limit_is_read() {
        let read = |text: &str| {
            READ.store(0, Ordering::Relaxed);
            let mut reader = serde_json::Deserializer::from_str(text);
            let list = at_most::<3, Counted, _>(&mut reader);
            (list.map(|list| list.len()).map_err(|e| e.to_string()), READ.load(Ordering::Relaxed))
        };
        assert_eq!(read("[]"), (Ok(0), 0));
        assert_eq!(read("[1,2,3]"), (Ok(3), 3));
        for text in ["[1,2,3,4]".to_owned(), format!("[1{}]", ",1".repeat(100_000))] {
            let (list, entries) = read(&text);
            let error = list.expect_err("too long");
            assert!(error.contains("more than 3 entries"), "{error}");
            assert_eq!(entries, 3);
        }
        assert!(read("{}").0.expect_err("an object").contains("expected a list"));
    }
}
