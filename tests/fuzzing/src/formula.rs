//! Texts of formulas.

use glam::DVec3;
use mandelight::formula::{
    self, Fractal, HybridStep, hybrid,
    language::{check as checker, syntax},
    own,
};

use crate::{FuzzTarget, InputFormat, Outcome, promises::refused};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "formula",
    check,
    seeds,
    format: InputFormat::Words,
    hundreds: 100,
    most_work: 64 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    let Ok(text) = str::from_utf8(bytes) else { return Outcome::Refused };
    let checked = syntax::parse(text).and_then(|tree| checker::check(text, &tree));
    let formula = match own::of_text(text) {
        Ok(formula) => formula,
        Err(error) => {
            let (before, line) = (text.lines().count().max(1) + 1, error.line);
            assert!((1..=before).contains(&line) && error.column > 0, "{error}");
            return refused(&error);
        }
    };
    checked.expect("what makes a formula is checked");
    let again = own::of_text(text).expect("what is read is read again");
    assert!(formula == again, "the same text gives another formula");
    if hybrid::is_transform(formula) {
        let step = hybrid::step(formula).expect("a transform is a step");
        let text = serde_json::to_string(&step).expect("a step is JSON");
        let read: HybridStep = serde_json::from_str(&text).expect("what is written is read");
        assert_eq!(read, step, "written and read again, the step is another");
        return Outcome::Read;
    }
    let fractal = Fractal::new(formula);
    let text = serde_json::to_string(&fractal).expect("a fractal is JSON");
    let read: Fractal = serde_json::from_str(&text).expect("what is written is read");
    assert_eq!(read, fractal, "written and read again, the fractal is another");
    let field = fractal.distance_field();
    for point in [DVec3::ZERO, DVec3::new(0.3, -0.7, 1.1), DVec3::splat(40.0)] {
        // Whatever the text says, nothing panics; a value may be no number.
        let _ = field.estimate(point);
    }
    Outcome::Read
}

fn seeds() -> Vec<Vec<u8>> {
    let texts = formula::texts().chain(formula::step_texts());
    texts.map(|(_, text)| text.as_bytes().to_vec()).collect()
}
