//! The places that descents lead to.
//!
//! A place is a point of the surface, exact to less than 1e-40. The straight line from the eye
//! to that point is free of the set, so the eye can be at any distance.

use glam::DVec3;
use mandelight::{
    formula::mandelbulb::Mandelbulb,
    scene::{Camera, EnvironmentLight, Precise, PrecisePoint, Scene},
};

use super::super::{
    failure::Failure,
    views::{sampled, sky, with_lights},
};

/// A point of the surface and a viewing direction.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The kind of place, by how orbits stretch its neighbourhood.
    pub name: &'static str,
    /// The power.
    pub power: f64,
    /// The constant of the Julia form; none for the Mandelbulb.
    pub julia: Option<[f64; 3]>,
    /// Decimal coordinates of the point, scene units.
    pub position: [&'static str; 3],
    /// The viewing direction; not of unit length.
    pub toward: [f64; 3],
}

/// All places; the set fills their views at nearly every distance.
///
/// `streaky` places of powers 8, 12 and 16 are the first points of the set on a line from
/// outside. All others have an orbit that ends in a repelling cycle (found by Newton's method).
/// The cycle's Jacobian is close to a similarity at `conformal` places, and anisotropic at
/// `streaky` ones and at `axis` of power 3. `axis` places are 0.1 from the polar axis.
pub const PLACES: &[Place] = &[
    Place {
        name: "conformal",
        power: 3.0,
        julia: None,
        position: [
            "0.69158194808243001324103700767205633251251504556293",
            "0.12562570266753811678532165763834990726666426558321",
            "0.53880996803783997870877379378462110432625576519895",
        ],
        toward: [0.249, 0.0752, -0.9656],
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
        julia: Some([0.35, -0.4, 0.55]),
        position: [
            "0.42395438263272846182112932473210441068586842185676",
            "0.81351589162577727801829158688303593736902664046827",
            "0.12544432149322510994157628644558351928069027277377",
        ],
        toward: [-0.5867, -0.8082, -0.0508],
    },
    Place {
        name: "streaky",
        power: 3.0,
        julia: None,
        position: [
            "0.63597586400386586647493575215398503394086875859056",
            "0.12534810068959721873885520154195493065345500532788",
            "-0.58497421928294876703806400118011113782692065246462",
        ],
        toward: [-0.324, -0.3836, 0.8648],
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
            "-0.34822667045124508554081489789675072918172875760565",
            "-0.54776133033975302981234401529446175446994262582574",
            "0.71616454770622183065414046604866515857732704175912",
        ],
        toward: [0.201, 0.2971, -0.9335],
    },
    Place {
        name: "axis",
        power: 3.0,
        julia: None,
        position: [
            "-0.085658585843068861132792968782714713114894565414442",
            "-0.0222626423089897518018652348252627552376551467024",
            "-1.2322122179391021881740479890661777571596177481894",
        ],
        toward: [-0.3395, 0.1064, 0.9346],
    },
    Place {
        name: "axis",
        power: 8.0,
        julia: None,
        position: [
            "0.098207514022632067752816693459665518959493940845626",
            "0.040231371825469298917866301131094968961413334952355",
            "-1.050131283332254686811693076529360744643087796861",
        ],
        toward: [0.6191, 0.7736, -0.1354],
    },
    Place {
        name: "axis",
        power: 12.0,
        julia: None,
        position: [
            "-0.0050242880523898692941900051162088469797404487979099",
            "0.099416327305660649724236408881758115682080299109921",
            "-1.0355332743004821507559420552067552352637039197642",
        ],
        toward: [0.1883, 0.6421, 0.7431],
    },
    Place {
        name: "axis",
        power: 16.0,
        julia: None,
        position: [
            "-0.095901911353438929942215729689003181336324262366661",
            "-0.021407118628418131531911115804991348833149895874054",
            "-1.0400860566455719006819144864876742224972548635178",
        ],
        toward: [0.157, 0.7729, 0.6147],
    },
    Place {
        name: "axis",
        power: 8.0,
        julia: Some([0.35, -0.4, 0.55]),
        position: [
            "-0.069801609182910520722617847498889573492107080289897",
            "0.058747765627336418097315504240049268852556939832497",
            "-0.76682508713240165385260095957195909541129780958951",
        ],
        toward: [0.4165, -0.5952, 0.6872],
    },
];

impl Place {
    /// The power as part of a name, or `julia`.
    pub fn set(&self) -> String {
        if self.julia.is_some() { "julia".to_owned() } else { self.power.to_string() }
    }

    /// The scene seen from `distance`, scene units, in three lights.
    ///
    /// Shadows reach one view unit.
    ///
    /// # Errors
    /// If a coordinate is not a number.
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
        scene.fractal = Mandelbulb {
            power: self.power,
            julia: self.julia.is_some(),
            julia_constant: self.julia.unwrap_or(Mandelbulb::of(&scene.fractal).julia_constant),
            ..Mandelbulb::of(&scene.fractal)
        }
        .into();
        Ok(sampled(with_lights(scene, sky().into_iter().map(reaching).collect()), 1))
    }
}
