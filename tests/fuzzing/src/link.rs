//! Links: the fragment of an address.

use mandelight::scene::link::{self, MAX_FRAGMENT_BYTES};

use crate::{
    FuzzTarget, InputFormat, Outcome, document,
    promises::{project_holds, refused},
};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "link",
    check,
    seeds,
    format: InputFormat::Link,
    hundreds: 150,
    most_work: 32 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    let Ok(fragment) = str::from_utf8(bytes) else { return Outcome::Refused };
    let project = match link::project_from_fragment(fragment) {
        Ok(project) => project,
        Err(error) => return refused(&error),
    };
    project_holds(&project);
    match link::project_to_fragment(&project) {
        Ok(written) => {
            assert!(written.len() <= MAX_FRAGMENT_BYTES, "{} characters", written.len());
            let is_plain = |c: char| c.is_ascii_alphanumeric() || "=-_".contains(c);
            assert!(written.chars().all(is_plain), "{written}");
            let again = link::project_from_fragment(&written).expect("what is written is read");
            assert_eq!(again, project, "written and read again, the project is another");
        }
        // Defaults written out may be too long for a link.
        Err(error) => {
            refused(&error);
        }
    }
    Outcome::Read
}

fn seeds() -> Vec<Vec<u8>> {
    let links = document::projects().into_iter();
    links
        .filter_map(|project| link::project_to_fragment(&project).ok()?.into_bytes().into())
        .collect()
}
