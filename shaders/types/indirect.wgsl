// The source of indirect light: the centre samples of the whole picture, or of a smaller
// picture of the same scene. Host twin: `render::indirect`.

// Packed as `surface` of the G-buffer.
@group(3) @binding(2) var<storage, read> neighbour_surface: array<vec2u>;
