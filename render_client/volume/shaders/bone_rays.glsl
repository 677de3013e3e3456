// Rays through the bone, one for each pixel; follows cuts.glsl and bone_shading.glsl, behind camera_rays.vert.glsl. Lengths are
// in voxels, in texture coordinates of the bone's box (the first voxel spans 0 to 1), axes are the patient's.
//
//     vec3  direction                       unit, of this pixel's ray from the eye
//     void  begin_ray()                     first of all: sets the direction, and the span of the ray that may meet bone
//     bool  find_bone(inout float index)    false where no sample from `index` on meets bone; else index is the first that does
//     float surface_before(float index)     how far along the ray the surface before a sample within bone is
//     float depth_of(float distance_along)  window depth

uniform vec3 eye;
uniform vec3 forward;
uniform vec2 depth_terms;      // window depth = x + y / distance along forward
uniform float step_length;
uniform bool skips;
in vec3 ray;

vec3 direction;
float enter, leave;

float depth_of(float distance_along) {
    return depth_terms.x + depth_terms.y / (distance_along * dot(direction, forward));
}

// Samples stand on one lattice along the ray, skipped or not, so skipping cannot change the picture. Samples of a block are a loop
// of their own: a software rasteriser would look the block up again for each.
bool find_bone(inout float index) {
    float last = floor((leave - enter) / step_length);
    for (int visit = 0; visit < 16384 && index <= last; ++visit) {
        bool is_empty;
        float way = way_in_blocks(eye + (enter + index * step_length) * direction, direction, is_empty);
        float end = index + max(ceil(way / step_length), 1.0);
        float next = skips && is_empty ? end : index;
        for (end = min(end, last + 1.0); next < end; next += 1.0)
            if (fraction_at(eye + (enter + next * step_length) * direction) >= bone_surface) {
                index = next;
                return true;
            }
        index = next;
    }
    return false;
}

float surface_before(float index) {
    float outside = enter + max(index - 1.0, 0.0) * step_length;
    float inside = enter + index * step_length;
    for (int halving = 0; halving < 6; ++halving) {
        float middle = 0.5 * (outside + inside);
        if (fraction_at(eye + middle * direction) >= bone_surface) inside = middle;
        else outside = middle;
    }
    return inside;
}

void begin_ray() {
    direction = normalize(ray);
    direction = mix(direction, vec3(1e-6), lessThan(abs(direction), vec3(1e-6)));
    // One voxel beyond the box on every side the fraction has fallen to zero.
    vec3 to_low = (vec3(-1.0) - eye) / direction;
    vec3 to_high = (bone_size + 1.0 - eye) / direction;
    vec3 enter3 = min(to_low, to_high);
    vec3 leave3 = max(to_low, to_high);
    enter = max(max(enter3.x, enter3.y), max(enter3.z, 0.0));
    leave = min(leave3.x, min(leave3.y, leave3.z));
    clip_by_cuts(eye, direction, enter, leave);
}
