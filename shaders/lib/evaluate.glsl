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

// The same with two bases at once: each control point is fetched once.
void combine(sampler2D net, int first, int degree, float basis[MAX_ORDER], float slope[MAX_ORDER],
             out vec4 point, out vec4 along) {
    PRECISE vec4 sum = vec4(0.0);
    along = vec4(0.0);
    for (int j = 0; 2 * j <= degree; ++j) {
        int k = degree - j;
        vec4 control = control_point(net, first + j);
        PRECISE vec4 pair = basis[j] * control;
        along += slope[j] * control;
        if (k != j) {
            control = control_point(net, first + k);
            PRECISE vec4 mirrored = basis[k] * control;
            pair = pair + mirrored;
            along += slope[k] * control;
        }
        sum = sum + pair;
    }
    point = sum;
}

// The homogeneous point (w x, w y, w z, w).
vec4 evaluate(sampler2D net, int patch_index, ivec2 degree, vec4 uv) {
    float row[MAX_ORDER], column[MAX_ORDER];
    bernstein(degree.x, uv.xy, row);
    bernstein(degree.y, uv.zw, column);
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

// The same point, bit for bit, and the homogeneous partial derivatives d/du and d/dv.
vec4 evaluate_derivatives(sampler2D net, int patch_index, ivec2 degree, vec4 uv,
                          out vec4 along_u, out vec4 along_v) {
    float row[MAX_ORDER], column[MAX_ORDER], row_slope[MAX_ORDER], column_slope[MAX_ORDER];
    bernstein(degree.x, uv.xy, row);
    bernstein(degree.y, uv.zw, column);
    bernstein_derivative(degree.x, uv.xy, row_slope);
    bernstein_derivative(degree.y, uv.zw, column_slope);
    int first = patch_index * (degree.x + 1) * (degree.y + 1);
    PRECISE vec4 sum = vec4(0.0);
    along_u = along_v = vec4(0.0);
    for (int i = 0; 2 * i <= degree.x; ++i) {
        int k = degree.x - i;
        vec4 point, along;
        combine(net, first + i * (degree.y + 1), degree.y, column, column_slope, point, along);
        PRECISE vec4 pair = row[i] * point;
        along_u += row_slope[i] * point;
        along_v += row[i] * along;
        if (k != i) {
            combine(net, first + k * (degree.y + 1), degree.y, column, column_slope, point, along);
            PRECISE vec4 mirrored = row[k] * point;
            pair = pair + mirrored;
            along_u += row_slope[k] * point;
            along_v += row[k] * along;
        }
        sum = sum + pair;
    }
    return sum;
}
