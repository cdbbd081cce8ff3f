//! Reflection by a material: values, densities and samples, from the published formulas.
//!
//! Values include the cosine of the direction toward the light.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};
use mandelight::{
    render::albedo_table::{ALBEDO_ENTRIES, ALBEDO_TABLE},
    scene::color::luminance,
};

/// Reflectance at normal incidence of a coat with an index of refraction of 1.5.
const COAT_REFLECTANCE: f64 = 0.04;
/// Least squared roughness.
const LEAST_ALPHA: f64 = 1e-3;

/// How a point reflects light.
#[derive(Clone, Copy, Debug)]
pub enum Material {
    /// Diffuse reflectance, and a highlight (Blinn 1977) with a strength and an exponent.
    BlinnPhong { diffuse: DVec3, specular: f64, exponent: f64 },
    /// A diffuse surface or metal under a coat.
    Physical {
        color: DVec3,
        metalness: f64,
        specular_color: DVec3,
        roughness: f64,
        coat: f64,
        coat_roughness: f64,
    },
}

/// A microfacet lobe as seen from one direction (B. Walter et al., Microfacet Models for Refraction, EGSR 2007).
#[derive(Clone, Copy, Debug)]
struct Facets {
    alpha: f64,
    /// Reflectance at normal incidence.
    f0: DVec3,
    /// Factor for the light of multiple scattering (E. Turquin, Practical Multiple Scattering Compensation, 2019).
    compensation: DVec3,
    /// The part of light from all sides that is reflected.
    albedo: DVec3,
}

#[derive(Clone, Copy, Debug)]
enum Lobe {
    Diffuse(DVec3),
    /// Strength and exponent.
    Highlight(f64, f64),
    Facets(Facets),
}

/// A material as seen from one direction.
#[derive(Clone, Debug)]
pub struct Bsdf {
    normal: DVec3,
    viewer: DVec3,
    /// Lobes with their factors and their shares of samples.
    lobes: Vec<(Lobe, f64, f64)>,
}

/// Two vectors beside a unit vector (T. Duff et al., Building an Orthonormal Basis, Revisited, JCGT 6(1), 2017).
pub fn beside(n: DVec3) -> [DVec3; 2] {
    let sign = if n.z >= 0.0 { 1.0 } else { -1.0 };
    let a = -1.0 / (sign + n.z);
    let b = n.x * n.y * a;
    [
        DVec3::new(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x),
        DVec3::new(b, sign + n.y * n.y * a, -n.y),
    ]
}

/// The direction at a height over the plane of `axis`, turned about it by a part of a turn less a half.
pub fn turned_about(axis: DVec3, height: f64, turn: f64) -> DVec3 {
    let [x, y] = beside(axis);
    let aside = (1.0 - height * height).max(0.0).sqrt();
    let (sine, cosine) = (TAU * (turn - 0.5)).sin_cos();
    aside * (cosine * x + sine * y) + height * axis
}

/// The table of albedos between its entries: of reflectance 1 at normal incidence, and what Fresnel adds.
fn albedo(cosine: f64, alpha: f64) -> DVec2 {
    let last = (ALBEDO_ENTRIES - 1) as f64;
    let [x, y] = [cosine, alpha].map(|value| value.clamp(0.0, 1.0).sqrt() * last);
    let [column, row] = [x, y].map(|at| (at as usize).min(ALBEDO_ENTRIES - 2));
    let at = |column: usize, row: usize| {
        DVec2::from(ALBEDO_TABLE[row * ALBEDO_ENTRIES + column].map(f64::from))
    };
    let along = |row: usize| at(column, row).lerp(at(column + 1, row), x - column as f64);
    along(row).lerp(along(row + 1), y - row as f64)
}

