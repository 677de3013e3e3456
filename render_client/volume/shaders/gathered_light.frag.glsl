// Light gathered from slices, over the background; follows lighting.glsl and background.glsl.

uniform sampler2D light;
uniform vec2 picture_size;
out vec4 pixel;

void main() {
    vec4 gathered = texelFetch(light, ivec2(gl_FragCoord.xy), 0);
    vec3 behind = background_at(gl_FragCoord.xy / picture_size);
    pixel = vec4(display(gathered.rgb + (1.0 - gathered.a) * behind), 1.0);
}
