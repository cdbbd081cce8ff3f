//! Paths through any scenes: what is between two valid scenes is valid, and documents and links
//! hold a path as it is.

use std::sync::Arc;

use mandelight::scene::{
    Path, Project, document, link,
    path::{Easing, Key},
};
use mandelight_test_support::scenes::scene;
use proptest::{collection::vec, option, prelude::*, sample::select};

fn path() -> impl Strategy<Value = Path> {
    let easing = select(vec![Easing::Smooth, Easing::Linear, Easing::Hold]);
    let keys = vec((0.01..100.0_f64, easing, scene(), option::of(-29.0..1.0_f64)), 0..5);
    (keys, 1..=240_u32, 0.0..=1.0_f64).prop_map(|(keys, frames_per_second, shutter)| {
        let mut time_secs = 0.0;
        let keys = keys.into_iter().map(|(wait_secs, easing, mut scene, depth)| {
            time_secs += wait_secs;
            if let Some(depth) = depth {
                // As close to the pivot as a dive may come.
                let camera = &mut scene.camera;
                let aside = camera.forward() * -10f64.powf(depth);
                let eye = camera.pivot.moved_by(aside, 0.0);
                if (&eye - &camera.pivot).length() > 1e-30 {
                    camera.position = eye;
                }
            }
            Key { time_secs, easing, scene: Arc::new(scene) }
        });
        Path { frames_per_second, shutter, keys: keys.collect() }
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]

    #[test]
    fn what_is_between_valid_scenes_is_valid(path in path(), parts in vec(0.0..=1.0_f64, 6)) {
        prop_assert_eq!(path.validate(), Ok(()));
        for part in parts {
            let secs = part * path.duration_secs();
            match path.at(secs) {
                Some(scene) => prop_assert_eq!(scene.validate(), Ok(())),
                None => prop_assert!(path.is_empty()),
            }
        }
    }

    #[test]
    fn a_document_holds_the_path_as_it_is(scene in scene(), path in path()) {
        let mut project = Project { scene, path };
        // A key that shares parts with the document's scene says less.
        if let Some(key) = project.path.keys.first_mut() {
            let mut shared = project.scene.clone();
            shared.camera = key.scene.camera.clone();
            key.scene = Arc::new(shared);
        }
        let text = document::project_to_json(&project);
        prop_assert_eq!(&document::project_from_json(&text).unwrap(), &project);
        let compact = document::project_to_json_compact(&project);
        prop_assert_eq!(&document::project_from_json(&compact).unwrap(), &project);
        prop_assert_eq!(&document::from_json(&text).unwrap(), &project.scene);
        match link::project_to_fragment(&project) {
            Ok(fragment) => {
                prop_assert_eq!(&link::project_from_fragment(&fragment).unwrap(), &project);
            }
            Err(error) => {
                let too_long = matches!(error, link::LinkError::TooLong { .. });
                prop_assert!(too_long, "{}", error);
            }
        }
    }
}
