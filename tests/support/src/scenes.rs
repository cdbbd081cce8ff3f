//! Any valid scene.

use glam::{DQuat, DVec3};
use mandelight::{
    formula::{
        self, Fractal,
        section::SectionPlane,
        table::{Field, Kind, Value},
    },
    scene::{
        Axis, Background, BackgroundKind, Bloom, BloomOrder, Camera, ColorSource, Coloring,
        DrivenByLayer, EnvironmentLight, EnvironmentMapRig, Fog, GradientStop, Indirect,
        IndirectKind, IntegratorKind, IntegratorSettings, Lens, LightFrame, Lights,
        MAX_RIG_RADIANCE, Medium, MediumKind, Normals, PointLight, Precise, PrecisePoint, Quality,
        Rig, RigKind, RigLight, Scene, SecondLayer, SectionColors, Sky, Stereo, StereoLayout,
        Surface, SurfaceModel, Tone, ToneChannels, ToneCurve, ToneMean,
        param::{self, Param, Scale},
    },
};
use proptest::{array::uniform3, collection::vec, option, prelude::*, sample::select};

/// A value of the whole range, whose ends are as likely as one value in three.
///
/// Boxed, as trees of choices in place overflow the stack of a test.
fn value(param: &'static Param) -> BoxedStrategy<f64> {
    prop_oneof![4 => param.min..=param.max, 1 => Just(param.min), 1 => Just(param.max)].boxed()
}

fn count(param: &'static Param) -> impl Strategy<Value = u32> {
    value(param).prop_map(|value| value as u32)
}

fn color() -> impl Strategy<Value = [f32; 3]> {
    uniform3(prop_oneof![4 => 0.0..=1.0_f32, 1 => Just(0.0), 1 => Just(1.0)].boxed())
}

fn direction() -> impl Strategy<Value = [f64; 3]> {
    uniform3(-1.0..1.0).prop_map(|v| DVec3::from_array(v).normalize_or(DVec3::X).to_array())
}

/// A coordinate as people and deep zooms write it: up to 75 decimal places.
fn precise() -> impl Strategy<Value = Precise> {
    (any::<bool>(), 0..100_u32, "[0-9]{0,75}").prop_map(|(minus, whole, places)| {
        let sign = if minus { "-" } else { "" };
        let text = format!("{sign}{whole}.{places}0");
        text.parse().unwrap_or_else(|error| panic!("{text} {error}"))
    })
}

fn point() -> impl Strategy<Value = PrecisePoint> {
    uniform3(precise()).prop_map(PrecisePoint)
}

/// Any formula with any values of its own table.
fn fractal() -> impl Strategy<Value = Fractal> {
    let formulas: Vec<_> = formula::all().collect();
    let fraction = || prop_oneof![4 => 0.0..=1.0_f64, 1 => Just(0.0), 1 => Just(1.0)].boxed();
    let shared = (count(&param::ITERATIONS), fraction());
    (select(formulas), shared, vec(fraction(), 16), vec(section_plane(), 0..=3)).prop_map(
        |(formula, (iterations, t), fractions, section_planes)| {
            let mut fractal = Fractal::new(formula);
            let mut fractions = fractions.into_iter().cycle();
            fill(fractal.fields_mut(), || fractions.next().unwrap_or_default());
            fractal.iterations = iterations;
            let span = fractal.max_bailout() - param::BAILOUT.min;
            fractal.bailout = (param::BAILOUT.min + t * span).min(fractal.max_bailout());
            fractal.section_planes = section_planes;
            fractal
        },
    )
}

/// Gives fields values of their whole ranges; `next` gives parts of ranges, 0 to 1.
pub fn fill<'a>(
    fields: impl Iterator<Item = (&'static Field, &'a mut Value)>,
    mut next: impl FnMut() -> f64,
) {
    for (field, value) in fields {
        let mut within = |param: &Param| {
            let value = param.min + next() * (param.max - param.min);
            let is_whole = param.scale == Scale::Integer;
            param.clamp(if is_whole { value.round() } else { value })
        };
        match (field.kind, value) {
            (Kind::Number { param, .. }, Value::Number(number)) => *number = within(param),
            (Kind::Vector { param, .. }, Value::Vector(numbers)) => {
                numbers.fill_with(|| within(param));
            }
            (Kind::Switch { .. }, Value::Switch(is_on)) => *is_on = next() < 0.5,
            (Kind::Choice { options, .. }, Value::Choice(word)) => {
                *word = options[(next() * options.len() as f64) as usize % options.len()].word;
            }
            _ => unreachable!("a value is of its field's kind"),
        }
    }
}

