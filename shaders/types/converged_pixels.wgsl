// Which pixels get no more samples: those with negative moments, as in `types/traced_paths.wgsl`.

@group(3) @binding(0) var<storage, read> moments: array<f32>;
