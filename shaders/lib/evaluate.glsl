// The evaluator: a tensor-product Bezier patch  p(u,v) = sum_ij c_ij B_i(u) B_j(v)  and its first
// derivatives, from the net alone (glMap2, OpenGL 2.1 specification, section 5.1).
// Twin: geometry/evaluate.py
//
//      c_i0 ... c_id   --- B_j(v) --->   q_i, the control points of the curve v = const
//      q_0 ... q_d     --- B_i(u) --->   p
//
// uv = (u, 1-u, v, 1-v).  Sums pair the first term with the last,
//
//      (b0 c0 + bd cd) + (b1 c1 + bd-1 cd-1) + ...
//
// so an edge read backwards, or as a u-edge here and a v-edge there, gives the same bits:
// neighbours of one degree meet without cracks.
//
// Loops that fill arrays of MAX_ORDER, and small ones, are those that Mesa's compiler unrolls;
// else the arrays lie in memory and everything takes three times as long.

#include "bernstein.glsl"
#include "net.glsl"

// sum_j basis[j] points[j]
vec4 curve_point(int degree, float basis[MAX_ORDER], vec4 points[MAX_ORDER]) {
    PRECISE vec4 sum = vec4(0.0);
    for (int j = 0; j <= degree / 2; ++j) {
        int k = degree - j;
        PRECISE vec4 pair = basis[j] * points[j];
        if (k != j) {
            PRECISE vec4 mirrored = basis[k] * points[k];
            pair = pair + mirrored;
        }
        sum = sum + pair;
    }
    return sum;
}

// The same of the control points of a net from `first` on, which are not gathered first.
vec4 net_point(sampler2D net, int first, int degree, float basis[MAX_ORDER]) {
    PRECISE vec4 sum = vec4(0.0);
    for (int j = 0; j <= degree / 2; ++j) {
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

// And with two bases at once: each control point is fetched once. The slopes of a basis sum to 0,
// so differences of weights have the sum of weights: it is 0 where all are 1, not rounding alone,
// which is much far outside [0,1].
vec4 net_point(sampler2D net, int first, int degree, float basis[MAX_ORDER],
               float slope[MAX_ORDER], out vec4 along) {
    PRECISE vec4 sum = vec4(0.0);
    vec4 weight = vec4(0.0, 0.0, 0.0, control_point(net, first).w);
    along = vec4(0.0);
    for (int j = 0; j <= degree / 2; ++j) {
        int k = degree - j;
        vec4 control = control_point(net, first + j);
        PRECISE vec4 pair = basis[j] * control;
        along += slope[j] * (control - weight);
        if (k != j) {
            control = control_point(net, first + k);
            PRECISE vec4 mirrored = basis[k] * control;
            pair = pair + mirrored;
            along += slope[k] * (control - weight);
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
    int first = patch_index * (degree.x + 1) * (degree.y + 1);
    vec4 curve[MAX_ORDER];
    for (int i = 0; i <= degree.x; ++i) {
        curve[i] = net_point(net, first + i * (degree.y + 1), degree.y, column);
    }
    return curve_point(degree.x, row, curve);
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
    vec4 curve[MAX_ORDER], ahead[MAX_ORDER], across[MAX_ORDER];
    for (int i = 0; i <= degree.x; ++i) {
        int row_first = first + i * (degree.y + 1);
        curve[i] = net_point(net, row_first, degree.y, column, column_slope, across[i]);
        ahead[i] = curve[i] - vec4(0.0, 0.0, 0.0, curve[0].w);
    }
    along_u = curve_point(degree.x, row_slope, ahead);
    along_v = curve_point(degree.x, row, across);
    return curve_point(degree.x, row, curve);
}
