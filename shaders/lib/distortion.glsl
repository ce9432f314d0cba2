// What a map does to a picture that it carries to a surface.  Twin: geometry/distortion.py
//
//      p(q^-1):  picture (s,t) <-- q -- (u,v) -- p --> space,     (a b) = (p_u p_v) (q_u q_v)^-1
//
//      b____                  area     log2 |a x b|
//      /   /  image of a      stretch  log2 of the longest over the shortest half axis of the
//     /___/   small square             ellipse that a small circle becomes
//         a                   angle    between a and b, in degrees, less 90
//
// All are 0 where q_u and q_v are parallel.

vec3 along(vec4 point, vec4 derivative) {   // of X/w, by the quotient rule
    return (derivative.xyz - derivative.w * point.xyz / point.w) / point.w;
}

vec3 distortions(sampler2D net, ivec2 degree, sampler2D map_net, int map_stride, ivec2 map_degree,
                 int patch_index, vec4 uv) {
    vec4 p_u, p_v, q_u, q_v;
    vec4 p = evaluate_derivatives(net, patch_index, degree, uv, p_u, p_v);
    vec4 q = evaluate_derivatives(map_net, patch_index * map_stride, map_degree, uv, q_u, q_v);
    vec3 x_u = along(p, p_u), x_v = along(p, p_v);
    vec2 s_u = along(q, q_u).xy, s_v = along(q, q_v).xy;
    float determinant = s_u.x * s_v.y - s_v.x * s_u.y;
    if (determinant == 0.0)
        return vec3(0.0);
    vec3 a = (x_u * s_v.y - x_v * s_u.y) / determinant;
    vec3 b = (x_v * s_u.x - x_u * s_v.x) / determinant;
    float e = dot(a, a), f = dot(a, b), g = dot(b, b);
    float area = length(cross(a, b));
    float longest = 0.5 * (e + g + length(vec2(e - g, 2.0 * f)));   // squared
    if (!(area > 1e-18 * longest))
        return vec3(-FARTHEST, FARTHEST, f > 0.0 ? -90.0 : 90.0);
    vec2 logs = clamp(vec2(log2(area), log2(longest / area)), -FARTHEST, FARTHEST);
    return vec3(logs, degrees(atan(-f, area)));
}
