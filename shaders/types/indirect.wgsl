// What indirect light comes from: the centre samples of the whole picture, or of a smaller
// picture of the same scene. Host twin: `render::around`.

// As the G-buffer's.
@group(3) @binding(2) var<storage, read> neighbour_surface: array<vec2u>;
