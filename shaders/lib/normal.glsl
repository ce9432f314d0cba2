// The unit normal  p_u x p_v / |p_u x p_v|  of the projected surface (GL_AUTO_NORMAL), with its
// limit where the cross product vanishes: at a pole, or at a corner of r where p_u = -p_v.
// Twin: geometry/normal.py

// Overflows at no length that a float can hold; the zero vector stays zero.
vec3 safe_normalize(vec3 v) {
    float largest = max(max(abs(v.x), abs(v.y)), abs(v.z));
    return largest > 0.0 ? normalize(v / largest) : vec3(0.0);
}

// w times the derivative of X/w, by the quotient rule; none at infinity.
vec3 projected_derivative(vec4 point, vec4 derivative) {
    vec3 affine = point.xyz / point.w;
    return point.w != 0.0 ? derivative.xyz - derivative.w * affine : vec3(0.0);
}

float largest_component(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// The sine between the tangents, as a vector. Zero too where one of them is tiny beside the
// other: at a pole it is rounding alone.
vec3 cross_of_tangents(vec4 point, vec4 along_u, vec4 along_v) {
    vec3 p_u = projected_derivative(point, along_u), p_v = projected_derivative(point, along_v);
    float size_u = largest_component(p_u), size_v = largest_component(p_v);
    if (min(size_u, size_v) <= SINGULAR_SINE * max(size_u, size_v))
        return vec3(0.0);
    return cross(safe_normalize(p_u), safe_normalize(p_v));
}

bool is_singular(vec3 normal) {
    return dot(normal, normal) <= SINGULAR_SINE * SINGULAR_SINE;
}

// The unit normal from the cross product of the tangents at uv; the limit where that vanishes.
vec3 limit_normal(sampler2D net, int patch_index, ivec2 degree, vec4 uv, vec3 normal) {
    // A loop and not an `if`: software rasterisers execute an `if` for every vertex.
    for (float inward = SINGULAR_STEP; is_singular(normal) && inward < 1.0; inward *= SINGULAR_FACTOR) {
        vec4 inside = mix(uv, vec4(0.5), inward), along_u, along_v;
        vec4 nearby = evaluate_derivatives(net, patch_index, degree, inside, along_u, along_v);
        normal = cross_of_tangents(nearby, along_u, along_v);
    }
    return dot(normal, normal) > 0.0 ? normalize(normal) : vec3(0.0, 0.0, 1.0);
}

// The normal; the point comes with it, the same bits as evaluate()'s.
vec3 surface_normal(sampler2D net, int patch_index, ivec2 degree, vec4 uv, out vec4 point) {
    vec4 along_u, along_v;
    point = evaluate_derivatives(net, patch_index, degree, uv, along_u, along_v);
    vec3 normal = cross_of_tangents(point, along_u, along_v);
    return limit_normal(net, patch_index, degree, uv, normal);
}
