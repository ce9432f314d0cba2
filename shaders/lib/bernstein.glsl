// The Bernstein basis B_i^d(t) = C(d,i) t^i (1-t)^(d-i).  Twin: geometry/bernstein.py
//
// A parameter is a pair t = (t, 1-t), both given by the caller: reversing an edge then swaps
// two floats and changes no bit, where computing 1-t here would.
//
// Triangular recursion with a carry, all terms positive (The NURBS Book, A1.3):
//
//      1
//      s   t              s = 1-t;  entry = s * (above) + t * (above left)
//      s2  2st  t2
//
// It runs upwards: Mesa 22.3's llvmpipe miscompiles the in-place downward loop.

void bernstein(int degree, vec2 t, out float basis[MAX_ORDER]) {
    basis[0] = 1.0;
    for (int k = 1; k <= degree; ++k) {
        PRECISE float carry = 0.0;
        for (int i = 0; i < k; ++i) {
            PRECISE float above = basis[i];
            PRECISE float entry = carry + t.y * above;
            basis[i] = entry;
            carry = t.x * above;
        }
        basis[k] = carry;
    }
}

// d/dt B_i^d = d (B_{i-1}^{d-1} - B_i^{d-1});  zero for degree 0.
void bernstein_derivative(int degree, vec2 t, out float slope[MAX_ORDER]) {
    float lower[MAX_ORDER];
    bernstein(max(degree - 1, 0), t, lower);
    slope[0] = degree > 0 ? -float(degree) * lower[0] : 0.0;
    for (int i = 1; i < degree; ++i)
        slope[i] = float(degree) * (lower[i - 1] - lower[i]);
    if (degree > 0)
        slope[degree] = float(degree) * lower[degree - 1];
}
