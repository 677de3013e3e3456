// A pixel of a soft structure, lit like bone; if a cut has opened it, its inside shows. Follows lighting.glsl and cuts.glsl,
// whose points are here in the coordinates of the mesh.

uniform float opacity;
in vec3 place, surface_normal, surface_colour;
out vec4 pixel;

void main() {
    if (is_cut_away(place)) discard;
    vec3 normal = normalize(surface_normal);
    if (!gl_FrontFacing) normal = -normal;
    pixel = vec4(display(1.25 * lit(surface_colour, normal, 1.0)), opacity);
}
