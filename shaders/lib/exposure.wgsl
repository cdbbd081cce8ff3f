// The factor on radiance, where it may follow the film.
fn exposure_factor() -> f32 {
    let automatic = select(0.0, statistics.adapted_stops, picture.tone.auto_exposure != 0u);
    return picture.tone.exposure * exp2(automatic);
}
