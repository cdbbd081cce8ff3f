//! Every number of the scene document: its unit, range, default and help text.
//!
//! This is the one place, but for a formula's own parameters, which its table holds. The document's
//! checks, the panels' sliders, the command line and `docs/scene.md` all read both (a test holds the
//! docs to them).

pub use crate::formula::param::{BAILOUT, ITERATIONS, Param, SECTION_BAND_REACH, Scale, Unit};
use crate::formula::{
    self, FormulaRef,
    param::{SHARED, params},
    table::Field,
};

/// Every parameter of a scene of `formula`, in document order.
pub fn of(formula: FormulaRef) -> impl Iterator<Item = &'static Param> {
    let own = formula.fields().iter().filter_map(Field::param);
    SHARED.iter().copied().chain(own).chain(SCENE.iter().copied())
}

/// The parameters of a fractal: those that all formulas share, then each formula's own.
fn fractal() -> impl Iterator<Item = &'static Param> {
    let own = formula::all().flat_map(|formula| formula.fields()).filter_map(Field::param);
    SHARED.iter().copied().chain(own)
}

/// Every parameter of every formula and of the rest of the scene, in document order.
pub fn all() -> impl Iterator<Item = &'static Param> {
    fractal().chain(SCENE.iter().copied())
}

/// The parameter that governs the field at `path`, such as `lights.environment[2].intensity`. Where
/// formulas have a field of the same name, the first formula's. The second layer of colours has the parameters
/// of the first.
pub fn find(path: &str) -> Option<&'static Param> {
    let at = |path: &str| all().find(|param| param.is_at(path));
    at(path).or_else(|| at(&path.replacen("surface.second_layer.", "surface.", 1)))
}

