//! What the view paints, one layer over another: a slow GPU takes long for each.

use egui::{Rect, Shape, TextureId};
use egui_kittest::Harness;
use mandelight::{
    scene::presets,
    ui::{KeptPicture, Settings, ViewTexture},
};

use crate::stage::*;

/// The layers that cover a part of the view with nothing but a picture or its ground, the lowest first.
fn layers(harness: &Harness<'_, Stage>, view: Rect) -> Vec<TextureId> {
    let large = |shape: &&Shape| {
        let painted = shape.visual_bounding_rect().intersect(view);
        painted.is_positive() && painted.area() > 0.2 * view.area()
    };
    let filled = |shape: &&Shape| matches!(shape, Shape::Rect(_) | Shape::Mesh(_));
    shapes(harness).into_iter().filter(filled).filter(large).map(Shape::texture_id).collect()
}

#[test]
fn nothing_is_painted_below_a_picture_that_covers_it() {
    const NEWEST: TextureId = TextureId::User(1);
    const KEPT: TextureId = TextureId::User(2);
    let mut harness = stage(presets::opening(), Settings::default(), [1280.0, 720.0]);
    harness.run();
    let view = harness.state().interface.rects().get("view").expect("the view");
    let before = layers(&harness, view);
    assert!(!before.is_empty(), "the ground");

    let size_px = [view.width(), view.height()].map(|side| side.round() as u32);
    let picture = ViewTexture { texture: NEWEST, size_px };
    harness.state_mut().picture = Some(picture);
    harness.step();
    assert_eq!(layers(&harness, view).len(), before.len(), "the picture takes the ground's place");
    assert!(layers(&harness, view).contains(&NEWEST));

    // A kept picture that leaves the edges free lies on the newest one.
    let [width, height] = size_px;
    let narrow = ViewTexture { texture: KEPT, size_px: [width / 2, height] };
    harness.state_mut().kept_picture = Some(KeptPicture { picture: narrow, span: 1.0 });
    harness.step();
    let both = layers(&harness, view);
    assert_eq!(both[both.len() - 2..], [NEWEST, KEPT], "{both:?}");

    // One that covers the view is all that is painted.
    let whole = ViewTexture { texture: KEPT, size_px };
    harness.state_mut().kept_picture = Some(KeptPicture { picture: whole, span: 1.0 });
    harness.step();
    assert_eq!(layers(&harness, view).len(), before.len());
    assert!(!layers(&harness, view).contains(&NEWEST));
}
