//! Links: what is shared is seen, and no address does harm.

use base64::{Engine, engine::general_purpose::URL_SAFE_NO_PAD};
use mandelight::scene::link::{from_fragment, to_fragment};
use mandelight_test_support::scenes::scene;
use proptest::{collection::vec, prelude::*, sample::Index};

proptest! {
    #[test]
    fn a_link_holds_its_scene_exactly(scene in scene()) {
        let fragment = to_fragment(&scene).unwrap();
        prop_assert!(fragment.bytes().all(|b| b.is_ascii_alphanumeric() || b"=-_".contains(&b)));
        prop_assert_eq!(from_fragment(&fragment), Ok(scene));
    }

    #[test]
    fn any_fragment_is_read_or_refused(text in ".{0,100}", bytes in vec(any::<u8>(), 0..200)) {
        for fragment in [text.clone(), format!("#s1={text}"), format!("s1={}", URL_SAFE_NO_PAD.encode(&bytes))] {
            if let Ok(scene) = from_fragment(&fragment) {
                scene.validate().unwrap();
            }
        }
    }

    #[test]
    fn any_deflated_text_is_read_or_refused(text in "[\\[\\]{}\",:0-9a-z .-]{0,80}") {
        let deflated = miniz_oxide::deflate::compress_to_vec(text.as_bytes(), 6);
        if let Ok(scene) = from_fragment(&format!("#s1={}", URL_SAFE_NO_PAD.encode(deflated))) {
            scene.validate().unwrap();
        }
    }

    #[test]
    fn a_changed_link_is_read_or_refused(scene in scene(), at in any::<Index>(), letter in "[A-Za-z0-9_-]") {
        let mut fragment = to_fragment(&scene).unwrap();
        let at = at.index(fragment.len());
        fragment.replace_range(at..=at, &letter);
        if let Ok(scene) = from_fragment(&fragment) {
            scene.validate().unwrap();
        }
    }
}
