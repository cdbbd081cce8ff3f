// The value that selects a sample's colour in a colour layer's gradient.
// uses: lib/octahedral, types/frame_uniforms

// The layer's value of a sample with the stored value `stored` and the packed normal `normal`.
fn color_value(layer: ColorLayer, stored: f32, normal: u32) -> f32 {
    if (layer.source != COLOR_NORMAL) { return stored; }
    if (frame.normals == NORMALS_NONE) { return 0.5; }
    return 0.5 + 0.5 * dot(octahedral_unpack(normal), layer.axis);
}
