//! Undo and redo against the plainest model: the list of scenes at the end of each gesture.

use mandelight::scene::{
    Scene,
    history::{GestureId, History, MAX_STEPS},
};
use proptest::{collection::vec, prelude::*};

/// The default scene, told apart by its exposure.
fn scene(number: usize) -> Scene {
    let mut scene = Scene::default();
    scene.tone.exposure = number as f64 * 1e-3;
    scene
}

/// Makes gestures of the given numbers of changes, the first of each without an id where it is
/// a single change. Returns the history, the present scene and the scenes between gestures.
fn after(gestures: &[usize]) -> (History<Scene>, Scene, Vec<Scene>) {
    let (mut history, mut present, mut stations) = (History::new(), scene(0), vec![scene(0)]);
    let mut changes = 0;
    for (id, &count) in gestures.iter().enumerate() {
        for _ in 0..count {
            history.record(&present, (count > 1).then_some(GestureId(id as u64)));
            changes += 1;
            present = scene(changes);
        }
        stations.push(present.clone());
    }
    (history, present, stations)
}

proptest! {
    #[test]
    fn undo_goes_back_through_each_gesture_and_redo_forward(gestures in vec(1..5_usize, 0..30)) {
        let (mut history, mut present, stations) = after(&gestures);
        for station in stations.iter().rev().skip(1) {
            present = history.undo(&present).unwrap();
            prop_assert_eq!(&present, station);
        }
        prop_assert_eq!(history.undo(&present), None);
        prop_assert!(!history.can_undo());
        for station in &stations[1..] {
            present = history.redo(&present).unwrap();
            prop_assert_eq!(&present, station);
        }
        prop_assert_eq!(history.redo(&present), None);
        prop_assert!(!history.can_redo());
    }

    #[test]
    fn any_walk_agrees_with_the_model(steps in vec(0..4_u8, 0..60)) {
        let (mut history, mut present) = (History::new(), scene(0));
        let (mut model, mut at) = (vec![scene(0)], 0);
        for (number, step) in steps.into_iter().enumerate() {
            match step {
                0 => match history.undo(&present) {
                    Some(earlier) => { at -= 1; present = earlier; }
                    None => prop_assert_eq!(at, 0),
                },
                1 => match history.redo(&present) {
                    Some(later) => { at += 1; present = later; }
                    None => prop_assert_eq!(at + 1, model.len()),
                },
                _ => {
                    history.record(&present, None);
                    present = scene(number + 1);
                    model.truncate(at + 1);
                    model.push(present.clone());
                    at += 1;
                }
            }
            prop_assert_eq!(&present, &model[at]);
            prop_assert_eq!((history.can_undo(), history.can_redo()), (at > 0, at + 1 < model.len()));
        }
    }
}

#[test]
fn the_oldest_steps_are_forgotten() {
    let (mut history, mut present, stations) = after(&vec![1; MAX_STEPS + 30]);
    let mut steps = 0;
    while let Some(earlier) = history.undo(&present) {
        present = earlier;
        steps += 1;
    }
    assert_eq!((steps, &present), (MAX_STEPS, &stations[30]));
}

#[test]
fn a_gesture_that_goes_on_after_an_undo_is_a_step_of_its_own() {
    let drag = Some(GestureId(7));
    let mut history = History::new();
    history.record(&scene(0), drag);
    history.record(&scene(1), drag);
    assert_eq!(history.undo(&scene(2)), Some(scene(0)));
    history.record(&scene(0), drag);
    assert!(!history.can_redo());
    assert_eq!(history.undo(&scene(3)), Some(scene(0)));
    assert_eq!(history.undo(&scene(0)), None);
}
