#!/usr/bin/env python3
"""Renders the reference pictures of tests/gpu/mitsuba.rs with Mitsuba 3.

    pip install mitsuba==3.9.1
    python3 tests/references/mitsuba.py [SCENE ...]

Without names it renders every scene of SCENES. Each scene becomes tests/references/mitsuba_SCENE.exr: linear
Rec. 709, 32-bit floats, the first row on top. It runs for a few minutes on two cores.
The scalar variant needs no LLVM; versions 14 and 15 lack an instruction that Mitsuba's own code needs.

Light adds up, so a scene is a list of pictures, one for each light, and the reference is their sum: a light's own
shape then hides no other light. Mandelight's lights have no shape at all. The lights lie outside of the convex hull
of the surfaces, so their shapes hide no surface from another either.
"""

import math
import pathlib
import sys
import time

# This file's folder is no place to look for the package of this file's name.
sys.path = [place for place in sys.path if pathlib.Path(place or ".").resolve() != pathlib.Path(__file__).resolve().parent]

import mitsuba as mi
import numpy as np

mi.set_variant("scalar_rgb")

WIDTH, HEIGHT = 48, 36
FOLDER = pathlib.Path(__file__).parent
# Samples are drawn in so many parts, whose spread gives the error of the whole.
PARTS = 8

T = mi.ScalarTransform4f


def rgb(*channels):
    """A spectrum of linear Rec. 709."""
    return {"type": "rgb", "value": list(channels)}


def camera(eye, target, vertical_fov_deg):
    """The sensor: pixels are boxes, as Mandelight's are."""
    return {
        "type": "perspective",
        "fov": vertical_fov_deg,
        "fov_axis": "y",
        "to_world": T().look_at(origin=eye, target=target, up=[0, 0, 1]),
        "near_clip": 0.01,
        "far_clip": 100.0,
        "film": {
            "type": "hdrfilm",
            "width": WIDTH,
            "height": HEIGHT,
            "pixel_format": "rgb",
            "component_format": "float32",
            "rfilter": {"type": "box"},
        },
        "sampler": {"type": "independent"},
    }


def path(bounces):
    """The integrator: the camera's vertex and so many bounces after it, each lit by the lights."""
    return {"type": "path", "max_depth": bounces + 2, "rr_depth": 1000, "hide_emitters": True}


def diffuse(*color):
    """Lambert's surface."""
    return {"type": "twosided", "bsdf": {"type": "diffuse", "reflectance": rgb(*color)}}


class Compensated(mi.BSDF):
    """GGX that reflects everything at normal incidence, so that Fresnel's factor is 1 for all angles.

    Mitsuba's own metal lacks the light that several facets reflect. This one has it as Mandelight has (E. Turquin,
    Practical Multiple Scattering Compensation for Microfacet Models, 2019, eq. 16): all of the lobe is over its
    albedo, which is found by samples of the lobe.
    """

    COLUMNS, SAMPLES = 32, 6000

    def __init__(self, properties):
        super().__init__(properties)
        lobe = {"type": "roughconductor", "material": "none", "distribution": "ggx"}
        self.lobe = mi.load_dict(lobe | {"alpha": properties["alpha"]})
        self.m_components = [mi.BSDFFlags.GlossyReflection | mi.BSDFFlags.FrontSide]
        self.m_flags = self.m_components[0]
        # Columns by the square root of the cosine, which is even where the albedo falls.
        self.albedos = [self.albedo(max((k / self.COLUMNS) ** 2, 1e-4)) for k in range(self.COLUMNS + 1)]

    def albedo(self, cosine):
        """The mean of the weights of samples."""
        seen = mi.SurfaceInteraction3f()
        seen.wi = mi.Vector3f(math.sqrt(1 - cosine * cosine), 0, cosine)
        seen.t, seen.n, seen.sh_frame = 1, mi.Normal3f(0, 0, 1), mi.Frame3f([0, 0, 1])
        # A lattice whose rows are no rows of the square: the lobe's part below the surface is a thin strip at an edge.
        places = [mi.Point2f(k * 0.7548776662 % 1, k * 0.5698402910 % 1) for k in range(self.SAMPLES)]
        weights = [self.lobe.sample(mi.BSDFContext(), seen, 0.5, place)[1][0] for place in places]
        return sum(weights) / len(weights)

    def factor(self, cosine):
        """One over the albedo."""
        if cosine <= 0:
            return 0.0
        at = min(math.sqrt(cosine), 1) * self.COLUMNS
        low = min(int(at), self.COLUMNS - 1)
        return 1 / (self.albedos[low] + (at - low) * (self.albedos[low + 1] - self.albedos[low]))

    def sample(self, context, seen, lobe, place, active=True):
        found, weight = self.lobe.sample(context, seen, lobe, place, active)
        return found, weight * self.factor(seen.wi.z)

    def eval(self, context, seen, toward, active=True):
        return self.lobe.eval(context, seen, toward, active) * self.factor(seen.wi.z)

    def pdf(self, context, seen, toward, active=True):
        return self.lobe.pdf(context, seen, toward, active)

    def eval_pdf(self, context, seen, toward, active=True):
        return self.eval(context, seen, toward, active), self.pdf(context, seen, toward, active)

    def to_string(self):
        return "Compensated"


