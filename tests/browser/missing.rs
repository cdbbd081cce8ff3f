//! What a page says of which a part does not arrive.

use crate::visit::Visit;

#[test]
fn a_page_without_one_of_its_parts_says_so_and_opens_once_it_is_there() {
    let visit = Visit::run("missing");
    assert!(visit.text("/alone").contains("did not arrive"));
    for (name, said, raw) in [
        ("unreachable", "did not arrive", "no connection"),
        ("gone", "did not arrive", "404"),
        ("script", "did not arrive", "mandelight-"),
        ("document_for_script", "did not arrive", "mandelight-"),
        ("damaged", "arrived damaged", "WebAssembly"),
    ] {
        visit.assert_legible(&format!("/texts/{name}"));
        let notice = &visit.seen["notices"][name];
        assert_eq!(notice["again"], "Try again", "{name}");
        let detail = notice["detail"].as_str().unwrap();
        // The browser's own words, if any, stand alone at the end.
        let (words, own) = detail.rsplit_once("\n\n").unwrap_or_else(|| panic!("{name}: {detail}"));
        assert!(words.contains(said) && !words.contains("http"), "{name}: {words}");
        assert!(own.contains(raw), "{name}: {own}");
        assert_eq!(*notice, visit.seen["later"][name], "{name}: the notice gave way");
    }
}
