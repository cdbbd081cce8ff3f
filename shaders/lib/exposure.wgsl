// The exposure factor on radiance, with auto exposure if that is on.
// uses: types/frame_uniforms, types/post

fn exposure_factor() -> f32 {
    let automatic = select(0.0, statistics.adapted_stops, frame.tone.auto_exposure != 0u);
    return frame.tone.exposure * exp2(automatic);
}