mi.register_bsdf("compensated", Compensated)


def white_metal(roughness):
    """Metal of Fresnel's factor 1."""
    return {"type": "compensated", "alpha": roughness**2}


def environment_light(direction, size_deg, intensity, color):
    """A disc of directions: a disc so far away that all of the scene sees it in the same place.

    A surface that faces it has irradiance pi times the intensity, so the radiance is the intensity over the squared
    sine of half the angle.
    """
    far = 1e4
    half = math.radians(size_deg / 2)
    direction = np.array(direction) / np.linalg.norm(direction)
    radiance = np.array(color) * intensity / math.sin(half) ** 2
    to_world = T().look_at(origin=(far * direction).tolist(), target=[0, 0, 0], up=[0, 1, 0])
    return {
        "type": "disk",
        "to_world": to_world @ T().scale(far * math.tan(half)),
        "emitter": {"type": "area", "radiance": rgb(*radiance)},
    }


def point_light(position, radius, intensity, color):
    """A glowing sphere: at the distance d irradiance is pi L R^2/d^2, Mandelight's is pi I/d^2."""
    radiance = np.array(color) * intensity / radius**2
    return {
        "type": "sphere",
        "center": list(position),
        "radius": radius,
        "emitter": {"type": "area", "radiance": rgb(*radiance)},
    }


def white_sky():
    """Radiance 1 from all sides."""
    return {"type": "constant", "radiance": rgb(1, 1, 1)}


def gradient_sky(zenith, horizon, ground):
    """The radiance of src/scene/rig/sky.rs: by the height, with the ground's haze."""
    rows, haze = 2048, 0.1
    height = np.cos(np.pi * (np.arange(rows) + 0.5) / rows)
    zenith, horizon, ground = (np.array(color) for color in (zenith, horizon, ground))
    up = np.sqrt(np.maximum(height, 0))[:, None]
    down = np.minimum(np.maximum(-height, 0) / haze, 1)[:, None]
    column = horizon + up * (zenith - horizon) + down * (ground - horizon)
    pixels = np.repeat(column[:, None, :], 16, axis=1).astype(np.float32)
    # The map's own upper pole is +y.
    return {"type": "envmap", "bitmap": mi.Bitmap(pixels), "to_world": T().rotate([1, 0, 0], 90)}


# Mandelight draws the floor up to the sphere of the formula's `bound 3`.
FLOOR = {
    "type": "disk",
    "to_world": T().translate([0, 0, -1]) @ T().scale(math.sqrt(8)),
}
BALL = {"type": "sphere", "center": [0, 0, -0.2], "radius": 0.6}
BALL_CAMERA = camera([0, -2.2, 3.2], [0, 0, -0.7], 36)

DISC_LIGHT = environment_light([0.5, 0.2, 0.9], 30, 0.8, [1, 0.9, 0.7])
BALL_LIGHT = point_light([-1.4, -0.8, 1.9], 0.3, 4.0, [0.6, 0.8, 1])


def ball(lights, floor, body, bounces):
    """A ball above a floor, once in each of the lights."""
    surfaces = {
        "floor": FLOOR | {"bsdf": floor},
        "ball": BALL | {"bsdf": body},
    }
    head = {"type": "scene", "integrator": path(bounces), "sensor": BALL_CAMERA}
    return [head | surfaces | {"light": light} for light in lights]


def diffuse_ball():
    """Two colours, a distant disc and a near ball of light."""
    return ball(
        [DISC_LIGHT, BALL_LIGHT], diffuse(0.8, 0.8, 0.75), diffuse(0.75, 0.3, 0.15), bounces=6
    )


def metal_ball():
    """Rough mirrors in all kinds of light."""
    sky = gradient_sky([0.2, 0.4, 0.9], [0.9, 0.6, 0.5], [0.3, 0.2, 0.1])
    metal = white_metal(0.3)
    return ball([DISC_LIGHT, BALL_LIGHT, sky], metal, metal, bounces=6)


