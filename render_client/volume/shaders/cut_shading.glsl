// The pixel of a surface, of the bone's own or of a cut's face; follows cuts.glsl and bone_shading.glsl.
//
//     vec3  shown_pixel(vec3 point, vec3 direction)    as surface_pixel, but for the faces of cuts, which are flat and
//                                                      open to the sky

//     const bool cuts_show_ct              given ahead of this file: the faces have the CT's grey

const float cut_face_depth = 0.1;  // voxels within which a renderer finds a face

uniform sampler3D cut_ct;               // grey as it is shown
uniform vec3 cut_ct_origin, cut_ct_scale;  // texture coordinates: scale * (point - origin)

vec3 shown_pixel(vec3 point, vec3 direction) {
    for (int cut = 0; cut < cut_count; ++cut) {
        vec3 normal = cut_planes[cut].xyz;
        // If bone does not go on behind the cut, the bone's own surface is seen.
        if (cut_planes[cut].w - dot(normal, point) < cut_face_depth &&
            fraction_at(point + 0.5 * normal) >= bone_surface) {
            if (cuts_show_ct) return vec3(texture(cut_ct, cut_ct_scale * (point - cut_ct_origin)).r);
            vec3 within = point - 0.6 * normal, colour = smooth_look_at(within).rgb;
            if (bone_has_grain) colour = grained(colour, grain_at(within));
            return display(lit(colour, normal, 1.0));
        }
    }
    return surface_pixel(point, direction);
}
