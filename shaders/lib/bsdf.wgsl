// Reflection of light by a material: values, densities and samples. `wi` is the unit vector toward the light, `wo`
// the one toward the viewer; both are on the side of the normal `n`. Values include the cosine of `wi`.
// uses: lib/basis, lib/luminance, lib/material, types/frame_uniforms

// Reflectance of a clear coat at normal incidence: an index of refraction of 1.5.
const COAT_REFLECTANCE = vec3f(0.04);

// Number of entries of the albedo table along each side.
const ALBEDO_ENTRIES = 32u;
// Directional albedo of a GGX lobe with Schlick's Fresnel: F0 x + y (B. Karis, Real Shading in Unreal Engine 4,
// 2013). Rows by roughness, columns by the square root of the cosine; two entries a vector.
@group(0) @binding(5) var<uniform> albedo_table: array<vec4f, ALBEDO_ENTRIES * ALBEDO_ENTRIES / 2u>;

fn albedo_entry(column: u32, row: u32) -> vec2f {
    let index = row * ALBEDO_ENTRIES + column;
    let pair = albedo_table[index / 2u];
    return select(pair.xy, pair.zw, (index & 1u) != 0u);
}

// The table's value for a cosine and a squared roughness.
fn albedo_at(cosine: f32, alpha: f32) -> vec2f {
    let last = f32(ALBEDO_ENTRIES - 1u);
    let at = clamp(sqrt(vec2f(cosine, alpha)), vec2f(0.0), vec2f(1.0)) * last;
    let low = min(vec2u(at), vec2u(ALBEDO_ENTRIES - 2u));
    let part = at - vec2f(low);
    return mix(
        mix(albedo_entry(low.x, low.y), albedo_entry(low.x + 1u, low.y), part.x),
        mix(albedo_entry(low.x, low.y + 1u), albedo_entry(low.x + 1u, low.y + 1u), part.x),
        part.y);
}

// A GGX lobe as seen from one direction.
struct Lobe {
    alpha: f32,
    // Reflectance at normal incidence.
    f0: vec3f,
    // Factor that adds the light of multiple scattering (E. Turquin, Practical Multiple Scattering Compensation for
    // Microfacet Models, 2019, eq. 16).
    compensation: vec3f,
    // Part of the light from all sides that the lobe reflects toward the viewer, compensated.
    albedo: vec3f,
}

// `single`: the table's value for the viewer's cosine and `alpha`.
fn lobe_of(f0: vec3f, alpha: f32, single: vec2f) -> Lobe {
    let whole = max(single.x + single.y, 1e-3);
    let compensation = 1.0 + f0 * (1.0 - whole) / whole;
    return Lobe(alpha, f0, compensation, compensation * (f0 * single.x + single.y));
}

// The lobe of a surface that is `b` in part: with the albedo of both parts.
fn mixed(a: Lobe, b: Lobe, part: f32, single: vec2f) -> Lobe {
    let f0 = mix(a.f0, b.f0, part);
    let albedo = mix(a.albedo, b.albedo, part);
    return Lobe(a.alpha, f0, albedo / max(f0 * single.x + single.y, vec3f(1e-4)), albedo);
}

// Density of GGX normals at `h` over the projected solid angle of normals (B. Walter et al., Microfacet Models for
// Refraction, EGSR 2007, eq. 33). The sine is computed by itself: 1 - cos^2 has no digits for smooth surfaces.
fn ggx_ndf(n: vec3f, h: vec3f, alpha: f32) -> f32 {
    let c = dot(n, h);
    let s = cross(n, h);
    let d = alpha * alpha * c * c + dot(s, s);
    return alpha * alpha / max(PI * d * d, 1e-30);
}

// sqrt(alpha^2 + (1 - alpha^2) cosine^2), of Smith's masking.
fn ggx_slope(cosine: f32, alpha: f32) -> f32 {
    return sqrt(alpha * alpha + (1.0 - alpha * alpha) * cosine * cosine);
}

