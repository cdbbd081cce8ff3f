//! Saving of pictures: their size, their format, and the progress.

use egui::{Key, Modifiers};
use egui_kittest::{Harness, kittest::Queryable as _};
use mandelight::{
    export::jpeg,
    scene::presets,
    ui::{
        Action, DEFAULT_QUALITY, ExportProgress, ExportSize, Notice, SequenceFormat, Settings,
        StillFile, StillFormat,
    },
};

use crate::stage::*;

#[test]
fn saving_asks_for_the_chosen_size() {
    let mut harness = workshop();
    let [width, height] = harness.state().interface.view_size_px();
    press(&mut harness, "Save picture");
    press(&mut harness, "Picture size: 2×");
    harness.key_press_modifiers(Modifiers::COMMAND, Key::S);
    harness.run();
    let expected = [[width, height], [2 * width, 2 * height]].map(|size_px| Action::SavePicture {
        size_px,
        file: StillFile::default(),
        pair: false,
    });
    assert_eq!(harness.state().actions, expected);
    press(&mut harness, "File: EXR");
    press(&mut harness, "Save picture");
    let last = harness.state().actions.last().copied();
    let file = StillFile { format: StillFormat::Exr, ..StillFile::default() };
    let size_px = [2 * width, 2 * height];
    assert_eq!(last, Some(Action::SavePicture { size_px, file, pair: false }));
}

/// Each format is saved as such, says what it is, and has the settings that belong to it.
#[test]
fn pictures_are_saved_in_the_chosen_format() {
    assert_eq!(DEFAULT_QUALITY, jpeg::DEFAULT_QUALITY);
    let mut harness = workshop();
    let saved = |harness: &mut Harness<'_, Stage>| {
        press(harness, "Save picture");
        match harness.state().actions.last().copied() {
            Some(Action::SavePicture { file, .. }) => file,
            other => panic!("{other:?}"),
        }
    };
    for (format, name, _) in StillFormat::ALL {
        press(&mut harness, &format!("File: {name}"));
        let file = saved(&mut harness);
        assert_eq!(file, StillFile { format, ..StillFile::default() });
        let has_quality = harness.query_by_label("Quality value").is_some();
        assert_eq!(has_quality, format == StillFormat::Jpeg, "{name}");
        let has_bits = harness.query_by_label("Bits per channel: 16").is_some();
        assert_eq!(has_bits, format == StillFormat::Png, "{name}");
    }
    press(&mut harness, "File: PNG");
    press(&mut harness, "Bits per channel: 16");
    assert!(saved(&mut harness).is_deep());
    press(&mut harness, "Background: Transparent");
    assert!(saved(&mut harness).is_transparent());
    press(&mut harness, "File: JPEG");
    let jpeg = saved(&mut harness);
    assert!(!jpeg.is_deep() && !jpeg.is_transparent(), "JPEGs have neither");
    assert!(harness.query_by_label("Background: Transparent").is_none());
    press(&mut harness, "Quality value");
    harness.get_by_label("Quality value").type_text("70");
    harness.key_press(Key::Enter);
    harness.run();
    assert_eq!(saved(&mut harness).quality, 70);
}

#[test]
fn an_export_shows_its_progress_and_can_be_cancelled() {
    let mut harness = workshop();
    harness.state_mut().export = Some(ExportProgress { done: 0.4, remaining_secs: Some(75.0) });
    harness.run();
    assert!(harness.query_by_label("Save picture").is_none());
    harness.get_by_label_contains("1 min 15 s left");
    press(&mut harness, "Cancel");
    assert_eq!(harness.state().actions, [Action::CancelExport]);
}

