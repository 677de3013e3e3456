// Two pictures of half the height in one, row by row: the left eye's has the top row.

uniform sampler2D left_eye, right_eye;
uniform int height;
out vec4 pixel;

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    int row = height - 1 - place.y;  // from the top
    ivec2 size = textureSize(left_eye, 0);
    ivec2 source = ivec2(place.x, max(size.y - 1 - row / 2, 0));
    pixel = row % 2 == 0 ? texelFetch(left_eye, source, 0) : texelFetch(right_eye, source, 0);
}
