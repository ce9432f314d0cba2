// Points of Bezier curves at fractions of their length: what makes a motion of constant speed.
// The table holds (u, du/dfraction) at equal fractions, the curve's pieces follow one another at
// u = 0, 1, 2, ...  OpenGL 3.3; captured, then drawn as dots or as a line.
//
//    u |              .-'      cubic Hermite between the entries
//      |         .--'
//      |   .-'
//      +--|---|---|---|--> fraction of the length

#include "lib/evaluate.glsl"

uniform sampler2D net, table;
uniform int entries, pieces;
#ifdef GENERIC_DEGREE
uniform ivec2 degree;
#else
const ivec2 degree = ivec2(DEGREE_U, DEGREE_V);
#endif

in float fraction;

out vec4 point;

float parameter_at(float fraction) {
    float at = clamp(fraction, 0.0, 1.0) * float(entries - 1);
    int k = min(int(at), entries - 2);
    vec2 here = control_point(table, k).xy, next = control_point(table, k + 1).xy;
    float x = at - float(k), step = 1.0 / float(entries - 1);
    return here.x + x * x * (3.0 - 2.0 * x) * (next.x - here.x)
        + step * x * (1.0 - x) * ((1.0 - x) * here.y - x * next.y);
}

void main() {
    float u = parameter_at(fraction);
    int piece = clamp(int(floor(u)), 0, pieces - 1);
    float t = clamp(u - float(piece), 0.0, 1.0);
    point = evaluate(net, piece, degree, vec4(t, 1.0 - t, 0.0, 1.0));
    gl_Position = vec4(0.0);
}
