//! `mandelight formulas`, `mandelight formula check` and `--formula`.

use std::{collections::HashSet, fs};

use mandelight::{
    formula::{self, hybrid},
    scene::document,
};
use mandelight_test_support::{
    picture::Picture,
    program::{code, program, said},
};

use super::PROGRAM;

/// A text with a parameter.
const TEXT: &str = "name \"Own\";\nparam scale = 2 from -3 to 3 label \"Scale\";\n\
                    step { z = scale * box_fold(z, 1) * sphere_fold_scale(z, 0.5, 1) + c; }\n\
                    bailout 100;\nestimate linear;\nbound 12;\n";

#[test]
fn the_list_has_a_line_for_each_formula() {
    let output = program(PROGRAM, ["formulas"]).output().unwrap();
    let list = String::from_utf8(output.stdout).unwrap();
    let ids: Vec<&str> = list.lines().filter_map(|line| line.split_whitespace().next()).collect();
    let transforms = hybrid::step_formulas().filter(|&formula| hybrid::is_transform(formula));
    let expected = formula::all().chain(transforms).map(|formula| formula.id());
    assert!(ids.iter().copied().eq(expected), "{list}");
}

#[test]
fn a_text_is_checked_and_its_first_error_is_shown_with_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("own.formula");
    fs::write(&file, TEXT).unwrap();
    let check = || program(PROGRAM, ["formula".as_ref(), "check".as_ref(), file.as_os_str()]);
    let output = check().output().unwrap();
    assert_eq!(code(&output), 0, "{}", said(&output));
    assert!(String::from_utf8_lossy(&output.stdout).contains("Own: valid; fields: scale julia"));
    fs::write(&file, TEXT.replace("box_fold", "box_flod")).unwrap();
    let output = check().output().unwrap();
    let said = said(&output);
    assert_eq!(code(&output), 2, "{said}");
    assert!(
        said.contains("own.formula:3:20: `box_flod` is unknown; did you mean `box_fold`?"),
        "{said}"
    );
    assert!(said.contains("step { z = scale"), "{said}");
    fs::write(&file, "//".repeat(5000)).unwrap();
    assert_eq!(code(&check().output().unwrap()), 2);
    fs::remove_file(&file).unwrap();
    assert_eq!(code(&check().output().unwrap()), 2);
}

#[test]
fn a_picture_of_a_text_carries_it() {
    let folder = tempfile::tempdir().unwrap();
    let (file, picture) = (folder.path().join("own.formula"), folder.path().join("own.png"));
    fs::write(&file, TEXT).unwrap();
    let printed = program(PROGRAM, ["scene".as_ref(), "--formula".as_ref(), file.as_os_str()])
        .args(["--set", "scale=-1.5"])
        .output()
        .unwrap();
    assert_eq!(code(&printed), 0, "{}", said(&printed));
    let scene = document::from_json(&String::from_utf8(printed.stdout).unwrap()).unwrap();
    assert_eq!(scene.fractal.number("scale"), Some(-1.5));
    assert_eq!(scene.fractal.formula().text(), Some(TEXT));
    let document = folder.path().join("own.json");
    fs::write(&document, document::to_json(&scene)).unwrap();
    let output = program(
        PROGRAM,
        ["render".as_ref(), document.as_os_str(), "-o".as_ref(), picture.as_os_str()],
    )
    .args(["--size", "32x24", "--samples", "1", "--quiet"])
    .output()
    .unwrap();
    assert_eq!(code(&output), 0, "{}", said(&output));
    let read = Picture::of(&fs::read(&picture).unwrap());
    assert!(read.texts.iter().any(|(_, text)| text.contains("box_fold")));
    let pixels: HashSet<[u8; 3]> = read.rgb().into_iter().collect();
    assert!(pixels.len() > 50, "{} colours", pixels.len());
}

#[test]
fn a_hybrid_is_made_of_names_and_changed_by_set() {
    let scene = |arguments: &[&str]| program(PROGRAM, ["scene"]).args(arguments).output().unwrap();
    let steps = ["--hybrid", "rotate,mandelbox*2,mandelbulb"];
    let output = scene(&[&steps[..], &["--set", "fractal.steps[1].scale=-1.5"]].concat());
    assert_eq!(code(&output), 0, "{}", said(&output));
    let scene_of = document::from_json(&String::from_utf8(output.stdout).unwrap()).unwrap();
    let hybrid = scene_of.fractal.hybrid().expect("a hybrid");
    let found: Vec<_> =
        hybrid.steps.iter().map(|step| (step.formula().id(), step.repeats)).collect();
    assert_eq!(found, [("rotate", 1), ("mandelbox", 2), ("mandelbulb", 1)]);
    assert_eq!(hybrid.steps[1].values()[0], (-1.5).into());
    for wrong in ["mandelbux", "mandelbox*0", "mandelbox*x", ""] {
        let output = scene(&["--hybrid", wrong]);
        assert_eq!(code(&output), 2, "{wrong}: {}", said(&output));
        assert!(said(&output).contains("--hybrid: "), "{}", said(&output));
    }
}
