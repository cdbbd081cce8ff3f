//! The measured views: scenes, sizes and sample counts.

use glam::DVec3;
use mandelight::scene::{Camera, EnvironmentLight, Lights, Quality, Scene, ToneChannels};

/// A measured view.
#[derive(Clone, Debug)]
pub struct View {
    /// The name for `--views` and in `ratio` lines.
    pub name: &'static str,
    /// A description in one line.
    pub about: &'static str,
    /// The scene, including its number of samples.
    pub scene: Scene,
    /// Width and height, pixels.
    pub size_px: [u32; 2],
    /// The literal kernel draws one of this many blocks of 8x8 pixels along each axis.
    ///
    /// Its time is scaled up to all blocks.
    pub stride: u32,
    /// Bound of the mean error of normals, degrees.
    pub normals_within_deg: f64,
    /// True if pictures take so long that half the rounds suffice.
    pub is_long: bool,
}

/// Width and height of most views, pixels.
pub const SIZE_PX: [u32; 2] = [960, 540];

/// All views, in the order of measurement.
pub fn all() -> Vec<View> {
    let lit = |lights: Vec<EnvironmentLight>| with_lights(filled(), lights);
    vec![
        view("whole", "the whole Mandelbulb", whole()),
        view("filled", "a picture filled by it, at a distance of 0.15", filled()),
        deep_view("crevice", "a crevice, partly in shadow, at a distance of 1e-3", crevice()),
        view("julia", "the Julia form of power 8", julia()),
        view("power2", "power 2", powered(2.0, [0.9, -1.75, 1.3], [-0.2, 0.0, 0.0])),
        view("power3", "power 3", powered(3.0, [1.7, -2.3, 1.95], [0.0; 3])),
        view("power16", "power 16", powered(16.0, [1.5, -2.3, 1.2], [0.0; 3])),
        view("lights1", "the filled view in one light", lit(sky()[..1].to_vec())),
        view("lights16", "the filled view in sixteen lights", lit(many_lights(16))),
        View {
            size_px: [1920, 1080],
            stride: 4,
            is_long: true,
            ..view("job", "the thesis's job: the filled view, 16 samples, tone mapped", job())
        },
        View {
            stride: 2,
            is_long: true,
            ..deep_view("crevice16", "the crevice with 16 samples", sampled(crevice(), 16))
        },
    ]
}

fn view(name: &'static str, about: &'static str, scene: Scene) -> View {
    let normals_within_deg = 1.0;
    View { name, about, scene, size_px: SIZE_PX, stride: 1, normals_within_deg, is_long: false }
}

/// A view at 1e-3 of the surface, where f32 rounding begins to show in normals.
fn deep_view(name: &'static str, about: &'static str, scene: Scene) -> View {
    View { normals_within_deg: 3.0, ..view(name, about, scene) }
}

/// The view of the whole Mandelbulb.
pub fn whole() -> Scene {
    scene([1.57, -2.88, 1.05], [0.0, 0.0, 0.0], [0.0, 0.0, 1.0])
}

/// The filled view.
pub fn filled() -> Scene {
    scene(
        [0.1385390, -0.3897377, 1.0369570],
        [0.0352275, -0.2738807, 0.7802395],
        [0.32164, -0.83080, 0.45423],
    )
}

fn crevice() -> Scene {
    scene(
        [0.6144420, -0.6200878, -0.2452360],
        [0.6148446, -0.6203554, -0.2471768],
        [0.46384, -0.55397, 0.69135],
    )
}

fn julia() -> Scene {
    let mut scene = scene([1.6, -2.7, 1.45], [0.0; 3], [0.0, 0.0, 1.0]);
    scene.fractal.set("julia", true);
    scene
}

fn powered(power: f64, eye: [f64; 3], at: [f64; 3]) -> Scene {
    let mut scene = scene(eye, at, [0.0, 0.0, 1.0]);
    scene.fractal.set("power", power);
    if power < 2.5 {
        // With an iteration limit below 18 some rays end too early at 960x540.
        scene.fractal.iterations = 20;
    }
    scene
}

/// The filled view with the thesis's settings: 16 samples, tone mapped per channel.
fn job() -> Scene {
    let mut scene = sampled(filled(), 16);
    scene.tone.channels = ToneChannels::PerChannel;
    scene.tone.auto_exposure = true;
    scene
}

/// A scene with another number of samples.
pub fn sampled(mut scene: Scene, samples: u32) -> Scene {
    scene.quality.samples = samples;
    scene
}

/// A scene with other lights.
pub fn with_lights(mut scene: Scene, lights: Vec<EnvironmentLight>) -> Scene {
    scene.lights.environment = lights;
    scene
}

/// Lights spread evenly over the sky, with the total intensity of three.
pub fn many_lights(count: u32) -> Vec<EnvironmentLight> {
    let golden_rad = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
    let one = |k: u32| {
        let z = 1.0 - 1.6 * (f64::from(k) + 0.5) / f64::from(count);
        let (sin, cos) = (golden_rad * f64::from(k)).sin_cos();
        let rho = (1.0 - z * z).sqrt();
        light([rho * cos, rho * sin, z], [1.0, 0.92, 0.85], 4.8 / f64::from(count))
    };
    (0..count).map(one).collect()
}

/// Three lights: a warm key, a cool rim, a faint fill.
pub fn sky() -> Vec<EnvironmentLight> {
    vec![
        light([-0.35, -0.75, 0.8], [1.0, 0.86, 0.68], 2.6),
        light([0.6, 0.75, 0.35], [0.6, 0.75, 1.0], 1.4),
        light([0.7, -0.5, 0.45], [0.75, 0.65, 1.0], 0.8),
    ]
}

/// A light whose shadows reach through the whole scene, as in the thesis.
pub fn light(direction: [f64; 3], color: [f32; 3], intensity: f64) -> EnvironmentLight {
    let direction = DVec3::from_array(direction).normalize().to_array();
    EnvironmentLight { direction, color, intensity, shadow_reach: None, ..Default::default() }
}

/// The Mandelbulb of power 8 in three lights, one sample a pixel.
fn scene(eye: [f64; 3], at: [f64; 3], up: [f64; 3]) -> Scene {
    let [eye, at, up] = [eye, at, up].map(DVec3::from_array);
    Scene {
        camera: Camera::looking_at(eye, at, up),
        lights: Lights { environment: sky(), point: Vec::new(), ..Default::default() },
        quality: Quality { samples: 1, ..Default::default() },
        ..Default::default()
    }
}
