//! docs/gallery.md: a picture, a sentence and a link for each scene of a formula or of a mix.

use std::fmt::Write;

use mandelight::scene::{Scene, link, presets};

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/gallery.md");

const HEAD: &str = "# Gallery of formulas

A scene for each formula that comes with the program, then hybrids, cuts and scenes with two layers of colours, then scenes in
[path-traced light](scene.md#path-tracing). The panel lists them under *Formulas*, *Mixes* and *Light*. On the command line,

    mandelight scene --preset kleinian | mandelight render - -o kleinian.png

draws one of them; the pictures here are `--size 192x120 --samples 32`, those of traced light with the scenes' own samples. The links are relative to the published page, as those of
[dives](dives.md) are. Written by `MANDELIGHT_BLESS=1 cargo test --test cpu gallery`.

| picture | scene | formula | link |
|---|---|---|---|
";

/// The formula's id, or the steps of a hybrid as `--hybrid` takes them.
fn formula_of(scene: &Scene) -> String {
    let Some(hybrid) = scene.fractal.hybrid() else {
        return format!("`{}`", scene.fractal.formula().id());
    };
    let steps = hybrid.steps.iter().map(|step| match step.repeats {
        1 => step.formula().id().to_owned(),
        repeats => format!("{}*{repeats}", step.formula().id()),
    });
    format!("hybrid of `{}`", steps.collect::<Vec<_>>().join(","))
}

#[test]
fn the_gallery_shows_every_scene_of_a_formula_or_a_mix() {
    let mut text = HEAD.to_owned();
    let all: Vec<_> =
        presets::formulas().iter().chain(presets::mixes()).chain(presets::traced()).collect();
    assert!(all.len() >= 24, "{} scenes", all.len());
    for preset in all {
        let scene = (preset.scene)();
        assert_eq!(scene.validate(), Ok(()), "{}", preset.name);
        let fragment = link::to_fragment(&scene).expect("a link");
        assert_eq!(link::from_fragment(&fragment).as_ref(), Ok(&scene), "{}", preset.name);
        let (id, blurb) = (preset.id(), preset.blurb);
        let picture = format!("![{blurb}](../src/ui/thumbnails/{id}.jpg)");
        writeln!(
            text,
            "| {picture} | **{}** (`{id}`): {blurb} | {} | [open](../#{fragment}) |",
            preset.name,
            formula_of(&scene)
        )
        .expect("a text takes all");
    }
    if std::env::var_os("MANDELIGHT_BLESS").is_some() {
        std::fs::write(FILE, &text).expect("docs/gallery.md");
    }
    let found = std::fs::read_to_string(FILE).expect("docs/gallery.md");
    assert!(
        found == text,
        "MANDELIGHT_BLESS=1 cargo test --test cpu gallery writes docs/gallery.md"
    );
}
