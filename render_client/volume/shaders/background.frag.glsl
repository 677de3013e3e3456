// The background of a picture, behind the bone.

uniform vec2 picture_size;
out vec4 pixel;

void main() { pixel = vec4(display(background_at(gl_FragCoord.xy / picture_size)), 1.0); }
