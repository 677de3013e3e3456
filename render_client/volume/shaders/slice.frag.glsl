// A pixel of a view-aligned slice; follows cut_shading.glsl. Lengths are in voxels, in texture coordinates of the bone's box.

const int solid_pass = 0, light_pass = 1, depth_pass = 2;
uniform vec3 eye, forward;
uniform float spacing;
uniform int drawn_pass;
in vec3 sampled;
out vec4 pixel;

void main() {
    vec3 from_eye = sampled - eye;
    vec3 direction = normalize(from_eye);
    vec3 along = from_eye * (spacing / dot(from_eye, forward));  // from the slice before, on this ray
    pixel = vec4(0.0);
    if (fraction_at(sampled) < bone_surface || is_cut_away(sampled)) discard;
    if (drawn_pass == light_pass) {
        float opacity;
        pixel = translucent_piece(sampled, length(along), 1.0, opacity);
        return;
    }
    if (drawn_pass == depth_pass) {
        if (look_at(sampled).a < solid_opacity) discard;
        return;
    }
    float outside = 1.0, inside = 0.0;  // in steps before the slice
    for (int halving = 0; halving < 6; ++halving) {
        float middle = 0.5 * (outside + inside);
        vec3 before = sampled - middle * along;
        if (fraction_at(before) >= bone_surface && !is_cut_away(before)) inside = middle;
        else outside = middle;
    }
    pixel = vec4(shown_pixel(sampled - inside * along, direction), 1.0);
}