def box():
    """A box that is open toward the viewer, with a ball in it, in a white sky."""

    def slab(center, half):
        return {"type": "cube", "to_world": T().translate(center) @ T().scale(half), "bsdf": paint}

    paint = diffuse(0.9, 0.7, 0.4)
    wall, out, thick = 1.05, 1.1, 0.05
    return [
        {
            "type": "scene",
            "integrator": path(30),
            "sensor": camera([0.2, -4.2, 0.3], [0.05, 0, 0.02], 26),
            "left": slab([-wall, 0, 0], [thick, out, out]),
            "right": slab([wall, 0, 0], [thick, out, out]),
            "floor": slab([0, 0, -wall], [out, out, thick]),
            "ceiling": slab([0, 0, wall], [out, out, thick]),
            "back": slab([0, wall, 0], [out, thick, out]),
            "ball": {"type": "sphere", "center": [-0.3, 0.2, -0.4], "radius": 0.45, "bsdf": paint},
            "light": white_sky(),
        }
    ]


def medium(albedo, extinction, anisotropy):
    """A homogeneous medium that scatters by Henyey-Greenstein's function."""
    return {
        "type": "homogeneous",
        "albedo": rgb(*albedo),
        "sigma_t": float(extinction),
        "phase": {"type": "hg", "g": anisotropy},
    }


def filled_sphere(center, radius, inside):
    """A sphere without a surface, full of a medium."""
    return {
        "type": "sphere",
        "center": center,
        "radius": float(radius),
        "bsdf": {"type": "null"},
        "interior": inside,
    }


def foggy_ball():
    """The ball above the floor, in a ball of fog around the eye."""
    fog = medium([0.9, 0.7, 0.5], 0.2, 0.4) | {"id": "fog"}
    inside = {"type": "ref", "id": "fog"}
    # There is no fog inside of the light's shape, so the light is small.
    small_light = point_light([-1.4, -0.8, 1.9], 0.03, 4.0, [0.6, 0.8, 1])
    scenes = ball([DISC_LIGHT, small_light], diffuse(0.8, 0.8, 0.8), diffuse(0.8, 0.8, 0.8), bounces=20)
    for scene in scenes:
        scene["integrator"] = path(20) | {"type": "volpath"}
        scene["fog"] = fog
        scene["air"] = filled_sphere([0, 0, -0.7], 5.5, inside)
        scene["sensor"] = BALL_CAMERA | {"medium": inside}
        if scene["light"] is small_light:
            scene["light"] = small_light | {"exterior": inside}
    return scenes


def cloudy_ball():
    """A ball that is a medium, in a white sky and in the light of a disc."""
    scene = {
        "type": "scene",
        "integrator": path(64) | {"type": "volpath"},
        "sensor": camera([0, -4, 1], [0, 0, 0], 36),
        "ball": filled_sphere([0, 0, 0], 1, medium([0.98, 0.9, 0.7], 5, -0.3)),
    }
    return [scene | {"light": light} for light in [DISC_LIGHT, white_sky()]]


# Name: the pictures whose sum is the reference, and the samples of a pixel.
SCENES = {
    "diffuse_ball": (diffuse_ball, 4096),
    "box": (box, 4096),
    "metal_ball": (metal_ball, 512),
    "foggy_ball": (foggy_ball, 16384),
    "cloudy_ball": (cloudy_ball, 8192),
}


def render(name):
    """Renders a scene, and prints its mean and its error."""
    pictures, samples = SCENES[name]
    start = time.time()
    parts = np.zeros((PARTS, HEIGHT, WIDTH, 3))
    for index, picture in enumerate(pictures()):
        scene = mi.load_dict(picture)
        for part in range(PARTS):
            seed = 1000 * index + part
            parts[part] += np.array(mi.render(scene, spp=samples // PARTS, seed=seed))
    mean = parts.mean(axis=0)
    error = parts.std(axis=0, ddof=1) / math.sqrt(PARTS)
    file = mi.Bitmap(mean.astype(np.float32))
    file.metadata()["comments"] = f"Mitsuba {mi.__version__}, {samples} samples per pixel and light"
    file.write(str(FOLDER / f"mitsuba_{name}.exr"))
    channels = ", ".join(f"{value:.4f}" for value in mean.mean(axis=(0, 1)))
    print(
        f"{name}: mean {channels}; a pixel's error is {100 * (error / mean.mean()).mean():.2f} % of the mean on"
        f" average, {100 * (error / mean.mean()).max():.2f} % at most; {time.time() - start:.0f} s"
    )


def main():
    """Renders the scenes named on the command line."""
    print(f"Mitsuba {mi.__version__}, {mi.variant()}")
    for name in sys.argv[1:] or SCENES:
        render(name)


if __name__ == "__main__":
    main()