fn section_plane() -> impl Strategy<Value = SectionPlane> {
    (point(), direction(), value(&param::SECTION_BAND_REACH))
        .prop_map(|(point, direction, band_reach)| SectionPlane { point, direction, band_reach })
}

fn camera() -> impl Strategy<Value = Camera> {
    let turn = (direction(), 0.0..std::f64::consts::TAU);
    (point(), point(), turn, (value(&param::VERTICAL_FOV), lens()), stereo())
        .prop_filter("the pivot is not the eye", |(eye, pivot, ..)| (eye - pivot).length() > 1e-20)
        .prop_map(|(position, pivot, (axis, angle), (vertical_fov_deg, lens), stereo)| Camera {
            position,
            pivot,
            orientation: DQuat::from_axis_angle(DVec3::from_array(axis), angle).normalize().into(),
            vertical_fov_deg,
            lens,
            stereo,
        })
}

fn lens() -> impl Strategy<Value = Lens> {
    let numbers = (value(&param::F_NUMBER), value(&param::FOCUS), value(&param::BLADES));
    (any::<bool>(), numbers).prop_map(|(depth_of_field, (f_number, focus, blades))| Lens {
        depth_of_field,
        f_number,
        focus,
        blades: blades.round() as u32,
    })
}

fn stereo() -> impl Strategy<Value = Stereo> {
    use StereoLayout::{Anaglyph, Off, SideBySide, TopBottom};
    let lengths =
        (value(&param::SCREEN_HEIGHT), value(&param::EYE_DISTANCE), value(&param::EYE_SEPARATION));
    let layout = select(vec![Off, SideBySide, TopBottom, Anaglyph]);
    (layout, lengths, any::<bool>()).prop_map(|(layout, lengths, swap_eyes)| Stereo {
        layout,
        screen_height_cm: lengths.0,
        eye_distance_cm: lengths.1,
        eye_separation_cm: lengths.2,
        swap_eyes,
    })
}

fn environment_light() -> impl Strategy<Value = EnvironmentLight> {
    let frame = select(vec![LightFrame::Scene, LightFrame::View]);
    let reach = option::of(value(&param::SHADOW_REACH));
    let strength = (value(&param::ENVIRONMENT_INTENSITY), value(&param::ENVIRONMENT_SIZE));
    (direction(), color(), strength, reach, frame, any::<[bool; 3]>()).prop_map(
        |(
            direction,
            color,
            (intensity, size_deg),
            shadow_reach,
            frame,
            [casts_shadows, muted, solo],
        )| {
            EnvironmentLight {
                direction,
                color,
                intensity,
                size_deg,
                casts_shadows,
                shadow_reach,
                frame,
                muted,
                solo,
            }
        },
    )
}

fn point_light() -> impl Strategy<Value = PointLight> {
    let strength = (value(&param::POINT_INTENSITY), value(&param::POINT_RADIUS));
    (point(), color(), strength, any::<[bool; 3]>()).prop_map(
        |(position, color, (intensity, radius), [casts_shadows, muted, solo])| PointLight {
            position,
            color,
            intensity,
            radius,
            casts_shadows,
            muted,
            solo,
        },
    )
}

fn sky() -> impl Strategy<Value = Sky> {
    let colors = (color(), color(), color(), color());
    let sun = (direction(), value(&param::SUN_STRENGTH), value(&param::SUN_SIZE));
    (colors, sun, count(&param::SUN_LIGHTS)).prop_map(
        |(
            (zenith, horizon, ground, sun_color),
            (sun_direction, sun_strength, size),
            sun_lights,
        )| {
            Sky {
                zenith,
                horizon,
                ground,
                sun_direction,
                sun_color,
                sun_strength,
                sun_size_deg: size,
                sun_lights,
            }
        },
    )
}

fn environment_map_rig() -> impl Strategy<Value = EnvironmentMapRig> {
    let direction = direction().prop_map(|v| v.map(|v| v as f32));
    let strength =
        prop_oneof![3 => 0.0..10.0_f32, 1 => 0.0..=MAX_RIG_RADIANCE, 1 => Just(MAX_RIG_RADIANCE)];
    let light = (direction, uniform3(strength))
        .prop_map(|(direction, strength)| RigLight { direction, strength });
    (".{0,40}", value(&param::RIG_ROTATION), vec(light, 0..6))
        .prop_map(|(name, rotation_deg, lights)| EnvironmentMapRig { name, rotation_deg, lights })
}

