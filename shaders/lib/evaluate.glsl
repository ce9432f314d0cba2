// The evaluator: a tensor-product Bezier patch  p(u,v) = sum_ij c_ij B_i(u) B_j(v)  and its first
// derivatives, from the net alone (glMap2, OpenGL 2.1 specification, section 5.1).
// Twin: geometry/evaluate.py
//
// uv = (u, 1-u, v, 1-v).  Sums pair the first term with the last,
//
//      (b0 c0 + bd cd) + (b1 c1 + bd-1 cd-1) + ...
//
// so an edge read backwards, or as a u-edge here and a v-edge there, gives the same bits:
// neighbours of one degree meet without cracks.

#include "bernstein.glsl"
#include "net.glsl"

// sum_j basis[j] c[first + j]
vec4 combine(sampler2D net, int first, int degree, float basis[MAX_ORDER]) {
    PRECISE vec4 sum = vec4(0.0);
    for (int j = 0; 2 * j <= degree; ++j) {
        int k = degree - j;
        PRECISE vec4 pair = basis[j] * control_point(net, first + j);
        if (k != j) {
            PRECISE vec4 mirrored = basis[k] * control_point(net, first + k);
            pair = pair + mirrored;
        }
        sum = sum + pair;
    }
    return sum;
}

// sum_ij row[i] column[j] c_ij
vec4 combine(sampler2D net, int patch_index, ivec2 degree,
             float row[MAX_ORDER], float column[MAX_ORDER]) {
    int first = patch_index * (degree.x + 1) * (degree.y + 1);
    PRECISE vec4 sum = vec4(0.0);
    for (int i = 0; 2 * i <= degree.x; ++i) {
        int k = degree.x - i;
        PRECISE vec4 pair = row[i] * combine(net, first + i * (degree.y + 1), degree.y, column);
        if (k != i) {
            PRECISE vec4 mirrored =
                row[k] * combine(net, first + k * (degree.y + 1), degree.y, column);
            pair = pair + mirrored;
        }
        sum = sum + pair;
    }
    return sum;
}

// The homogeneous point (w x, w y, w z, w).
vec4 evaluate(sampler2D net, int patch_index, ivec2 degree, vec4 uv) {
    float row[MAX_ORDER], column[MAX_ORDER];
    bernstein(degree.x, uv.xy, row);
    bernstein(degree.y, uv.zw, column);
    return combine(net, patch_index, degree, row, column);
}

// The homogeneous partial derivatives d/du and d/dv.
void evaluate_derivatives(sampler2D net, int patch_index, ivec2 degree, vec4 uv,
                          out vec4 along_u, out vec4 along_v) {
    float row[MAX_ORDER], column[MAX_ORDER], slope[MAX_ORDER];
    bernstein(degree.x, uv.xy, row);
    bernstein(degree.y, uv.zw, column);
    bernstein_derivative(degree.x, uv.xy, slope);
    along_u = combine(net, patch_index, degree, slope, column);
    bernstein_derivative(degree.y, uv.zw, slope);
    along_v = combine(net, patch_index, degree, row, slope);
}
