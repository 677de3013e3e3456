// Ray casting; follows cut_shading.glsl and bone_rays.glsl.

uniform vec2 picture_size;
out vec4 pixel;

const float darkest_seen = 0.004;  // of light that comes through: less changes no displayed level by one

void draw_surface(float index) {
    float inside = surface_before(index);
    pixel = vec4(shown_pixel(eye + inside * direction, direction), 1.0);
    gl_FragDepth = depth_of(inside);
}

// Front to back, until hardly any light comes through. Samples count from where the ray enters bone. If they
// counted from the box, their layers would show in the surface, like the grain of wood.
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
    begin_ray();
    float index = 0.0;
    // A software rasteriser stops if all pixels of a group are discarded; of a branch it would compute both
    // sides.
    if (!find_bone(index)) discard;
    if (bone_is_translucent) draw_translucent(index);
    else draw_surface(index);
}