params! {
    /// Every parameter outside of the fractal, in document order.
    SCENE;
    VERTICAL_FOV = "camera.vertical_fov_deg", "Field of view", Degrees, 5.0, 120.0, default 40.0, Linear by 1.0,
        "How wide the camera sees, from the lower to the upper edge (in a tall picture, from left to right). Wider shows more and distorts more.";
    F_NUMBER = "camera.lens.f_number", "f-number", None, 0.5, 64.0, default 2.8, Logarithmic by 0.1,
        "The lens's aperture. Lower blurs what is out of focus more.";
    FOCUS = "camera.lens.focus", "Focus", ViewUnits, 0.01, 100.0, default 1.0, Logarithmic by 0.01,
        "The distance at which the picture is sharp. 1 is the pivot, which the view turns about.";
    BLADES = "camera.lens.blades", "Blades", Count, 2.0, 9.0, default 2.0, Integer by 1.0,
        "Number of the aperture's blades: 5 draws bright points as pentagons. 2: discs.";
    SCREEN_HEIGHT = "camera.stereo.screen_height_cm", "Screen height", Centimetres, 2.0, 1000.0, default 30.0, Logarithmic by 1.0,
        "The height of the picture on your screen or print. Larger gives a wider field of view.";
    EYE_DISTANCE = "camera.stereo.eye_distance_cm", "Eye to screen", Centimetres, 5.0, 2000.0, default 60.0, Logarithmic by 1.0,
        "The distance from your eyes to the screen. Smaller gives a wider field of view and more depth.";
    EYE_SEPARATION = "camera.stereo.eye_separation_cm", "Eye separation", Centimetres, 0.0, 20.0, default 6.4, Linear by 0.1,
        "The distance between your eyes, about 6.4 cm. Less is flatter; 0 has no depth.";
    ENVIRONMENT_INTENSITY = "lights.environment[].intensity", "Intensity", None, 0.0, 100.0, default 1.0, Logarithmic by 0.05,
        "Brightness of the light. At 1, a white surface that faces the light is white.";
    ENVIRONMENT_SIZE = "lights.environment[].size_deg", "Size", Degrees, 0.0, 90.0, default 0.0, Logarithmic by 0.5,
        "How large the light looks: 0.5 as the sun, 40 as a window. Larger softens the shadows while the picture refines.";
    SHADOW_REACH = "lights.environment[].shadow_reach", "Shadow reach", ViewUnits, 0.001, 1000.0, default 1.0, Logarithmic by 0.1,
        "Maximum distance at which a surface casts a shadow. Shorter brightens crevices and is faster.";
    POINT_INTENSITY = "lights.point[].intensity", "Intensity", None, 0.0, 10000.0, default 1.0, Logarithmic by 0.05,
        "Brightness of the light at a distance of one scene unit. Twice the distance gives a quarter of the light.";
    POINT_RADIUS = "lights.point[].radius", "Radius", SceneUnits, 0.0, 10.0, default 0.0, Logarithmic by 0.01,
        "Radius of the glowing ball. Larger softens the shadows while the picture refines.";
    RIG_COUNT = "lights.rig.count", "Sky lights", Count, 3.0, 64.0, default 16.0, Integer by 1.0,
        "Number of lights that represent the sky or the environment map. More gives softer, more exact light and is slower.";
    RIG_INTENSITY = "lights.rig.intensity", "Sky brightness", None, 0.0, 100.0, default 1.0, Logarithmic by 0.05,
        "Brightness of the light of the sky or the environment map, and of that map as the background.";
    RIG_SHADOW_REACH = "lights.rig.shadow_reach", "Sky reach", ViewUnits, 0.001, 1000.0, default 1.0, Logarithmic by 0.1,
        "Maximum distance at which a surface casts a shadow from the light of the sky or the environment map. Shorter brightens crevices and is faster.";
    SUN_STRENGTH = "lights.rig.sky.sun_strength", "Sun strength", None, 0.0, 100.0, default 2.0, Logarithmic by 0.05,
        "Brightness of the sun. At 1, a white surface that faces the sun is white.";
    SUN_SIZE = "lights.rig.sky.sun_size_deg", "Sun size", Degrees, 0.0, 45.0, default 6.0, Linear by 0.5,
        "Width of the sun in the sky. Wider softens shadows if several lights form the sun.";
    SUN_LIGHTS = "lights.rig.sky.sun_lights", "Sun lights", Count, 1.0, 32.0, default 1.0, Integer by 1.0,
        "Number of the rig's lights that form the sun. More gives softer shadows for a wide sun.";
    RIG_ROTATION = "lights.rig.picture.rotation_deg", "Rotation", Degrees, -180.0, 180.0, default 0.0, Linear by 1.0,
        "Rotates the environment map and its lights around the vertical axis, counterclockwise from above.";
    AMBIENT = "surface.ambient", "Ambient", None, 0.0, 1.0, default 0.04, Linear by 0.01,
        "Brightens shadows: a constant part of the surface's colour, without any light. Path tracing leaves it out.";
    DIFFUSE = "surface.diffuse", "Diffuse", None, 0.0, 1.0, default 0.9, Linear by 0.01,
        "Brightness of the matte surface under the lights.";
    SPECULAR = "surface.specular", "Specular", None, 0.0, 1.0, default 0.25, Linear by 0.01,
        "Brightness of the highlights.";
    SHININESS = "surface.shininess", "Shininess", None, 1.0, 1000.0, default 40.0, Logarithmic by 1.0,
        "Size of the highlights: higher is smaller and sharper (Blinn-Phong exponent).";
    ROUGHNESS = "surface.roughness", "Roughness", None, 0.0, 1.0, default 0.4, Linear by 0.01,
        "Blur of reflections: 0 is a mirror, 1 is matte.";
    METALNESS = "surface.metalness", "Metalness", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "Makes the surface metallic: 0 is plastic or stone, 1 is metal in the surface's colour.";
    COAT = "surface.coat", "Clear coat", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "Amount of clear varnish: adds sharp, colourless reflections.";
    COAT_ROUGHNESS = "surface.coat_roughness", "Coat roughness", None, 0.0, 1.0, default 0.1, Linear by 0.01,
        "Blur of the clear coat's reflections: 0 is a mirror.";
    EMISSION = "surface.emission", "Emission", None, 0.0, 100.0, default 0.0, Logarithmic by 0.05,
        "How brightly the surface glows in its own colour. With path tracing the glow lights nearby surfaces.";
    TRAP_CENTER = "surface.coloring.center[]", "Centre", SceneUnits, -8.0, 8.0, default 0.0, Linear by 0.05,
        "Centre of the orbit trap. Moving it moves the pattern of colours over the surface.";
    TRAP_SIZE = "surface.coloring.size", "Size", SceneUnits, 0.01, 8.0, default 1.0, Logarithmic by 0.05,
        "Radius of the sphere, or half the width of the cube, that orbits are measured against.";
    COLOR_REPEATS = "surface.coloring.repeats", "Repeats", None, 0.01, 50.0, default 1.0, Logarithmic by 0.05,
        "How often the gradient repeats over the surface. More gives narrower bands of colour.";
    COLOR_OFFSET = "surface.coloring.offset", "Offset", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "Shifts the colours along the gradient; 0 and 1 are equal.";
    STOP_POSITION = "surface.gradient[].position", "Position", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "Position of the colour in the gradient.";
    SECOND_LAYER_AMOUNT = "surface.second_layer.amount", "Amount", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "How much the second layer covers the first. 0 is off, 1 shows the second layer alone.";
    SECTION_REPEATS = "surface.sections.repeats", "Repeats", None, 0.01, 4.0, default 0.25, Logarithmic by 0.01,
        "How often the gradient repeats per iteration on section planes. More gives narrower bands.";
    MEAN_FREE_PATH = "medium.mean_free_path", "Clarity", ViewUnits, 0.001, 10.0, default 0.05, Logarithmic by 0.05,
        "How far light gets inside before it scatters (mean free path): low looks solid as stone, high clear as glass.";
    MEDIUM_ANISOTROPY = "medium.anisotropy", "Forward glow", None, -0.9, 0.9, default 0.0, Linear by 0.01,
        "Above 0 it is brightest when you look toward the light, below 0 with the light behind you; 0 is even.";
    THIN_ITERATIONS = "medium.thin_iterations", "Clear below", None, 0.0, 1000.0, default 2.0, Logarithmic by 0.05,
        "Iteration count below which the cloud is empty. Lower widens the cloud.";
    DENSE_ITERATIONS = "medium.dense_iterations", "Dense above", None, 0.0, 1000.0, default 8.0, Logarithmic by 0.05,
        "Iteration count above which the cloud is densest. Lower makes a harder edge.";
    FOG_DENSITY = "fog.density", "Fog", PerViewUnit, 0.0, 100.0, default 0.0, Logarithmic by 0.01,
        "How thick the fog is. 0 is none; at 1 about a third of the light reaches the pivot.";
    FOG_ANISOTROPY = "fog.anisotropy", "Forward glow", None, -0.9, 0.9, default 0.3, Linear by 0.01,
        "Above 0 it is brightest when you look toward the light, below 0 with the light behind you; 0 is even.";
    FOG_HEIGHT = "fog.height", "Fog falloff", ViewUnits, 0.01, 100.0, default 0.5, Logarithmic by 0.05,
        "How fast the fog thins above its level: over this height to about a third.";
    FOG_LEVEL = "fog.level", "Fog level", ViewUnits, -10.0, 10.0, default -0.5, Linear by 0.01,
        "Height, over the pivot, up to which the fog is thickest.";
    FOG_RADIUS = "fog.radius", "Fog radius", ViewUnits, 0.05, 1000.0, default 3.0, Logarithmic by 0.05,
        "Distance from the pivot at which the fog ends. Lights outside are dimmed by the fog that they shine through.";
    EXPOSURE = "tone.exposure", "Exposure", Stops, -10.0, 10.0, default 0.0, Linear by 0.1,
        "Brightens or darkens the picture; +1 doubles the light.";
    KEY = "tone.key", "Key", None, 0.01, 1.0, default 0.18, Logarithmic by 0.01,
        "Brightness that auto exposure aims for. Higher is brighter; 0.18 is middle grey.";
    WHITE_POINT = "tone.white_point", "White point", None, 0.5, 100.0, default 4.0, Logarithmic by 0.1,
        "The brightness that becomes pure white. Higher keeps more detail in highlights.";
    INDIRECT_RADIUS = "indirect.radius", "Radius", None, 0.002, 0.25, default 0.06, Logarithmic by 0.05,
        "How far surfaces influence each other, as a fraction of the picture's height.";
    INDIRECT_STRENGTH = "indirect.strength", "Strength", None, 0.0, 4.0, default 1.0, Linear by 0.05,
        "Brightness of the indirect light.";
    INDIRECT_AMBIENT = "indirect.ambient", "Ambient factor", None, 0.0, 2.0, default 0.1, Linear by 0.01,
        "Fills shadows with soft light, less in corners and crevices.";
    INDIRECT_DIRECTIONS = "indirect.directions", "Directions", Count, 2.0, 32.0, default 8.0, Integer by 1.0,
        "Number of directions to sample around each pixel. More is smoother and slower.";
    INDIRECT_SAMPLES = "indirect.samples", "Samples", Count, 1.0, 16.0, default 5.0, Integer by 1.0,
        "Number of samples per direction. More is smoother and slower.";
    BOUNCES = "integrator.bounces", "Bounces", Count, 0.0, 64.0, default 8.0, Integer by 1.0,
        "How many times light may change direction, at surfaces, in fog and in media. More brightens crevices and translucent sets and takes longer. 0: only direct light.";
    BOUNCE_REACH = "integrator.reach", "Bounce reach", ViewUnits, 0.001, 1000.0, default 1.0, Logarithmic by 0.1,
        "How far bounced light travels; 1 is the distance to the pivot. Shorter is faster; under a sky, shorter also brightens crevices.";
    NOISE = "integrator.noise", "Stop at noise", None, 0.0, 0.5, default 0.0, Logarithmic by 0.001,
        "Stops each pixel at this noise: 0.02 looks clean, 0.1 is grainy but fast. 0 always takes all samples.";
    FIREFLY_LIMIT = "integrator.firefly_limit", "Firefly limit", None, 0.1, 10000.0, default 10.0, Logarithmic by 0.1,
        "Makes single paths no brighter than this, since they leave bright dots. Lower removes more dots, and more light.";
    BLOOM_STRENGTH = "bloom.strength", "Strength", None, 0.0, 1.0, default 0.0, Linear by 0.01,
        "Brightness of the glow around bright spots. 0 is off and costs nothing.";
    BLOOM_RADIUS = "bloom.radius", "Radius", None, 0.005, 0.25, default 0.04, Logarithmic by 0.05,
        "Width of the glow, as a fraction of the picture's height.";
    BLOOM_THRESHOLD = "bloom.threshold", "Threshold", None, 0.0, 10.0, default 0.5, Logarithmic by 0.05,
        "Only pixels brighter than this glow. At 0 all pixels glow, as in the thesis.";
    BLOOM_PASSES = "bloom.passes", "Passes", Count, 1.0, 4.0, default 3.0, Integer by 1.0,
        "Shape of the glow: 1 is square, as in the thesis; 3 and more are round.";
    MOTION_BUDGET = "quality.motion_budget_ms", "Time per frame", Milliseconds, 4.0, 200.0, default 16.0, Logarithmic by 1.0,
        "Longest GPU time of a frame while the picture moves. Higher is sharper and choppier.";
    SAMPLES = "quality.samples", "Samples", Count, 1.0, 65536.0, default 16.0, Integer by 1.0,
        "Number of samples per pixel at rest. More gives smoother edges and less grain, and takes longer.";
    DETAIL = "quality.detail", "Detail", Footprints, 0.1, 8.0, default 1.0, Logarithmic by 0.1,
        "Size of the finest visible detail, in pixels. Lower is finer and slower.";
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_the_parameter_of_an_indexed_path() {
        assert_eq!(find("lights.environment[12].intensity"), Some(&ENVIRONMENT_INTENSITY));
        assert_eq!(find("fractal.julia_constant[2]").map(|p| p.label), Some("Julia constant"));
        assert_eq!(find("fractal.bailout"), Some(&BAILOUT));
        assert_eq!(find("fractal.variant"), None);
        assert_eq!(find("lights.environment[[[].intensity]"), None);
    }

    #[test]
    fn every_table_row_is_consistent() {
        for (i, param) in all().enumerate() {
            assert!(param.min < param.max && param.step > 0.0, "{}", param.path);
            assert!(param.accepts(param.default), "{}: default", param.path);
            assert!(
                param.path.matches("[]").count() <= 1,
                "{}: path_at fills one index",
                param.path
            );
            assert!(param.is_at(&param.path_at(i)));
        }
    }

    #[test]
    fn ranges_read_well() {
        assert_eq!(VERTICAL_FOV.range_text(), "5 to 120 degrees");
        assert_eq!(SAMPLES.range_text(), "1 to 65536, whole numbers");
        assert_eq!(AMBIENT.range_text(), "0 to 1");
    }
}
