//! Where the descents lead.
//!
//! A place is a point of the surface, to less than 1e-40, and is looked at along a line that is free
//! of the set, so that the eye can be at any distance from it.

use glam::DVec3;
use mandelight::scene::{Camera, EnvironmentLight, Fractal, Precise, PrecisePoint, Scene};

use super::super::{
    Failure,
    views::{sampled, sky, with_lights},
};

/// A point of the surface, and from where it is looked at.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// What scripts call it: after how orbits stretch what is near it.
    pub name: &'static str,
    /// The power.
    pub power: f64,
    /// The constant of the Julia form; none for the Mandelbulb.
    pub julia: Option<[f64; 3]>,
    /// Decimal coordinates, scene units.
    pub position: [&'static str; 3],
    /// The direction in which the camera looks; not of unit length.
    pub toward: [f64; 3],
}

/// All places. Conformal ones are points of the plane z = 0 whose orbit runs into a fixed point
/// (`z2 = ζ z1` with `ζⁿ = 1` gives `c = (ζ - 1)^(1 / (n - 1))`), or such a fixed point itself. The
/// others are where a line from outside first meets the set: anywhere, or 0.1 beside the polar axis.
pub const PLACES: &[Place] = &[
    Place {
        name: "conformal",
        power: 3.0,
        julia: None,
        position: [
            "0.340625019316606640194394244037830888977210102549",
            "1.27122987841870623913561299102106497672841432823",
            "0",
        ],
        toward: [0.0, 0.0, -1.0],
    },
    Place {
        name: "conformal",
        power: 8.0,
        julia: None,
        position: [
            "0.68257136882902142105137503578652510667498687857911",
            "0.46292302590335660302532018407856803563348800356107",
            "-0.2666242652612816459485751554970392623289494344804",
        ],
        toward: [-0.5520, 0.7582, -0.3470],
    },
    Place {
        name: "conformal",
        power: 12.0,
        julia: None,
        position: [
            "0.10339881467455826574459475973624584430730906979164",
            "0.93552397776866863264434292569877306909460154728858",
            "0.42887072999007297221158394586974193670433138142614",
        ],
        toward: [-0.294, -0.892, -0.3432],
    },
    Place {
        name: "conformal",
        power: 16.0,
        julia: None,
        position: [
            "-0.25320523641136427367188307375627683290204182106252",
            "-0.93158483371685788938865849998084757008586872465823",
            "-0.34024404390206245570880797307664487341300928440419",
        ],
        toward: [0.1283, 0.9022, -0.4118],
    },
    Place {
        name: "conformal",
        power: 8.0,
        julia: Some([0.35, -0.4, 0.0]),
        position: [
            "-0.258014845311127875322957510258163707577542529696",
            "1.02418620914762738298270837449663464495933913477",
            "0",
        ],
        toward: [0.0, 0.0, -1.0],
    },
    Place {
        name: "streaky",
        power: 3.0,
        julia: None,
        position: [
            "-0.200978488351332188321929847577278625285412931091",
            "-0.44345639264325540419759179582733981789992997689",
            "-0.300390676782559095586683184624292844657097166022",
        ],
        toward: [0.8208, 0.551, -0.1505],
    },
    Place {
        name: "streaky",
        power: 8.0,
        julia: None,
        position: [
            "0.15379861659292883236866770985698080436629960",
            "-0.84801966252866654201816769898541895762149767",
            "0.59761228259006374734788457605399937869280647",
        ],
        toward: [0.2891, 0.8866, -0.3611],
    },
    Place {
        name: "streaky",
        power: 12.0,
        julia: None,
        position: [
            "-0.624583312993549138571015242447251144539144695902",
            "0.397824719722455293883779259468198078972077960625",
            "-0.12601684855034846194808426514258116725043918867",
        ],
        toward: [0.6856, -0.6797, 0.2606],
    },
    Place {
        name: "streaky",
        power: 16.0,
        julia: None,
        position: [
            "0.635106817385233916887605642978620386488063633708",
            "0.390175522921465241789856085171649526774960603752",
            "-0.486253060445548189066504334850093803679518919051",
        ],
        toward: [-0.4383, -0.7234, 0.5334],
    },
    Place {
        name: "streaky",
        power: 8.0,
        julia: Some([0.35, -0.4, 0.55]),
        position: [
            "-0.200103829416416947050031586804906160284048664818",
            "-0.879708527491908104834725738324710002284964470526",
            "0.0121982609946070358669799491402226530536634296645",
        ],
        toward: [0.0212, 0.9873, -0.1575],
    },
    Place {
        name: "axis",
        power: 3.0,
        julia: None,
        position: [
            "-0.110698273910894229225105352986058551782279638187",
            "-0.00234216648570553753480740619485434363519463605176",
            "1.15982746822197904154787075205202699067914212217",
        ],
        toward: [0.2329, 0.3241, -0.9169],
    },
    Place {
        name: "axis",
        power: 8.0,
        julia: None,
        position: [
            "0.0399161309885311289340793443805527107004811898823",
            "-0.0885725825219676809803673117830941633647717235688",
            "1.0011508289445422995737950754137376387122024431",
        ],
        toward: [0.2723, 0.151, -0.9503],
    },
    Place {
        name: "axis",
        power: 12.0,
        julia: None,
        position: [
            "0.09564730144804614562218158945441047446416220965",
            "-0.0251882704788024174631001534352148847648620873974",
            "1.04959623718488673295059834133149570804171760526",
        ],
        toward: [0.0057, -0.0081, -1.0],
    },
    Place {
        name: "axis",
        power: 16.0,
        julia: None,
        position: [
            "-0.0196569331106062534860632941106932693960761836416",
            "-0.0941282263167320254734345834691310131704178244087",
            "1.04061751854538230060306204605205820032578659524",
        ],
        toward: [-0.227, 0.0624, -0.9719],
    },
    Place {
        name: "axis",
        power: 8.0,
        julia: Some([0.35, -0.4, 0.55]),
        position: [
            "-0.0884153873277945556624693116963983705073196391199",
            "0.0204530434884125124500367106750111485457664651851",
            "0.973389129648030285122154922686635987703098948152",
        ],
        toward: [-0.1255, 0.0128, -0.992],
    },
];

impl Place {
    /// The power as names have it, or `julia`.
    pub fn set(&self) -> String {
        if self.julia.is_some() { "julia".to_owned() } else { self.power.to_string() }
    }

    /// The scene that looks at it from `distance` away, scene units, in three lights whose shadows
    /// reach one view unit.
    ///
    /// # Errors
    /// Where a coordinate is no number.
    pub fn scene(&self, distance: f64) -> Result<Scene, Failure> {
        let [x, y, z] = self.position.map(str::parse::<Precise>);
        let point = PrecisePoint([x?, y?, z?]);
        let toward = DVec3::from_array(self.toward).normalize();
        let up = if toward.z.abs() < 0.99 { DVec3::Z } else { DVec3::Y };
        let camera = Camera::looking_at(-toward, DVec3::ZERO, up);
        let reaching = |light| EnvironmentLight { shadow_reach: Some(1.0), ..light };
        let mut scene = Scene {
            camera: Camera {
                position: point.moved_by(-toward * distance, 1e-6 * distance),
                pivot: point,
                ..camera
            },
            ..Default::default()
        };
        scene.fractal = Fractal {
            power: self.power,
            julia: self.julia.is_some(),
            julia_constant: self.julia.unwrap_or(scene.fractal.julia_constant),
            ..scene.fractal
        };
        Ok(sampled(with_lights(scene, sky().into_iter().map(reaching).collect()), 1))
    }
}
