// Scattering in a medium, by the phase function of L. Henyey and J. Greenstein (Diffuse radiation in the Galaxy,
// Astrophysical Journal 93, 1941). `g` is the mean cosine of the angle between a ray and the ray that it becomes.
// uses: lib/basis

// Part of the light along `along` that leaves toward `wi`, per unit of solid angle; also the density of `phase_sample`.
fn phase_value(g: f32, along: vec3f, wi: vec3f) -> f32 {
    let d = 1.0 + g * g - 2.0 * g * dot(along, wi);
    return (1.0 - g * g) / (4.0 * PI * d * sqrt(d));
}

// A direction in which light along the unit vector `along` leaves
// (M. Pharr et al., Physically Based Rendering, 4th ed. 2023, section 11.3.1).
fn phase_sample(g: f32, along: vec3f, at: vec2f) -> vec3f {
    var cosine = 1.0 - 2.0 * at.x;
    if (abs(g) > 1e-3) {
        let s = (1.0 - g * g) / (1.0 + g - 2.0 * g * at.x);
        cosine = clamp((1.0 + g * g - s * s) / (2.0 * g), -1.0, 1.0);
    }
    return from_polar(along, sqrt(max(1.0 - cosine * cosine, 0.0)), cosine, at.y);
}
