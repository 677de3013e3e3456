// Squares of two triangles each over the blocks of the picture with a depth discontinuity, with the camera's ray as camera_rays.vert.glsl
// has it. A software rasteriser spends a twentieth of a frame on a picture's pixels even if it discards them all at once.

uniform sampler2D discontinuity_blocks;
uniform vec2 first_block, block_counts;  // those that are drawn, row by row
uniform vec2 picture_size;
uniform vec3 middle_ray, right, up;
out vec3 ray;

const float block_edge = 8.0;

void main() {
    int block = gl_VertexID / 6, corner = gl_VertexID % 6, columns = int(block_counts.x);
    ivec2 at = ivec2(first_block) + ivec2(block % columns, block / columns);
    if (corner > 2) corner = 6 - corner;  // 0 1 2, 3 2 1
    vec2 place = min(block_edge * (vec2(at) + vec2(corner & 1, corner >> 1)), picture_size) / picture_size * 2.0 - 1.0;
    ray = middle_ray + place.x * right + place.y * up;
    // Beside the picture where there is no discontinuity.
    gl_Position = texelFetch(discontinuity_blocks, at, 0).r > 0.5 ? vec4(place, 0.0, 1.0) : vec4(2.0, 2.0, 2.0, 1.0);
}
