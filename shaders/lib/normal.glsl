// The unit normal  p_u x p_v / |p_u x p_v|  of the projected surface (GL_AUTO_NORMAL), with its
// limit where the cross product vanishes: at a pole, or at a corner of r where p_u = -p_v.
// Twin: geometry/normal.py

// Overflows at no length that a float can hold; the zero vector stays zero.
vec3 safe_normalize(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

// The derivative of X/w by the quotient rule, but for the positive factor 1/w.
vec3 projected_derivative(vec4 point, vec4 derivative) {
    return derivative.xyz - derivative.w * (point.xyz / point.w);
}

vec3 cross_of_tangents(sampler2D net, int patch_index, ivec2 degree, vec4 uv, vec4 point) {
    vec4 along_u, along_v;
    evaluate_derivatives(net, patch_index, degree, uv, along_u, along_v);
    return cross(safe_normalize(projected_derivative(point, along_u)),
                 safe_normalize(projected_derivative(point, along_v)));
}

vec3 surface_normal(sampler2D net, int patch_index, ivec2 degree, vec4 uv, vec4 point) {
    vec3 normal = cross_of_tangents(net, patch_index, degree, uv, point);
    if (dot(normal, normal) <= SINGULAR_SINE * SINGULAR_SINE) {
        uv = mix(uv, vec4(0.5), SINGULAR_STEP);
        point = evaluate(net, patch_index, degree, uv);
        normal = cross_of_tangents(net, patch_index, degree, uv, point);
    }
    return dot(normal, normal) > 0.0 ? normalize(normal) : vec3(0.0, 0.0, 1.0);
}
