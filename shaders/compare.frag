// Another picture laid over the one drawn: whole from `divider` on, to the share `blend` before it.
//
//     blend | whole
//           ^ divider, in pixels from the left

uniform sampler2D picture;   // as large as the target, its texels are the target's pixels
uniform float divider;
uniform float blend;         // 0 .. 1
out vec4 fragment;

void main() {
    vec3 color = texelFetch(picture, ivec2(gl_FragCoord.xy), 0).rgb;
    fragment = vec4(color, gl_FragCoord.x > divider ? 1.0 : blend);
}
