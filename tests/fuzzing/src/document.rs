//! Scene documents.

use std::sync::Arc;

use mandelight::scene::{
    Path, Project, document,
    path::{Easing, Key},
    presets,
};

use crate::{
    FuzzTarget, InputFormat, Outcome,
    promises::{project_holds, refused},
};

pub const TARGET: FuzzTarget = FuzzTarget {
    name: "document",
    check,
    seeds,
    format: InputFormat::Json,
    hundreds: 200,
    most_work: 32 << 20,
};

fn check(bytes: &[u8]) -> Outcome {
    let Ok(text) = str::from_utf8(bytes) else { return Outcome::Refused };
    match document::project_from_json(text) {
        Ok(project) => {
            project_holds(&project);
            Outcome::Read
        }
        Err(error) => refused(&error),
    }
}

/// The gallery's scenes, and paths between some of them.
fn seeds() -> Vec<Vec<u8>> {
    projects().iter().map(|project| document::project_to_json(project).into_bytes()).collect()
}

/// Some scenes of every list of presets, and a path through scenes of each formula.
pub fn projects() -> Vec<Project> {
    let scenes: Vec<_> = presets::all().map(|preset| (preset.scene)()).collect();
    let mut projects: Vec<Project> = scenes.iter().step_by(5).cloned().map(Project::from).collect();
    for pair in scenes.windows(2).step_by(9) {
        let key = |(time, scene): (f64, &mandelight::scene::Scene)| Key {
            time_secs: time,
            easing: Easing::default(),
            scene: Arc::new(scene.clone()),
        };
        let keys = [0.0, 1.5].into_iter().zip(pair).map(key).collect();
        let path = Path { keys, ..Path::default() };
        if path.validate().is_ok() {
            projects.push(Project { scene: pair[0].clone(), path });
        }
    }
    projects
}
