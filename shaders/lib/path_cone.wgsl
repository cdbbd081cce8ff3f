// The cones of a path's rays.
// uses: types/frame_uniforms

// Width of the cones about bounced rays and about their shadow rays, over that of shadow rays of direct light. A wide cone
// ends early, before the place that its light comes from: with all of the width a box under a sky is 1 % too dark.
const PATH_CONE = 0.125;

// Radius of a cone per unit of distance.
fn path_cone() -> f32 {
    return PATH_CONE * frame.march.shadow_cone;
}
