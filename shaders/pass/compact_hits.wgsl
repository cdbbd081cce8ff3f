// Queues the blocks that have a surface point.
// uses: lib/lattice, types/dispatch_params, types/enqueue, types/frame_uniforms, types/gbuffer

@compute @workgroup_size(64)
fn main(@builtin(global_invocation_id) thread: vec3u) {
    read_frame();
    if (thread.x >= dispatch.blocks) { return; }
    let block = block_at(thread.x);
    var any = 0u;
    for (var i = 0u; i < BLOCK_THREADS; i++) {
        let site = block_site(block, i);
        if (site.is_there && surface[site.index].x != SKIPPED) { any |= surface[site.index].x; }
    }
    if (any != 0u) { enqueue_hit(block.index); }
}
