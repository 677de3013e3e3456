// Silhouettes without stairs; follows bone_rays.glsl. A pixel beside a step in depth shows the nearer surface by the share
// that it covers. The nearer surface ends where a ray only just touches it. The distance of that outline from the middle of
// the pixel follows from the fullest place on its ray: the fraction there, less that of a surface, over its slope.

uniform sampler2D drawn_colour, drawn_depth;
uniform vec2 picture_size;
uniform float pixel_width;  // at distance 1 along forward
out vec4 pixel;

const float least_step = 8.0;   // of depth, in pixels: a slope of 76 degrees has as much
const float limb_depth = 24.0;  // in pixels: how far behind the last pixel of a surface its outline lies
const int places = 24;

float distance_of(float window_depth) { return depth_terms.y / (window_depth - depth_terms.x); }

// The fullest place on the ray between `first` and `end`, the fraction there and its slope. One loop, with one sample a
// round: a software rasteriser computes all branches for all pixels, and leaves a loop early where none of them needs it.
void find_fullest(bool is_needed, float first, float end, out float most, out float slope) {
    const int beside = places + 1, around = beside + 2, samples = around + 6;
    float width = (end - first) / float(places), place = first, middle = first;
    vec3 gradient = vec3(0.0);
    most = -1.0;
    int last = is_needed ? samples : 0;
    for (int i = 0; i < last; ++i) {
        float along = first + float(i) * width;
        if (i == beside) middle = place;
        if (i >= beside) along = i == beside ? max(middle - 0.5 * width, first) : min(middle + 0.5 * width, end);
        int side = i - around;
        vec3 axis = vec3(side / 2 == 0, side / 2 == 1, side / 2 == 2) * (side % 2 == 0 ? 0.5 : -0.5);
        if (i < around) axis = vec3(0.0); else along = place;
        float fraction = fraction_at(eye + along * direction + axis);
        gradient += 2.0 * fraction * axis;
        if (i < around && fraction > most) {
            most = fraction;
            place = along;
        }
    }
    slope = length(gradient);
}

void main() {
    ivec2 here = ivec2(gl_FragCoord.xy), last = ivec2(picture_size) - 1;
    float own = texelFetch(drawn_depth, here, 0).r;
    float nearest = own, farthest = own;
    ivec2 near_at = here, far_at = here;
    for (int side = 0; side < 4; ++side) {
        ivec2 beside = here + (side < 2 ? ivec2(2 * side - 1, 0) : ivec2(0, 2 * side - 5));
        float depth = texelFetch(drawn_depth, clamp(beside, ivec2(0), last), 0).r;
        if (depth < nearest) near_at = clamp(beside, ivec2(0), last);
        if (depth > farthest) far_at = clamp(beside, ivec2(0), last);
        nearest = min(nearest, depth);
        farthest = max(farthest, depth);
    }
    float near = distance_of(nearest), far = distance_of(farthest);
    float width = pixel_width * near;  // voxels
    bool is_silhouette = far - near >= least_step * width + 1.0;
    if (!is_silhouette) discard;
    begin_ray();
    float along = 1.0 / dot(direction, forward);
    float first = clamp((near - 2.0 * width) * along - 2.0, enter, leave);
    float end = clamp(min(near + limb_depth * width, 0.5 * (near + far)) * along + 1.0, first, leave);
    float most, slope;
    find_fullest(is_silhouette, first, end, most, slope);
    float inside = (most - bone_surface) / max(slope, 1e-3);
    float covered = clamp(0.5 + inside / width, 0.0, 1.0);
    bool is_far = distance_of(own) > 0.5 * (near + far);
    vec3 near_colour = texelFetch(drawn_colour, is_far ? near_at : here, 0).rgb;
    vec3 far_colour = texelFetch(drawn_colour, is_far ? here : far_at, 0).rgb;
    pixel = vec4(mix(far_colour, near_colour, covered), 1.0);
}
