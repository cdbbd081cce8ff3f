// The paths of a batch, one per sample, in the order of its rays.
// uses: types/path

@group(3) @binding(3) var<storage, read_write> paths: array<PathState>;
