//! docs/looks.md: what looks are, and a line for each.

use std::fmt::Write;

use mandelight::scene::looks;

const FILE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/docs/looks.md");

const HEAD: &str = "# Looks

A look changes what a scene looks like, and nothing else: the shape, the camera, the quality and the path stay.
The panel shows looks as swatches under *Appearance*. A swatch under the pointer, or with the keyboard, shows its look in the
view; a click or the Enter key keeps the look, as one undo step.

![One scene in sixteen looks](pictures/looks.png)

A complete look replaces the gradient, the material with the second layer of colours, the lights, the background, the fog,
the tone and the bloom. It keeps the value that selects from the gradient (`surface.coloring`), the colours of section
planes, indirect light and path tracing. An environment map no longer lights the scene, but stays to be chosen again; a [medium](scene.md#media)
becomes a surface. The lights of complete looks stay with the camera, so that every view is lit.

The other lists replace one part each, to mix: the gradient; the lights; the background; the tone with the bloom. On
the command line, later looks replace parts of earlier ones:

    mandelight scene --preset julia --look gold --look background/dusk --look tone/film | mandelight render - -o gold.png

`mandelight scene --list-looks` lists all names. This page is written by `MANDELIGHT_BLESS=1 cargo test --test cpu looks`.
";

#[test]
fn the_page_of_looks_has_a_line_for_each() {
    let mut text = HEAD.to_owned();
    for list in looks::lists() {
        let about = if list.about.ends_with('.') { "" } else { "." };
        write!(text, "\n## {}\n\n{}{about}\n", list.name, list.about).expect("a text takes all");
        if list.looks.iter().all(|look| look.gradient.is_some() && look.lights.is_none()) {
            let names: Vec<_> =
                list.looks.iter().map(|look| format!("`{}`", list.id(look))).collect();
            for line in names.chunks(6) {
                write!(text, "\n{}", line.join(", ")).expect("a text takes all");
            }
            text.push('\n');
            continue;
        }
        text.push_str("\n| look | on the command line | what it does |\n|---|---|---|\n");
        for look in &list.looks {
            writeln!(text, "| {} | `{}` | {} |", look.name, list.id(look), look.about)
                .expect("a text takes all");
        }
    }
    if std::env::var_os("MANDELIGHT_BLESS").is_some() {
        std::fs::write(FILE, &text).expect("docs/looks.md");
    }
    let found = std::fs::read_to_string(FILE).expect("docs/looks.md");
    assert!(found == text, "MANDELIGHT_BLESS=1 cargo test --test cpu looks writes docs/looks.md");
}
