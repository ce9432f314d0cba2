// Arrow heads of a fixed size in pixels at points of the model, that point
// away from `tail`.
//
//        side
//     ^  +-----+
//     |  |  o  |   o = at;  the square is `size` pixels to each side
//     |  +-----+
//     +--> ahead

uniform mat4 clip_from_model;
uniform vec2 viewport;
uniform float size;         // pixels
uniform float depth_bias;

in vec2 corner;             // -1 .. +1
in vec4 at, tail;

out vec2 place;             // pixels from the mark's middle: (ahead, to the left)

void main() {
    vec4 clip = clip_from_model * at, behind = clip_from_model * tail;
    vec2 ahead = (clip.xy / clip.w - behind.xy / behind.w) * viewport;
    ahead = dot(ahead, ahead) > 0.0 ? normalize(ahead) : vec2(1.0, 0.0);
    place = corner * (size + 1.0);
    vec2 offset = ahead * place.x + vec2(-ahead.y, ahead.x) * place.y;
    gl_Position = vec4(clip.xy / clip.w + offset / (0.5 * viewport),
                       clip.z / clip.w - depth_bias, 1.0);
}
