//! `--look`: another appearance than the scene's own.

use std::fmt::Write as _;

use mandelight::{
    reading::visible,
    scene::{
        Scene,
        looks::{self, Look, LookList},
        presets::Preset,
    },
};

use super::Failure;

/// The looks of a scene.
#[derive(clap::Args)]
pub struct LookArguments {
    /// Change the appearance alone: a look, such as ember, or a part of one, such as tone/film; later ones
    /// replace parts of earlier ones
    #[arg(long, value_name = "NAME")]
    look: Vec<String>,
}

impl LookArguments {
    /// `scene` with the looks that are asked for, in order.
    pub fn in_scene(&self, mut scene: Scene) -> Result<Scene, Failure> {
        for asked in &self.look {
            looks::apply(found(asked)?, &mut scene);
        }
        Ok(scene)
    }
}

/// The look of a name as people type it.
fn found(asked: &str) -> Result<&'static Look, Failure> {
    let id: Vec<String> = asked.split('/').map(Preset::id_of).collect();
    looks::find(&id.join("/")).ok_or_else(|| {
        // The gradients are many: the list of all looks names them.
        let complete = looks::lists().iter().take(1).flat_map(ids).collect::<Vec<_>>().join(", ");
        let asked = visible(asked);
        Failure::usage(format!(
            "--look: no look is called \"{asked}\"; choose one of {complete}, or a part of one, which --list-looks lists"
        ))
    })
}

fn ids(list: &LookList) -> impl Iterator<Item = String> + '_ {
    list.looks.iter().map(|look| list.id(look))
}

/// All looks, a line each.
pub fn list() -> String {
    let width = looks::lists().iter().flat_map(ids).map(|id| id.len()).max().unwrap_or(0);
    let mut text = String::new();
    for list in looks::lists() {
        for look in &list.looks {
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{:width$}  {}", list.id(look), look.about);
        }
    }
    text
}
