// The pixel of a surface, of the bone's own or of a cut's face; follows cuts.glsl and bone_shading.glsl.
//
//     vec3  shown_pixel(vec3 point, vec3 direction)    as surface_pixel, but for the faces of cuts, which are flat and
//                                                      open to the sky

const float cut_face_depth = 0.1;  // voxels within which a renderer finds a face

vec3 shown_pixel(vec3 point, vec3 direction) {
    for (int cut = 0; cut < cut_count; ++cut) {
        vec3 normal = cut_planes[cut].xyz;
        // Where bone does not go on behind the cut it is the bone's own surface that is seen.
        if (cut_planes[cut].w - dot(normal, point) < cut_face_depth &&
            fraction_at(point + 0.5 * normal) >= bone_surface)
            return display(lit(look_at(point - 0.6 * normal).rgb, normal, 1.0));
    }
    return surface_pixel(point, direction);
}
