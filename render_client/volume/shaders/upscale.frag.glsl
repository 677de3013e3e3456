// A coarse picture in a finer one, with its depth.

uniform sampler2D colour, depth;
uniform vec2 picture_size;
out vec4 pixel;

void main() {
    vec2 place = gl_FragCoord.xy / picture_size;
    pixel = textureLod(colour, place, 0.0);
    gl_FragDepth = textureLod(depth, place, 0.0).r;
}
