// The G-buffer for passes that only read it; packed as in `types/gbuffer.wgsl`.

@group(1) @binding(0) var<storage, read> surface: array<vec2u>;
@group(1) @binding(1) var<storage, read> color_data: array<vec2f>;
@group(1) @binding(2) var<storage, read> visibility: array<vec2u>;
