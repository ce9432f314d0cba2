// A curve from its own formulas x(u) and y(u), at a list of parameters: captured, then drawn as
// any line is.  FORMULA_X and FORMULA_Y are what a scene's Formula layer says, in GLSL.

#include "lib/formula.glsl"

uniform float w;   // what else the formulas depend on

in float parameter;

out vec4 point;

void main() {
    float u = parameter;
    point = vec4(FORMULA_X(u, w), FORMULA_Y(u, w), 0.0, 1.0);
    gl_Position = vec4(0.0);
}
