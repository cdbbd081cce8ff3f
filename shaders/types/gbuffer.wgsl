// The G-buffer, a struct of arrays with one element per sample, and the rays of the batch. Host twin:
// `render::targets`.
// uses: types/ray

// The bits of `surface.x` of samples that are not computed: their pixels get no more.
const SKIPPED = 0xffffffffu;

// x: depth along the camera ray in render space, the bits of an f32; 0 on a miss.
// y: unit normal, octahedral, two 16-bit signed normalised numbers.
@group(1) @binding(0) var<storage, read_write> surface: array<vec2u>;
// The values that select the colours of the two layers.
@group(1) @binding(1) var<storage, read_write> color_data: array<vec2f>;
// One bit per light that casts shadows: set if the light reaches the point. Of paths: x is
// the distance at which the ray collides with fog, the bits of an f32.
@group(1) @binding(2) var<storage, read_write> visibility: array<vec2u>;
// The rays of a batch, in the order of its threads.
@group(1) @binding(3) var<storage, read_write> rays: array<Ray>;

// The distance at which a path's ray collides with fog; large if it does not.
fn stored_fog_distance(index: u32) -> f32 {
    return bitcast<f32>(visibility[index].x);
}

fn store_fog_distance(index: u32, distance: f32) {
    visibility[index].x = bitcast<u32>(distance);
}
