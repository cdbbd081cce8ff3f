// The formula's part of a frame's uniforms, in passes that follow no orbits.

struct FormulaUniforms {
    unused: vec4u,
}
