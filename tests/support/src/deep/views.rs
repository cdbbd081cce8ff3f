//! The views: anchors on the surface, and from where they are looked at.

use glam::DVec3;
use mandelight::{
    formula::mandelbulb::{Mandelbulb, Sine},
    scene::{Camera, PrecisePoint, Scene},
};

use super::rays::Size;

/// Width and height of a picture from `scale` away. Smaller ones from afar have pixels as wide as the
/// set's largest parts, of which no step is short enough.
pub fn size(scale: f64) -> Size {
    if scale < 1.0 { [36, 24] } else { [96, 64] }
}

/// Size of the pictures that candidates are judged by, and that rays are picked from.
pub const SMALL: Size = [12, 8];

/// How far away the eye is from the anchor, scene units.
pub const SCALES: [f64; 7] = [1.0, 1e-3, 1e-6, 1e-9, 1e-13, 1e-20, 1e-27];

/// A point of the surface, to less than 1e-30, and the direction it is looked at along.
pub struct Anchor {
    pub power: f64,
    /// Of the Julia form, with the document's constant.
    pub julia: bool,
    pub name: &'static str,
    pub position: [&'static str; 3],
    pub toward: [f64; 3],
    /// The closest view.
    pub deepest: f64,
}

/// Where `search` arrived, of which these are views that the march itself agrees about: rays through
/// 1e-5 of a pixel beside the centres, in steps of 0.6 times the length, arrive within a footprint on
/// all but one of 96 pixels at most (`judge_views`).
///
/// Anchors of power 2 lie on the equator, where its derivative stretches all directions alike;
/// elsewhere it has sheets thinner than their distance estimate by a factor that grows with depth,
/// 1e6 at 1e-18. So have even powers beside the axis, at scales far below the distance from it; on
/// the axis itself they do not. At power 3 the axis meets the surface where orbits are neutral: 6000
/// steps at an estimate of 1e-11, so that it is seen from afar alone; 0.01 and 0.05 beside it a third
/// of the pixels change with the length of steps from 1e-6 on. At power 2 orbits by the axis stay for
/// hundreds of steps, and pixels that change are too many even from afar.
pub const ANCHORS: &[Anchor] = &[
    Anchor {
        power: 2.0,
        julia: false,
        name: "at the equator",
        position: [
            "0.37284181698856026782202310856174138462133399",
            "-0.12239364690689754160157588918526051245991651",
            "0",
        ],
        toward: [-0.8467, -0.5321, 0.0],
        deepest: 1e-27,
    },
    Anchor {
        power: 2.0,
        julia: false,
        name: "at the equator, from aside",
        position: [
            "0.40603871366635733294484433789455709642081258",
            "0.19712468570673964502705860764159777637615668",
            "0",
        ],
        toward: [-0.9171, 0.3985, 0.0],
        deepest: 1e-27,
    },
    Anchor {
        power: 2.0,
        julia: false,
        name: "at the equator, over a bay",
        position: [
            "0.36162104020517979401232597253949336759674644",
            "-0.07088674724697985182613858594659298196656386",
            "0",
        ],
        toward: [-0.9525, 0.3046, 0.0],
        deepest: 1e-27,
    },
    Anchor {
        power: 3.0,
        julia: false,
        name: "from aside",
        position: [
            "0.20172567310448487218521234894568620894929530",
            "-0.44396334894621288071512912215198674023443297",
            "-0.29956975022756577616680391478435995172045117",
        ],
        toward: [-0.63, 0.3996, 0.6659],
        deepest: 1e-27,
    },
    Anchor {
        power: 3.0,
        julia: false,
        name: "from the other side",
        position: [
            "-0.61984950289083675921081670677882479678813811",
            "0.05914404510058610768248565359616913277999471",
            "0.21621421310774659890823180171396924110898232",
        ],
        toward: [0.9133, -0.3815, -0.1425],
        deepest: 1e-27,
    },
    Anchor {
        power: 3.0,
        julia: false,
        name: "from below",
        position: [
            "-0.12721121069155965168548486967256585104888992",
            "-0.46599520741495163644423110421846981856201314",
            "0.18645691425700482474677715459915157548246248",
        ],
        toward: [0.373, 0.8337, -0.4073],
        deepest: 1e-27,
    },
    Anchor {
        power: 3.0,
        julia: false,
        name: "on the axis",
        position: ["0", "0", "1.08966210000000000000000000000000000000000000"],
        toward: [0.0, 0.0, -1.0],
        deepest: 1.0,
    },
    Anchor {
        power: 8.0,
        julia: false,
        name: "from aside",
        position: [
            "-0.29601176724531189050911006306022274230736161",
            "-0.84328481599099249352515910401335034767521926",
            "0.37077988123915841580698601171728158967365266",
        ],
        toward: [0.373, 0.8337, -0.4073],
        deepest: 1e-27,
    },
    Anchor {
        power: 8.0,
        julia: false,
        name: "from below",
        position: [
            "0.39004205848639309655696854095817415894558159",
            "-0.56340974195988038934520765659493996907967598",
            "-0.49861718042726848204191548015156818013321958",
        ],
        toward: [-0.63, 0.3996, 0.6659],
        deepest: 1e-27,
    },
    Anchor {
        power: 8.0,
        julia: false,
        name: "from the other side",
        position: [
            "0.15379861659292883236866770985698080436629960",
            "-0.84801966252866654201816769898541895762149767",
            "0.59761228259006374734788457605399937869280647",
        ],
        toward: [0.2891, 0.8866, -0.3611],
        deepest: 1e-27,
    },
    Anchor {
        power: 8.0,
        julia: true,
        name: "of the Julia key, from aside",
        position: [
            "-0.30888984218751890347855344843486610538809678",
            "0.98597146898507521586390400044472522307089860",
            "-0.18819905768768892099979488397141155059571933",
        ],
        toward: [-0.0731, -0.7977, 0.5986],
        deepest: 1e-27,
    },
    Anchor {
        power: 8.0,
        julia: false,
        name: "on the axis",
        position: ["0", "0", "0.85233484699660038752894531303915344489909108"],
        toward: [0.0, 0.0, -1.0],
        deepest: 1e-27,
    },
    Anchor {
        power: 8.0,
        julia: false,
        name: "close to the axis",
        position: [
            "0.01187447257128977349473928380880852990524560312973",
            "0.005235336956054976847028614792948660805016828192169",
            "0.8713092010212460586089938682053779530564081076244",
        ],
        toward: [0.0131, -0.1987, -0.98],
        deepest: 1e-13,
    },
    Anchor {
        power: 16.0,
        julia: false,
        name: "from aside",
        position: [
            "0.45427026350241359291117039850779952633831394",
            "0.43391820676181405749210950888278489839470236",
            "-0.64341116302527966515022116291847312759450612",
        ],
        toward: [-0.3534, -0.5249, 0.7744],
        deepest: 1e-27,
    },
    Anchor {
        power: 16.0,
        julia: false,
        name: "on the axis",
        position: ["0", "0", "0.89540110303005466853046739308247810111145368687613"],
        toward: [0.0, 0.0, -1.0],
        deepest: 1e-27,
    },
    Anchor {
        power: 16.0,
        julia: false,
        name: "close to the axis",
        position: [
            "-0.0213348698564440615876327720696526597135990229232",
            "0.01128697698656810306571543392513515550253110627932",
            "0.9926452897308988161369792563279648215237858325267",
        ],
        toward: [0.0588, -0.4714, -0.8799],
        deepest: 1e-13,
    },
    Anchor {
        power: 16.0,
        julia: false,
        name: "from the other side",
        position: [
            "0.49831763361696526362607718014640659715670594",
            "-0.63208739247127187723753580125032735058739548",
            "-0.61306274468036055760458533673706146248356905",
        ],
        toward: [-0.63, 0.3996, 0.6659],
        deepest: 1e-27,
    },
    Anchor {
        power: 16.0,
        julia: false,
        name: "from below",
        position: [
            "-0.36411780475229877590876839057346480978940078",
            "-0.36892424553327844105959844670940418617124161",
            "-0.64909183736175542325986748950321332347923362",
        ],
        toward: [0.5253, 0.1059, 0.8443],
        deepest: 1e-27,
    },
];

/// A point of the set of the other sine's sign.
pub const MIRRORED: Anchor = Anchor {
    power: 8.0,
    julia: false,
    name: "mirrored",
    position: [
        "0.5846277494469027471001698415507818682994294250683",
        "-0.141806346272903213608641017683349159085809175062",
        "0.5812452039083863572130616727636149804387334769615",
    ],
    toward: [-0.9903, 0.1292, -0.0506],
    deepest: 1e-27,
};

impl Anchor {
    /// On the axis of an even power the gradient has no limit: each step of the orbit turns longitudes
    /// n-fold, and dr grows by less, so that ever finer ripples of the estimate grow steeper the lower
    /// they are. Depths there are right while normals follow from the last bit.
    pub fn is_rough(&self) -> bool {
        self.power % 2.0 == 0.0 && self.position[..2] == ["0", "0"]
    }

