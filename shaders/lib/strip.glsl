// Many points of one iso-curve u = const: first the curve as a Bezier curve in v, once, then its
// points, so that each control point of the patch is fetched once for all of them.
// Twin: geometry/evaluate.py
//
//      c_0j -+
//      c_1j  |  B_i(u)      q_j, the curve's       B_j(v_k)      point k
//      ...   +----------->  control points     ------------->
//      c_dj -+
//
// The sums pair first with last as in evaluate.glsl. On the patch's edges one of the two bases is
// 1, 0 ... 0, so there the points are evaluate()'s, bit for bit.

#include "evaluate.glsl"

// Control points of the curve, and of its derivative across, d/du.
void iso_curve(sampler2D net, int patch_index, ivec2 degree, vec2 u,
               out vec4 curve[MAX_ORDER], out vec4 across[MAX_ORDER]) {
    float row[MAX_ORDER], slope[MAX_ORDER];
    bernstein(degree.x, u, row);
    bernstein_derivative(degree.x, u, slope);
    int order = degree.y + 1, first = patch_index * (degree.x + 1) * order;
    for (int j = 0; j < order; ++j) {
        PRECISE vec4 sum = vec4(0.0);
        across[j] = vec4(0.0);
        for (int i = 0; 2 * i <= degree.x; ++i) {
            int k = degree.x - i;
            vec4 control = control_point(net, first + i * order + j);
            PRECISE vec4 pair = row[i] * control;
            across[j] += slope[i] * control;
            if (k != i) {
                control = control_point(net, first + k * order + j);
                PRECISE vec4 mirrored = row[k] * control;
                pair = pair + mirrored;
                across[j] += slope[k] * control;
            }
            sum = sum + pair;
        }
        curve[j] = sum;
    }
}

// sum_j basis[j] curve[j]
vec4 curve_point(int degree, float basis[MAX_ORDER], vec4 curve[MAX_ORDER]) {
    PRECISE vec4 sum = vec4(0.0);
    for (int j = 0; 2 * j <= degree; ++j) {
        int k = degree - j;
        PRECISE vec4 pair = basis[j] * curve[j];
        if (k != j) {
            PRECISE vec4 mirrored = basis[k] * curve[k];
            pair = pair + mirrored;
        }
        sum = sum + pair;
    }
    return sum;
}