/// The progress and its button are always in sight: over the view where no panel shows them.
#[test]
fn a_file_that_is_saved_out_of_sight_can_be_cancelled() {
    // A phone's sheet is low at first, so that it has no fixed area for saving.
    for (size, key, is_over_view) in [
        ([1280.0, 720.0], None, false),
        ([1280.0, 720.0], Some(Key::P), true),
        ([390.0, 844.0], None, true),
        ([844.0, 390.0], None, false),
        ([844.0, 390.0], Some(Key::P), true),
    ] {
        let mut harness = stage(presets::opening(), Settings::default(), size);
        harness.run();
        if let Some(key) = key {
            harness.key_press(key);
            harness.run();
        }
        harness.state_mut().export = Some(ExportProgress { done: 0.3, remaining_secs: Some(75.0) });
        harness.run();
        let rects = harness.state().interface.rects();
        assert_eq!(rects.get("saving").is_some(), is_over_view, "{size:?}");
        let cancel = rects.get("cancel export").expect("a button");
        if is_over_view {
            let view = rects.get("view").expect("the view");
            assert!(view.contains_rect(rects.get("saving").expect("the message")), "{size:?}");
            assert!(harness.query_all_by_label("Saving, 1 min 15 s left").count() > 0);
        }
        // A drag without a way is a click.
        drag(&mut harness, cancel.center(), cancel.center(), 1);
        harness.run();
        assert_eq!(harness.state().actions, [Action::CancelExport], "{size:?}");
    }
}

/// Messages lie below the bar of a comparison and over no other message, in a low window too.
#[test]
fn messages_leave_a_comparison_free() {
    for size in [[1280.0, 720.0], [390.0, 844.0], [844.0, 390.0], [640.0, 420.0]] {
        let mut harness = stage(presets::opening(), Settings::default(), size);
        if size[1] < 500.0 {
            harness.key_press(Key::P);
        }
        harness.key_press_modifiers(Modifiers::SHIFT, Key::C);
        harness.run();
        let stage = harness.state_mut();
        stage.export = Some(ExportProgress { done: 0.3, remaining_secs: Some(75.0) });
        stage.reading = Some("evening.exr".to_owned());
        stage.notice = Some(Notice { text: "Link copied.".to_owned(), ..Notice::default() });
        harness.run();
        let rects = harness.state().interface.rects();
        let [bar, view] = ["compare", "view"].map(|name| rects.get(name).expect(name));
        let shown = |name: &&str| rects.get(name).map(|message| (name.to_string(), message));
        let messages: Vec<_> = ["notice", "saving", "reading"].iter().filter_map(shown).collect();
        for (index, (name, message)) in messages.iter().enumerate() {
            assert!(!message.intersects(bar), "{size:?}: {name} {message:?} over {bar:?}");
            assert!(view.contains_rect(*message), "{size:?}: {name} {message:?} in {view:?}");
            let over = messages[..index].iter().find(|(_, other)| other.intersects(*message));
            assert_eq!(over, None, "{size:?}: {name} {message:?}");
        }
        // In a wide window, the panel shows the export's progress.
        assert_eq!(rects.get("saving").is_some(), size[0] < 1000.0, "{size:?}");
        assert_eq!(messages.len(), if size[0] < 1000.0 { 3 } else { 2 }, "{size:?}: {messages:?}");
    }
}

/// The section's reset leaves the scene alone, and the timeline's choice.
#[test]
fn choices_of_files_are_reset() {
    let mut settings = unfolded();
    let start = settings.export;
    settings.export.times = 4;
    settings.export.pair = true;
    settings.export.file.deep_png = true;
    settings.export.sequence = SequenceFormat::WebM;
    let mut harness = stage(presets::opening(), settings, [1280.0, 6000.0]);
    harness.run_steps(3);
    let before = scene(&harness).clone();
    harness.get_by_label("Reset: Export").click_accesskit();
    harness.run_steps(3);
    let reset = harness.state().interface.settings().export;
    assert_eq!(reset, ExportSize { sequence: SequenceFormat::WebM, ..start });
    assert_eq!(*scene(&harness), before);
}
