// Cuts through the bone; set_cut_uniforms sets their uniforms. Points are in the coordinates of bone_sampling.glsl.
//
//     const int cut_count                  given ahead of this file, at most 4
//     void  clip_by_cuts(vec3 eye, vec3 direction, inout float enter, inout float leave)
//                                          shortens a ray to the part that no cut takes away
//     bool  is_cut_away(vec3 point)

uniform vec4 cut_planes[4];  // xyz unit, towards the part taken away; w offset, voxels

void clip_by_cuts(vec3 eye, vec3 direction, inout float enter, inout float leave) {
    for (int cut = 0; cut < cut_count; ++cut) {
        float slope = dot(cut_planes[cut].xyz, direction);
        if (abs(slope) < 1e-6) slope = -1e-6;
        float meets = (cut_planes[cut].w - dot(cut_planes[cut].xyz, eye)) / slope;
        if (slope > 0.0) leave = min(leave, meets);
        else enter = max(enter, meets);
    }
}

bool is_cut_away(vec3 point) {
    for (int cut = 0; cut < cut_count; ++cut)
        if (dot(cut_planes[cut].xyz, point) > cut_planes[cut].w) return true;
    return false;
}
