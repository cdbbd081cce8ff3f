//! The envelope of a scene in its document: kind, version and path, and the largest size.

use std::fmt;

use serde::{
    Deserialize, Deserializer, Serialize,
    de::{Error, IgnoredAny, MapAccess, SeqAccess, Visitor},
};

/// The kind of a scene's document.
pub const KIND: &str = "scene";
/// The version written.
pub const VERSION: u32 = 2;
/// The versions read. Version 1 knew one formula: its documents lack `fractal.formula`.
pub const READ: std::ops::RangeInclusive<u64> = 1..=VERSION as u64;
/// The largest document read, in bytes: more than a full path takes whose keys each have as many
/// lights as there can be.
pub const MAX_BYTES: usize = 16 << 20;

/// What the document is, before its contents are looked at.
#[derive(Deserialize)]
pub struct Header {
    /// The kind; [`KIND`] in a scene's document.
    pub mandelight: Option<Scalar>,
    /// The version; in [`READ`] if this program can read it.
    pub version: Option<Scalar>,
}

/// A text or a number; of everything else only its kind is kept.
#[derive(Debug, PartialEq)]
pub enum Scalar {
    /// A text.
    Text(String),
    /// A whole number that is not negative.
    Whole(u64),
    /// Anything else, as it is shown.
    Other(String),
}

impl fmt::Display for Scalar {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Text(text) => write!(f, "\"{text}\""),
            Self::Whole(number) => number.fmt(f),
            Self::Other(shown) => shown.fmt(f),
        }
    }
}

impl<'de> Deserialize<'de> for Scalar {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ScalarVisitor)
    }
}

struct ScalarVisitor;

impl<'de> Visitor<'de> for ScalarVisitor {
    type Value = Scalar;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "a text or a number")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<Scalar, E> {
        Ok(Scalar::Text(text.to_owned()))
    }

    fn visit_u64<E: Error>(self, number: u64) -> Result<Scalar, E> {
        Ok(Scalar::Whole(number))
    }

    fn visit_i64<E: Error>(self, number: i64) -> Result<Scalar, E> {
        Ok(Scalar::Other(number.to_string()))
    }

    fn visit_f64<E: Error>(self, number: f64) -> Result<Scalar, E> {
        Ok(Scalar::Other(number.to_string()))
    }

    fn visit_bool<E: Error>(self, value: bool) -> Result<Scalar, E> {
        Ok(Scalar::Other(value.to_string()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<Scalar, A::Error> {
        while list.next_element::<IgnoredAny>()?.is_some() {}
        Ok(Scalar::Other("a list".to_owned()))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut object: A) -> Result<Scalar, A::Error> {
        while object.next_entry::<IgnoredAny, IgnoredAny>()?.is_some() {}
        Ok(Scalar::Other("an object".to_owned()))
    }
}

/// The document; `S` is `Scene` to read and `&Scene` to write, `P` its path.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Document<S, P: Default + PartialEq> {
    /// The kind, [`KIND`].
    pub mandelight: String,
    /// The version; [`VERSION`] in a document to write.
    pub version: u32,
    /// The scene in view.
    pub scene: S,
    /// The camera path.
    #[serde(default, skip_serializing_if = "is_default")]
    pub path: P,
}

fn is_default<P: Default + PartialEq>(path: &P) -> bool {
    *path == P::default()
}