fn rig() -> impl Strategy<Value = Rig> {
    let kind = select(vec![RigKind::None, RigKind::Sky, RigKind::EnvironmentMap]);
    let frame = select(vec![LightFrame::Scene, LightFrame::View]);
    let reach = option::of(value(&param::RIG_SHADOW_REACH));
    let number = (3..=50_u32, value(&param::RIG_INTENSITY));
    (kind, number, reach, frame, any::<[bool; 3]>(), sky(), environment_map_rig()).prop_map(
        |(kind, (count, intensity), shadow_reach, frame, flags, sky, environment_map)| {
            let [casts_shadows, muted, solo] = flags;
            Rig {
                kind,
                count,
                intensity,
                casts_shadows,
                shadow_reach,
                frame,
                muted,
                solo,
                sky,
                environment_map,
            }
        },
    )
}

fn lights() -> impl Strategy<Value = Lights> {
    (vec(environment_light(), 0..4), vec(point_light(), 0..4), rig(), any::<bool>()).prop_map(
        |(environment, point, rig, follow_view)| Lights { environment, point, rig, follow_view },
    )
}

fn coloring() -> impl Strategy<Value = Coloring> {
    let source = select(vec![
        ColorSource::Iterations,
        ColorSource::PointTrap,
        ColorSource::AxisTrap,
        ColorSource::PlaneTrap,
        ColorSource::SphereTrap,
        ColorSource::CubeTrap,
        ColorSource::Channel,
        ColorSource::Position,
        ColorSource::Normal,
    ]);
    let axis = select(vec![Axis::X, Axis::Y, Axis::Z]);
    let center = [(); 3].map(|()| value(&param::TRAP_CENTER));
    let numbers = (
        center,
        value(&param::TRAP_SIZE),
        value(&param::COLOR_REPEATS),
        value(&param::COLOR_OFFSET),
    );
    (source, axis, any::<bool>(), numbers).prop_map(
        |(source, axis, follows_view, (center, size, repeats, offset))| Coloring {
            source,
            axis,
            center,
            size,
            follows_view,
            repeats,
            offset,
        },
    )
}

fn gradient() -> impl Strategy<Value = Vec<GradientStop>> {
    let stops = vec((value(&param::STOP_POSITION), color()), 1..=48);
    stops.prop_map(|mut stops| {
        stops.sort_by(|a, b| a.0.total_cmp(&b.0));
        stops.into_iter().map(|(position, color)| GradientStop { position, color }).collect()
    })
}

fn surface() -> impl Strategy<Value = Surface> {
    let second_layer = (value(&param::SECOND_LAYER_AMOUNT), coloring(), gradient());
    let light = (
        value(&param::AMBIENT),
        value(&param::DIFFUSE),
        value(&param::SPECULAR),
        value(&param::SHININESS),
    );
    let sections = (value(&param::SECTION_REPEATS), color());
    (light, coloring(), gradient(), second_layer, (sections, physical())).prop_map(
        |((ambient, diffuse, specular, shininess), coloring, gradient, second, more)| Surface {
            ambient,
            diffuse,
            specular,
            shininess,
            coloring,
            gradient,
            second_layer: SecondLayer { amount: second.0, coloring: second.1, gradient: second.2 },
            sections: SectionColors { repeats: more.0.0, inside: more.0.1 },
            ..more.1
        },
    )
}

/// A surface with any values of the physical model.
fn physical() -> impl Strategy<Value = Surface> {
    let model = select(vec![SurfaceModel::BlinnPhong, SurfaceModel::Physical]);
    let coat = (value(&param::COAT), value(&param::COAT_ROUGHNESS));
    let base = (value(&param::ROUGHNESS), value(&param::METALNESS), color());
    (model, base, coat, value(&param::EMISSION), any::<[bool; 4]>()).prop_map(
        |(model, base, coat, emission, [by_roughness, by_metalness, by_coat, by_emission])| {
            Surface {
                model,
                roughness: base.0,
                metalness: base.1,
                specular_color: base.2,
                coat: coat.0,
                coat_roughness: coat.1,
                emission,
                driven_by_layer: DrivenByLayer {
                    roughness: by_roughness,
                    metalness: by_metalness,
                    coat: by_coat,
                    emission: by_emission,
                },
                ..Surface::default()
            }
        },
    )
}

fn medium() -> impl Strategy<Value = Medium> {
    let kind = select(vec![MediumKind::None, MediumKind::Set, MediumKind::Iterations]);
    let numbers = (value(&param::MEAN_FREE_PATH), value(&param::MEDIUM_ANISOTROPY));
    let range = (value(&param::THIN_ITERATIONS), value(&param::DENSE_ITERATIONS));
    (kind, color(), numbers, range).prop_map(|(kind, color, numbers, range)| Medium {
        kind,
        color,
        mean_free_path: numbers.0,
        anisotropy: numbers.1,
        thin_iterations: range.0,
        dense_iterations: range.1,
    })
}