fn schlick(f0: vec3f, cosine: f32) -> vec3f {
    let m = 1.0 - saturate(cosine);
    return f0 + (1.0 - f0) * (m * m * m * m * m);
}

// Cosine of the viewer's direction; above 0 also where the normal leans away from the viewer.
fn view_cosine(n: vec3f, wo: vec3f) -> f32 {
    return max(dot(n, wo), 1e-4);
}

// Value of a lobe with height-correlated masking (E. Heitz, Understanding the Masking-Shadowing Function, JCGT 3(2),
// 2014, eq. 99).
fn lobe_value(lobe: Lobe, n: vec3f, wo: vec3f, wi: vec3f) -> vec3f {
    let h = normalize(wo + wi);
    let o = view_cosine(n, wo);
    let i = dot(n, wi);
    let masking = 0.5 * i / max(i * ggx_slope(o, lobe.alpha) + o * ggx_slope(i, lobe.alpha), 1e-20);
    return lobe.compensation * schlick(lobe.f0, dot(wo, h)) * (ggx_ndf(n, h, lobe.alpha) * masking);
}

// Density over solid angle of directions reflected by visible normals.
fn lobe_density(lobe: Lobe, n: vec3f, wo: vec3f, wi: vec3f) -> f32 {
    let o = view_cosine(n, wo);
    return 0.5 * ggx_ndf(n, normalize(wo + wi), lobe.alpha) / (o + ggx_slope(o, lobe.alpha));
}

// A direction reflected by a normal that the viewer sees (J. Dupuy, A. Benyoub, Sampling Visible GGX Normals with
// Spherical Caps, CGF 42(8), 2023, listing 3). May point below the surface.
fn lobe_sample(lobe: Lobe, n: vec3f, wo: vec3f, at: vec2f) -> vec3f {
    let b = basis(n);
    let local = vec3f(dot(wo, b.x), dot(wo, b.y), dot(wo, n));
    let stretched = normalize(vec3f(lobe.alpha * local.xy, local.z));
    let z = 1.0 - at.y * (1.0 + stretched.z);
    let sin_theta = sqrt(saturate(1.0 - z * z));
    let azimuth = 2.0 * PI * (at.x - 0.5);
    let h = vec3f(sin_theta * cos(azimuth), sin_theta * sin(azimuth), z) + stretched;
    let normal = normalize(vec3f(lobe.alpha * h.xy, h.z));
    let m = normal.x * b.x + normal.y * b.y + normal.z * n;
    return 2.0 * dot(wo, m) * m - wo;
}

// A material as seen from one direction.
struct Bsdf {
    n: vec3f,
    wo: vec3f,
    // Reflected part of the light from all sides, over pi: of the diffuse lobe.
    diffuse: vec3f,
    // Factors on the lobes' values.
    coat_weight: f32,
    specular_weight: f32,
    coat: Lobe,
    specular: Lobe,
    // Blinn-Phong exponent.
    exponent: f32,
    // Probabilities with which a sample is of the coat, and of the specular lobe; else it is diffuse.
    coat_probability: f32,
    specular_probability: f32,
}

// Albedo scaling puts lobes in layers: each lobe gets what the lobes above it leave of light from all sides.
fn physical_bsdf(m: Material, n: vec3f, wo: vec3f) -> Bsdf {
    let cosine = view_cosine(n, wo);
    let coat = lobe_of(COAT_REFLECTANCE, m.coat_alpha, albedo_at(cosine, m.coat_alpha));
    // A part is metal: its lobe is mixed so that neither part loses light.
    let single = albedo_at(cosine, m.alpha);
    let metal = lobe_of(m.color, m.alpha, single);
    let other = lobe_of(frame.surface.specular_color, m.alpha, single);
    let specular = mixed(other, metal, m.metalness, single);
    let under_coat = 1.0 - m.coat * coat.albedo.x;
    let diffuse = under_coat * (1.0 - other.albedo) * m.diffuse;
    let shares = vec3f(
        m.coat * coat.albedo.x, under_coat * luminance(specular.albedo), luminance(diffuse));
    let whole = max(shares.x + shares.y + shares.z, 1e-20);
    return Bsdf(
        n, wo, diffuse / PI, m.coat, under_coat, coat, specular, 0.0, shares.x / whole, shares.y / whole);
}

