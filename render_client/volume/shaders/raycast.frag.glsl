// Ray casting; follows cut_shading.glsl, behind camera_rays.vert.glsl. Lengths are in voxels, in texture coordinates of the
// bone's box (the first voxel spans 0 to 1), axes are the patient's.

uniform vec3 eye;
uniform vec3 forward;
uniform vec2 depth_terms;      // window depth = x + y / distance along forward
uniform float step_length;
uniform bool skips;
uniform vec2 picture_size;
in vec3 ray;
out vec4 pixel;

const float darkest_seen = 0.004;  // of light that comes through: less changes no displayed level by one

vec3 direction;
float enter, leave;

float depth_of(float distance_along) {
    return depth_terms.x + depth_terms.y / (distance_along * dot(direction, forward));
}

// Samples stand on one lattice along the ray, skipped or not, so skipping cannot change the picture. False
// where no sample from `index` on meets bone; else index is the first that does.
bool find_bone(inout float index) {
    for (int visit = 0; visit < 16384; ++visit) {
        float distance_along = enter + index * step_length;
        if (distance_along > leave) return false;
        vec3 p = eye + distance_along * direction;
        float skip = skips ? skip_distance(p, direction) : 0.0;
        if (skip > 0.0) {
            index += max(ceil(skip / step_length), 1.0);
            continue;
        }
        if (fraction_at(p) >= bone_surface) return true;
        index += 1.0;
    }
    return false;
}

// How far along the ray the surface before a sample within bone is.
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

void draw_surface(float index) {
    float inside = surface_before(index);
    pixel = vec4(shown_pixel(eye + inside * direction, direction), 1.0);
    gl_FragDepth = depth_of(inside);
}

// Front to back, until hardly any light comes through. Samples count from where the ray enters bone: counted from
// where it enters the box, their layers would be seen in the surface, like the grain of wood.
void draw_translucent(float index) {
    vec3 light = vec3(0.0);
    float through = 1.0;
    float next = -1.0;
    gl_FragDepth = 1.0;
    do {
        if (index != next) {
            enter = surface_before(index) + 0.5 * step_length;
            index = 0.0;
        }
        float distance_along = enter + index * step_length;
        vec3 p = eye + distance_along * direction;
        float opacity;
        vec4 piece = translucent_piece(p, step_length, through, opacity);
        light += through * piece.rgb;
        through *= 1.0 - piece.a;
        if (gl_FragDepth == 1.0 && opacity >= solid_opacity) gl_FragDepth = depth_of(distance_along);
        next = index += 1.0;
    } while (through > darkest_seen && find_bone(index));
    light += through * background_at(gl_FragCoord.xy / picture_size);
    pixel = vec4(display(light), 1.0);
}

void main() {
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

    float index = 0.0;
    // A software rasteriser goes no further where all of a group of pixels are discarded; the two sides of a
    // branch it would both compute.
    if (!find_bone(index)) discard;
    if (bone_is_translucent) draw_translucent(index);
    else draw_surface(index);
}
