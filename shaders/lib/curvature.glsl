// Gauss and mean curvature of the projected surface, from the patch's own derivatives.
// Twin: geometry/curvature.py
//
//      n = p_u x p_v,   L = n.p_uu,   M = n.p_uv,   N = n.p_vv
//      K = (L N - M^2) / |n|^4
//      H = -(p_u.p_u N - 2 p_u.p_v M + p_v.p_v L) / (2 |n|^3)     > 0 on a sphere seen from outside

// d^2/dt^2 B_i^d = d (d-1) (B_(i-2)^(d-2) - 2 B_(i-1)^(d-2) + B_i^(d-2));  zero below degree 2.
void bernstein_second(int degree, vec2 t, out float bend[MAX_ORDER]) {
    float lower[MAX_ORDER];
    bernstein(max(degree - 2, 0), t, lower);
    float factor = float(degree * (degree - 1));
    for (int i = 0; i <= degree; ++i) {
        float sum = i >= 2 ? lower[i - 2] : 0.0;
        if (i >= 1 && i <= degree - 1)
            sum -= 2.0 * lower[i - 1];
        if (i <= degree - 2)
            sum += lower[i];
        bend[i] = factor * sum;
    }
}

struct Jet {   // homogeneous: the point and its derivatives
    vec4 p, u, v, uu, uv, vv;
};

Jet evaluate_jet(sampler2D net, int patch_index, ivec2 degree, vec4 uv) {
    float row[MAX_ORDER], row_slope[MAX_ORDER], row_bend[MAX_ORDER];
    float column[MAX_ORDER], column_slope[MAX_ORDER], column_bend[MAX_ORDER];
    bernstein(degree.x, uv.xy, row);
    bernstein_derivative(degree.x, uv.xy, row_slope);
    bernstein_second(degree.x, uv.xy, row_bend);
    bernstein(degree.y, uv.zw, column);
    bernstein_derivative(degree.y, uv.zw, column_slope);
    bernstein_second(degree.y, uv.zw, column_bend);
    int first = patch_index * (degree.x + 1) * (degree.y + 1);
    Jet jet = Jet(vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0), vec4(0.0));
    for (int i = 0; i <= degree.x; ++i) {
        vec4 p = vec4(0.0), v = vec4(0.0), vv = vec4(0.0);
        for (int j = 0; j <= degree.y; ++j) {
            vec4 control = control_point(net, first + i * (degree.y + 1) + j);
            p += column[j] * control;
            v += column_slope[j] * control;
            vv += column_bend[j] * control;
        }
        jet.p += row[i] * p;
        jet.u += row_slope[i] * p;
        jet.v += row[i] * v;
        jet.uu += row_bend[i] * p;
        jet.uv += row_slope[i] * v;
        jet.vv += row[i] * vv;
    }
    return jet;
}

// The derivatives of X/w, by the quotient rule (The NURBS Book, A4.4).
void project_jet(Jet jet, out vec3 u, out vec3 v, out vec3 uu, out vec3 uv, out vec3 vv) {
    vec3 p = jet.p.xyz / jet.p.w;
    u = (jet.u.xyz - jet.u.w * p) / jet.p.w;
    v = (jet.v.xyz - jet.v.w * p) / jet.p.w;
    uu = (jet.uu.xyz - jet.uu.w * p - 2.0 * jet.u.w * u) / jet.p.w;
    uv = (jet.uv.xyz - jet.uv.w * p - jet.u.w * v - jet.v.w * u) / jet.p.w;
    vv = (jet.vv.xyz - jet.vv.w * p - 2.0 * jet.v.w * v) / jet.p.w;
}

// (K, H), and n, which is not normalised; (0, 0) where n vanishes.
vec2 curvatures(sampler2D net, int patch_index, ivec2 degree, vec4 uv, out vec3 n) {
    vec3 p_u, p_v, p_uu, p_uv, p_vv;
    project_jet(evaluate_jet(net, patch_index, degree, uv), p_u, p_v, p_uu, p_uv, p_vv);
    n = cross(p_u, p_v);
    float square = dot(n, n);
    if (!(square > REGULAR * dot(p_u, p_u) * dot(p_v, p_v)))
        return vec2(0.0);
    float l = dot(n, p_uu), m = dot(n, p_uv), nn = dot(n, p_vv);
    float mean = dot(p_u, p_u) * nn - 2.0 * dot(p_u, p_v) * m + dot(p_v, p_v) * l;
    return vec2((l * nn - m * m) / (square * square), -mean / (2.0 * square * sqrt(square)));
}
