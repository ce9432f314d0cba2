// What formulas are made of beyond GLSL's own operators (geometry/formula.py writes them). Drivers
// may compute sin and cos with an error of 2^-11 and more; these are good to a few units of the
// last place, after the Cephes library's single precision functions.

// x^n for a whole n, of any x.
float whole_power(float x, int n) {
    float product = 1.0, factor = n < 0 ? 1.0 / x : x;
    for (int k = abs(n); k > 0; k >>= 1) {
        if ((k & 1) == 1)
            product *= factor;
        factor *= factor;
    }
    return product;
}

// Both at once: x is brought to [-pi/4, pi/4] by whole quarter turns, taken off in three parts.
vec2 cosine_and_sine(float x) {
    float quarters = floor(x * 0.636619772 + 0.5);
    PRECISE float r = x - quarters * 1.5703125;
    r = r - quarters * 4.837512969970703125e-4;
    r = r - quarters * 7.549789948768648e-8;
    float s = r * r;
    float sine = r + r * s * (-1.6666654611e-1 + s * (8.3321608736e-3 - s * 1.9515295891e-4));
    float cosine = 1.0 - 0.5 * s
        + s * s * (4.166664568298827e-2 + s * (-1.388731625493765e-3 + s * 2.443315711809948e-5));
    int turn = int(quarters) & 3;
    vec2 both = (turn & 1) == 0 ? vec2(cosine, sine) : vec2(-sine, cosine);
    return turn >= 2 ? -both : both;
}

float cosine(float x) {
    return cosine_and_sine(x).x;
}

float sine(float x) {
    return cosine_and_sine(x).y;
}

float tangent(float x) {
    vec2 both = cosine_and_sine(x);
    return both.y / both.x;
}

// On [0, tan(pi/8)] by a polynomial; elsewhere the argument is turned back by pi/2 or pi/4.
float arctangent(float x) {
    float size = abs(x), base = 0.0, y = size;
    if (size > 2.414213562) {
        base = 1.570796327;
        y = -1.0 / size;
    } else if (size > 0.4142135624) {
        base = 0.7853981634;
        y = (size - 1.0) / (size + 1.0);
    }
    float s = y * y;
    float angle = base + (((8.05374449538e-2 * s - 1.38776856032e-1) * s + 1.99777106478e-1) * s
        - 3.33329491539e-1) * s * y + y;
    return x < 0.0 ? -angle : angle;
}

float arcsine(float x) {
    return arctangent(x / sqrt((1.0 - x) * (1.0 + x)));
}

float arccosine(float x) {
    return 2.0 * arctangent(sqrt((1.0 - x) / (1.0 + x)));
}
