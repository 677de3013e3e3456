// Whether depth is discontinuous within a block of the drawn picture, or between it and the pixels beside it: a fragment a block. It may say
// so of a block in which silhouettes.frag.glsl finds no pixel, and never the other way round.

uniform sampler2D drawn_depth;
uniform vec2 picture_size;
uniform vec2 depth_terms;
uniform float pixel_width;
out vec4 pixel;

const int block_edge = 8, with_border = block_edge + 2;

// A pixel lies between the two sides of a discontinuity: one of the steps to its neighbours has half of it at least.
bool is_discontinuity(float a, float b) { return abs(a - b) >= 0.45 * (8.0 * pixel_width * min(a, b) + 1.0); }

void main() {
    ivec2 first = block_edge * ivec2(gl_FragCoord.xy) - 1, last = ivec2(picture_size) - 1;
    float above[with_border];
    bool is_found = false;
    for (int y = 0; y < with_border; ++y) {
        float before = 0.0;
        for (int x = 0; x < with_border; ++x) {
            float depth = texelFetch(drawn_depth, clamp(first + ivec2(x, y), ivec2(0), last), 0).r;
            float here = depth_terms.y / (depth - depth_terms.x);
            if (x > 0 && is_discontinuity(here, before)) is_found = true;
            if (y > 0 && is_discontinuity(here, above[x])) is_found = true;
            above[x] = before = here;
        }
    }
    pixel = vec4(is_found ? 1.0 : 0.0);
}
