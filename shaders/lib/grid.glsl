// Grid point k of n as the pair (k/n, (n-k)/n): exact at both ends, and the mirror image of
// point n-k bit for bit.  Twin: grid_parameters in geometry/evaluate.py

float fraction(int k, int n) {
    return k == n ? 1.0 : float(k) / float(n);
}

vec4 grid_parameters(ivec2 step_index, ivec2 level) {
    return vec4(fraction(step_index.x, level.x), fraction(level.x - step_index.x, level.x),
                fraction(step_index.y, level.y), fraction(level.y - step_index.y, level.y));
}