impl Facets {
    fn new(f0: DVec3, roughness: f64, cosine: f64) -> Self {
        let alpha = (roughness * roughness).max(LEAST_ALPHA);
        let single = albedo(cosine, alpha);
        let whole = single.x + single.y;
        let compensation = 1.0 + f0 * (1.0 / whole - 1.0);
        Self { alpha, f0, compensation, albedo: compensation * (f0 * single.x + single.y) }
    }

    /// The facets of a surface of which `part` are those of `other`: neither part loses light.
    fn mixed(&self, other: &Self, part: f64, cosine: f64) -> Self {
        let single = albedo(cosine, self.alpha);
        let f0 = self.f0.lerp(other.f0, part);
        let albedo = self.albedo.lerp(other.albedo, part);
        Self { alpha: self.alpha, f0, compensation: albedo / (f0 * single.x + single.y), albedo }
    }

    /// GGX: the density of normals (Walter et al., eq. 33), by the tangent of the angle to the normal.
    fn normals(&self, n: DVec3, h: DVec3) -> f64 {
        let cosine = n.dot(h);
        let tangent = n.cross(h).length() / cosine;
        let a = self.alpha * self.alpha;
        a / (PI * cosine.powi(4) * (a + tangent * tangent).powi(2))
    }

    /// Smith's Λ (E. Heitz, Understanding the Masking-Shadowing Function, JCGT 3(2), 2014, eq. 72).
    fn lambda(&self, cosine: f64) -> f64 {
        let tangent_squared = 1.0 / (cosine * cosine) - 1.0;
        0.5 * ((1.0 + self.alpha * self.alpha * tangent_squared).sqrt() - 1.0)
    }

    /// Schlick's Fresnel, density of normals, height-correlated masking (Heitz 2014, eq. 99).
    fn value(&self, n: DVec3, wo: DVec3, wi: DVec3) -> DVec3 {
        let h = (wo + wi).normalize();
        let fresnel = self.f0 + (1.0 - self.f0) * (1.0 - wo.dot(h)).powi(5);
        let masking = 1.0 / (1.0 + self.lambda(n.dot(wo)) + self.lambda(n.dot(wi)));
        self.compensation * fresnel * (self.normals(n, h) * masking / (4.0 * n.dot(wo)))
    }

    /// Density of directions reflected by normals that the viewer sees (E. Heitz, JCGT 7(4), 2018).
    fn density(&self, n: DVec3, wo: DVec3, wi: DVec3) -> f64 {
        let h = (wo + wi).normalize();
        self.normals(n, h) / (1.0 + self.lambda(n.dot(wo))) / (4.0 * n.dot(wo))
    }

    /// Reflection at a visible normal (J. Dupuy, A. Benyoub, CGF 42(8), 2023, listing 3).
    fn sample(&self, n: DVec3, wo: DVec3, at: DVec2) -> DVec3 {
        let [x, y] = beside(n);
        let stretch = DVec3::new(self.alpha, self.alpha, 1.0);
        let seen = (DVec3::new(wo.dot(x), wo.dot(y), wo.dot(n)) * stretch).normalize();
        // A direction of the cap over −seen.z, and the normal between it and the viewer.
        let height = (1.0 - at.y) * (1.0 + seen.z) - seen.z;
        let (sine, cosine) = (TAU * (at.x - 0.5)).sin_cos();
        let aside = (1.0 - height * height).max(0.0).sqrt();
        let h = ((DVec3::new(aside * cosine, aside * sine, height) + seen) * stretch).normalize();
        mirrored(wo, h.x * x + h.y * y + h.z * n)
    }
}

fn mirrored(wo: DVec3, h: DVec3) -> DVec3 {
    2.0 * wo.dot(h) * h - wo
}