fn blinn_phong_bsdf(m: Material, n: vec3f, wo: vec3f) -> Bsdf {
    let none = Lobe(1.0, vec3f(0.0), vec3f(0.0), vec3f(0.0));
    // The highlight's albedo at normal incidence.
    let highlight = m.specular * 8.0 / (m.alpha + 2.0);
    let diffuse = luminance(m.diffuse);
    let share = highlight / max(highlight + diffuse, 1e-20);
    let specular = Lobe(1.0, vec3f(m.specular), vec3f(0.0), vec3f(0.0));
    return Bsdf(n, wo, m.diffuse / PI, 0.0, 0.0, none, specular, m.alpha, 0.0, share);
}

fn bsdf_of(m: Material, n: vec3f, wo: vec3f) -> Bsdf {
    if (is_blinn_phong()) { return blinn_phong_bsdf(m, n, wo); }
    return physical_bsdf(m, n, wo);
}

// The reflected part of light from `wi`, with the cosine.
fn bsdf_value(f: Bsdf, wi: vec3f) -> vec3f {
    let cosine = dot(f.n, wi);
    if (cosine <= 0.0) { return vec3f(0.0); }
    var value = f.diffuse * cosine;
    if (is_blinn_phong()) {
        // The thesis's highlight has no cosine.
        let highlight = pow(max(dot(f.n, normalize(f.wo + wi)), 0.0), f.exponent);
        return value + f.specular.f0 * highlight / PI;
    }
    if (f.coat_weight > 0.0) { value += f.coat_weight * lobe_value(f.coat, f.n, f.wo, wi); }
    return value + f.specular_weight * lobe_value(f.specular, f.n, f.wo, wi);
}

// Density over solid angle with which `bsdf_sample` selects `wi`.
fn bsdf_density(f: Bsdf, wi: vec3f) -> f32 {
    let cosine = dot(f.n, wi);
    if (cosine <= 0.0) { return 0.0; }
    var density = (1.0 - f.coat_probability - f.specular_probability) * cosine / PI;
    if (is_blinn_phong()) {
        let h = normalize(f.wo + wi);
        let normals = (f.exponent + 1.0) / (2.0 * PI) * pow(max(dot(f.n, h), 0.0), f.exponent);
        return density + f.specular_probability * normals / max(4.0 * dot(f.wo, h), 1e-6);
    }
    if (f.coat_probability > 0.0) { density += f.coat_probability * lobe_density(f.coat, f.n, f.wo, wi); }
    return density + f.specular_probability * lobe_density(f.specular, f.n, f.wo, wi);
}

// A direction toward which the material may reflect; it may point below the surface.
fn bsdf_sample(f: Bsdf, lobe: f32, at: vec2f) -> vec3f {
    if (lobe < f.coat_probability) { return lobe_sample(f.coat, f.n, f.wo, at); }
    if (lobe < f.coat_probability + f.specular_probability) {
        if (!is_blinn_phong()) { return lobe_sample(f.specular, f.n, f.wo, at); }
        let z = pow(at.x, 1.0 / (f.exponent + 1.0));
        let h = from_polar(f.n, sqrt(max(1.0 - z * z, 0.0)), z, at.y);
        return 2.0 * dot(f.wo, h) * h - f.wo;
    }
    return from_polar(f.n, sqrt(at.x), sqrt(max(1.0 - at.x, 0.0)), at.y);
}
