//! docs/scene.md on hits and shadows: the numbers of the march.

use mandelight::{
    formula::{
        mandelbulb::Mandelbulb,
        march::{CHECKED_THICKNESS, MarchPolicy, THICKNESS_CHECKS},
    },
    scene::Fractal,
};

#[test]
fn the_docs_state_when_rays_hit_and_shadow_rays_are_blocked() {
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/docs/scene.md")).unwrap();
    let (_, rest) = text.split_once("## Hits and shadows\n").expect("the section");
    let section = rest.split_once("\n## ").expect("the next section").0.replace('\n', " ");
    let policy = |power: f64| {
        let fractal = Fractal::from(Mandelbulb { power, ..Default::default() });
        fractal.formula().march_policy(&fractal)
    };
    let (usual, low) = (policy(4.0), policy(3.0));
    let of_shadows = |policy: &MarchPolicy| [policy.shadow_cone, policy.shadow_margin];
    assert!(policy(3.9).checks_hits && !usual.checks_hits);
    assert_eq!(of_shadows(&policy(2.0)), of_shadows(&low));
    assert_eq!(of_shadows(&usual), of_shadows(&MarchPolicy::default()));
    let [[cone, margin], [low_cone, low_margin]] = [of_shadows(&usual), of_shadows(&low)];
    for sentence in [
        "a power below 4".to_owned(),
        format!(
            "for {CHECKED_THICKNESS} hit distances along the ray, evaluated at {THICKNESS_CHECKS} points"
        ),
        format!("below {cone} times the distance to the point"),
        format!("or below {margin} hit distances of the point"),
        format!("At powers up to 3 the factors are {low_cone} and {low_margin}"),
    ] {
        assert!(section.contains(&sentence), "docs/scene.md does not say: {sentence}");
    }
}
