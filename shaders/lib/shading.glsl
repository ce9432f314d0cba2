// Colours that show shape, and how it is tessellated.  Twin: scenes/shading.py

// Bright and dark bands stand upright around the eye and are mirrored in the surface; their edges
// are reflection lines, kinked where a tangent plane jumps, broken where a curvature does.
// `normal` and the direction `sight` to the eye are unit vectors in the eye's coordinates; the
// result is 1 in a bright band, 0 in a dark one, and in between in the pixels that hold both.
float zebra_wave(vec3 normal, vec3 sight) {
    const float RATE = 3.14159265 * ZEBRA_BANDS;
    return sin(RATE * 2.0 * dot(normal, sight) * normal.x - RATE * sight.x);
}

float zebra(vec3 normal, vec3 sight) {
    float wave = zebra_wave(normal, sight);
    return clamp(0.5 + wave / max(fwidth(wave), 1e-6), 0.0, 1.0);
}

// From -1 (blue) over 0 (white) to 1 (vermillion).
vec3 diverging(float value) {
    vec3 end = value < 0.0 ? vec3(LOW_COLOR) : vec3(HIGH_COLOR);
    return mix(vec3(1.0), end, min(abs(value), 1.0));
}

// By the number of steps, logarithmically: pale for one, dark for LEVEL_FULL and more.
vec3 level_color(float steps) {
    const vec3 colors[] = vec3[](LEVEL_COLORS);
    float place = clamp(log2(max(steps, 1.0)) / log2(LEVEL_FULL), 0.0, 1.0)
        * float(colors.length() - 1);
    int k = min(int(place), colors.length() - 2);
    return mix(colors[k], colors[k + 1], place - float(k));
}

// By what is allowed: white for nothing, blue up to 1; above from orange to vermillion at 2.
vec3 error_color(float share) {
    return share <= 1.0 ? mix(vec3(1.0), vec3(LOW_COLOR), share)
                        : mix(vec3(OVER_COLOR), vec3(HIGH_COLOR), min(share - 1.0, 1.0));
}
