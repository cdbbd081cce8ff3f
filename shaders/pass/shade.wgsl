// Light and colour of each sample, onto the film, or to where indirect light is made of it.

@compute @workgroup_size(64)
fn main(@builtin(workgroup_id) workgroup: vec3u, @builtin(local_invocation_index) local_index: u32) {
    picture = given_picture;
    let pixel = lattice_pixel(workgroup.x, local_index);
    if (!inside_region(pixel)) { return; }
    let radiance = direct_radiance(pixel, sample_index(pixel, workgroup.x, local_index));
    if (picture.indirect.kind == INDIRECT_OFF) {
        put_on_film(pixel, radiance);
    } else {
        direct[pixel_index(pixel)] = shared_exponent_pack(radiance);
    }
}
