// The eye of a pixel, for regions that two eyes share.
// uses: types/frame_uniforms

// True if a pixel belongs to the region's second eye.
fn is_second_eye(pixel: vec2u) -> bool {
    return frame.eyes.count > 1u && all(pixel >= frame.eyes.second_at);
}

// The pixel's position in its own eye's part of the region.
fn eye_pixel(pixel: vec2u) -> vec2u {
    return select(pixel, pixel - frame.eyes.second_at, is_second_eye(pixel));
}

// -1 for a left eye, 1 for a right eye, 0 without stereo.
fn eye_side(pixel: vec2u) -> f32 {
    return select(frame.eyes.first_side, -frame.eyes.first_side, is_second_eye(pixel));
}

// Columns and rows of eyes on the whole film.
fn sheet_eyes() -> vec2u {
    return vec2u(round(1.0 / frame.eyes.share));
}

// Column and row of a pixel's eye on the whole film.
fn eye_on_sheet(pixel: vec2u) -> vec2u {
    let place = select(frame.eyes.first_place, 1.0, is_second_eye(pixel));
    return u32(place) * (sheet_eyes() - 1u);
}

// The upper left corner of a pixel's eye on the whole film, which spans (0, 0) to (1, 1).
fn eye_corner(pixel: vec2u) -> vec2f {
    return vec2f(eye_on_sheet(pixel)) * frame.eyes.share;
}

// Position in an eye's whole picture, 0 to 1, of a position `place` inside one of the region's pixels.
fn eye_position(pixel: vec2u, place: vec2f) -> vec2f {
    return (vec2f(frame.origin_px + eye_pixel(pixel)) + place) / vec2f(frame.picture_px);
}
