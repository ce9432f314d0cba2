// The unit normal  p_u x p_v / |p_u x p_v|  of the projected surface (GL_AUTO_NORMAL), with its
// limit where the cross product vanishes: at a pole, or at a corner of r where p_u = -p_v.
// Twin: geometry/normal.py

// w times the derivative of X/w, by the quotient rule; none at infinity.
vec3 projected_derivative(vec4 point, vec4 derivative) {
    vec3 affine = point.xyz / point.w;
    return point.w != 0.0 ? derivative.xyz - derivative.w * affine : vec3(0.0);
}

float largest_component(vec3 v) {
    return max(max(abs(v.x), abs(v.y)), abs(v.z));
}

// The cross product of the tangents, each as long as its largest component is 1: so its length is
// the sine between them, but for a factor of at most 3. Zero too where one of them is tiny beside
// the other: at a pole it is rounding alone.
vec3 cross_of_tangents(vec4 point, vec4 along_u, vec4 along_v) {
    vec3 p_u = projected_derivative(point, along_u), p_v = projected_derivative(point, along_v);
    float size_u = largest_component(p_u), size_v = largest_component(p_v);
    if (min(size_u, size_v) <= SINGULAR_SINE * max(size_u, size_v))
        return vec3(0.0);
    return cross(p_u / size_u, p_v / size_v);
}

bool is_singular(vec3 normal) {
    return dot(normal, normal) <= SINGULAR_SINE * SINGULAR_SINE;
}

// The normal, or its limit: that a little further inside. The point at uv comes with it, the same
// bits as evaluate()'s.
vec3 surface_normal(sampler2D net, int patch_index, ivec2 degree, vec4 uv, out vec4 point) {
    vec3 normal;
    float inward = 0.0;
    // A loop, and no `if` after a first try: software rasterisers execute an `if` for every vertex.
    do {
        vec4 inside = mix(uv, vec4(0.5), inward), along_u, along_v;
        vec4 here = evaluate_derivatives(net, patch_index, degree, inside, along_u, along_v);
        if (inward == 0.0)
            point = here;
        normal = cross_of_tangents(here, along_u, along_v);
        inward = inward == 0.0 ? SINGULAR_STEP : inward * SINGULAR_FACTOR;
    } while (is_singular(normal) && inward < 1.0);
    return dot(normal, normal) > 0.0 ? normalize(normal) : vec3(0.0, 0.0, 1.0);
}