    /// How far away it is looked at from.
    pub fn scales(&self) -> impl Iterator<Item = f64> {
        let is_in = |&scale: &f64| scale >= self.deepest;
        SCALES.into_iter().filter(is_in)
    }

    /// The scene that looks at it from `scale` away.
    pub fn scene(&self, scale: f64) -> Scene {
        let sine = if self.name == MIRRORED.name { Sine::Negative } else { Sine::Positive };
        let fractal =
            Mandelbulb { power: self.power, julia: self.julia, sine, ..Mandelbulb::default() };
        scene(fractal, &self.point(), self.toward.into(), scale)
    }

    /// The camera that looks at it from `scale` away.
    pub fn camera(&self, scale: f64) -> Camera {
        camera(&self.point(), self.toward.into(), scale)
    }

    fn point(&self) -> PrecisePoint {
        PrecisePoint(self.position.map(|text| text.parse().expect("a decimal number")))
    }
}

/// The camera that looks at `anchor` along `toward` from `scale` away.
fn camera(anchor: &PrecisePoint, toward: DVec3, scale: f64) -> Camera {
    let toward = toward.normalize();
    let mut camera = Camera::looking_at(-toward, DVec3::ZERO, toward.any_orthonormal_vector());
    camera.position = anchor.moved_by(-toward * scale, 1e-6 * scale);
    camera.pivot = anchor.clone();
    camera
}

/// The scene that looks at `anchor` along `toward` from `scale` away.
pub fn scene(fractal: Mandelbulb, anchor: &PrecisePoint, toward: DVec3, scale: f64) -> Scene {
    let camera = camera(anchor, toward, scale);
    // Orbits of low powers are long already where views are shallow.
    let iterations = if fractal.power < 4.0 { 100 } else { fractal.iterations };
    Scene { fractal: Mandelbulb { iterations, ..fractal }.into(), camera, ..Scene::default() }
}

/// Steps that no orbit of such a scene needs: the document's, and for each power of ten of the view
/// so many as the slowest orbits took, and half as many again.
pub fn plenty(scene: &Scene) -> u32 {
    let depth = (1.0 / scene.camera.view_unit()).max(1.0).ln() + 8.0;
    scene.fractal.iterations + (2.0 * depth / Mandelbulb::of(&scene.fractal).power.ln()) as u32
}