impl Material {
    /// The material with a normal, seen from a direction.
    pub fn seen(&self, normal: DVec3, viewer: DVec3) -> Bsdf {
        let mut lobes = match *self {
            Self::BlinnPhong { diffuse, specular, exponent } => vec![
                (Lobe::Highlight(specular, exponent), 1.0, 8.0 * specular / (exponent + 2.0)),
                (Lobe::Diffuse(diffuse), 1.0, luminance(diffuse)),
            ],
            Self::Physical {
                color,
                metalness,
                specular_color,
                roughness,
                coat,
                coat_roughness,
            } => {
                let cosine = normal.dot(viewer);
                let coating = Facets::new(DVec3::splat(COAT_REFLECTANCE), coat_roughness, cosine);
                let other = Facets::new(specular_color, roughness, cosine);
                let metal = Facets::new(color, roughness, cosine);
                let base = other.mixed(&metal, metalness, cosine);
                // Each layer gets what the layers above leave.
                let left = 1.0 - coat * coating.albedo.x;
                let diffuse = left * (1.0 - other.albedo) * (1.0 - metalness) * color;
                vec![
                    (Lobe::Facets(coating), coat, coat * coating.albedo.x),
                    (Lobe::Facets(base), left, left * luminance(base.albedo)),
                    (Lobe::Diffuse(diffuse), 1.0, luminance(diffuse)),
                ]
            }
        };
        let whole: f64 = lobes.iter().map(|(_, _, share)| share).sum();
        for (_, _, share) in &mut lobes {
            *share /= whole.max(1e-20);
        }
        Bsdf { normal, viewer, lobes }
    }
}

impl Bsdf {
    /// The reflected part of light from a direction.
    pub fn value(&self, wi: DVec3) -> DVec3 {
        let Self { normal, viewer, .. } = *self;
        let cosine = normal.dot(wi);
        if cosine <= 0.0 {
            return DVec3::ZERO;
        }
        let of = |(lobe, factor, _): &(Lobe, f64, f64)| {
            *factor
                * match lobe {
                    Lobe::Diffuse(albedo) => *albedo * cosine / PI,
                    Lobe::Highlight(strength, exponent) => {
                        let along = normal.dot((viewer + wi).normalize());
                        DVec3::splat(strength * along.max(0.0).powf(*exponent) / PI)
                    }
                    Lobe::Facets(facets) => facets.value(normal, viewer, wi),
                }
        };
        self.lobes.iter().filter(|(_, factor, _)| *factor > 0.0).map(of).sum()
    }

    /// Density over solid angle of sampled directions over the surface.
    pub fn density(&self, wi: DVec3) -> f64 {
        let Self { normal, viewer, .. } = *self;
        let cosine = normal.dot(wi);
        if cosine <= 0.0 {
            return 0.0;
        }
        let of = |(lobe, _, share): &(Lobe, f64, f64)| {
            share
                * match lobe {
                    Lobe::Diffuse(_) => cosine / PI,
                    Lobe::Highlight(_, exponent) => {
                        let h = (viewer + wi).normalize();
                        let normals =
                            (exponent + 1.0) / TAU * normal.dot(h).max(0.0).powf(*exponent);
                        normals / (4.0 * viewer.dot(h))
                    }
                    Lobe::Facets(facets) => facets.density(normal, viewer, wi),
                }
        };
        self.lobes.iter().filter(|(_, _, share)| *share > 0.0).map(of).sum()
    }

    /// A direction, possibly under the surface.
    pub fn sample(&self, mut lobe: f64, at: DVec2) -> DVec3 {
        let Self { normal, viewer, .. } = *self;
        let last = self.lobes.len() - 1;
        let chosen = self.lobes.iter().position(|(_, _, share)| {
            lobe -= share;
            lobe < 0.0
        });
        match self.lobes[chosen.unwrap_or(last)].0 {
            Lobe::Diffuse(_) => turned_about(normal, (1.0 - at.x).sqrt(), at.y),
            Lobe::Highlight(_, exponent) => {
                let h = turned_about(normal, at.x.powf(1.0 / (exponent + 1.0)), at.y);
                mirrored(viewer, h)
            }
            Lobe::Facets(facets) => facets.sample(normal, viewer, at),
        }
    }
}