fn fog() -> impl Strategy<Value = Fog> {
    let numbers = (value(&param::FOG_DENSITY), value(&param::FOG_ANISOTROPY));
    let height = (option::of(value(&param::FOG_HEIGHT)), value(&param::FOG_LEVEL));
    (color(), numbers, height, value(&param::FOG_RADIUS)).prop_map(
        |(color, numbers, height, radius)| Fog {
            density: numbers.0,
            color,
            anisotropy: numbers.1,
            height: height.0,
            level: height.1,
            radius,
        },
    )
}

fn integrator() -> impl Strategy<Value = IntegratorSettings> {
    let kind = select(vec![IntegratorKind::Direct, IntegratorKind::Path]);
    let limits = (option::of(value(&param::BOUNCE_REACH)), value(&param::NOISE));
    let smoothing = (any::<bool>(), option::of(value(&param::FIREFLY_LIMIT)));
    (kind, count(&param::BOUNCES), limits, smoothing).prop_map(
        |(kind, bounces, (reach, noise), (denoise, firefly_limit))| IntegratorSettings {
            firefly_limit,
            kind,
            bounces,
            reach,
            noise,
            denoise,
        },
    )
}

fn tone() -> impl Strategy<Value = Tone> {
    let curve = select(vec![
        ToneCurve::Linear,
        ToneCurve::Reinhard,
        ToneCurve::Aces,
        ToneCurve::Agx,
        ToneCurve::KhronosNeutral,
    ]);
    let channels = select(vec![ToneChannels::Luminance, ToneChannels::PerChannel]);
    let mean = select(vec![ToneMean::Arithmetic, ToneMean::Logarithmic]);
    let numbers = (value(&param::EXPOSURE), value(&param::KEY), value(&param::WHITE_POINT));
    (numbers, curve, channels, mean, any::<bool>()).prop_map(
        |((exposure, key, white_point), curve, channels, mean, auto_exposure)| Tone {
            exposure,
            auto_exposure,
            mean,
            key,
            curve,
            channels,
            white_point,
        },
    )
}

fn indirect() -> impl Strategy<Value = Indirect> {
    let kind = select(vec![IndirectKind::Off, IndirectKind::Uniform, IndirectKind::Horizon]);
    let amounts = (
        value(&param::INDIRECT_RADIUS),
        value(&param::INDIRECT_STRENGTH),
        value(&param::INDIRECT_AMBIENT),
    );
    let counts = (count(&param::INDIRECT_DIRECTIONS), count(&param::INDIRECT_SAMPLES));
    (kind, amounts, counts).prop_map(|(kind, amounts, counts)| Indirect {
        kind,
        radius: amounts.0,
        strength: amounts.1,
        ambient: amounts.2,
        directions: counts.0,
        samples: counts.1,
    })
}

fn bloom() -> impl Strategy<Value = Bloom> {
    let order = select(vec![BloomOrder::Before, BloomOrder::After]);
    let numbers = (
        value(&param::BLOOM_STRENGTH),
        value(&param::BLOOM_RADIUS),
        value(&param::BLOOM_THRESHOLD),
    );
    (numbers, order, count(&param::BLOOM_PASSES)).prop_map(
        |((strength, radius, threshold), order, passes)| Bloom {
            strength,
            order,
            radius,
            threshold,
            passes,
        },
    )
}

fn quality() -> impl Strategy<Value = Quality> {
    let normals = select(vec![
        Normals::None,
        Normals::Three,
        Normals::Six,
        Normals::Eighteen,
        Normals::TwentySix,
        Normals::Analytic,
    ]);
    let numbers = (value(&param::MOTION_BUDGET), count(&param::SAMPLES), value(&param::DETAIL));
    (numbers, any::<bool>(), normals).prop_map(
        |((motion_budget_ms, samples, detail), shadows, normals)| Quality {
            motion_budget_ms,
            samples,
            shadows,
            detail,
            normals,
        },
    )
}

/// Any valid scene of a few lights.
pub fn scene() -> impl Strategy<Value = Scene> {
    let kind = select(vec![BackgroundKind::Gradient, BackgroundKind::EnvironmentMap]);
    let background =
        (kind, color(), color()).prop_map(|(kind, top, bottom)| Background { kind, top, bottom });
    let what =
        (fractal(), camera(), lights(), surface(), indirect(), (background, medium(), fog()));
    let how = (tone(), bloom(), quality(), integrator());
    (what, how).prop_map(|(what, (tone, bloom, quality, integrator))| {
        let (fractal, camera, lights, surface, indirect, (background, medium, fog)) = what;
        Scene {
            fractal,
            camera,
            lights,
            surface,
            medium,
            fog,
            indirect,
            integrator,
            background,
            tone,
            bloom,
            quality,
        }
    })
}
