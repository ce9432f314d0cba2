// Where on which patch a fragment lies, for measuring how far off it is.

flat in int located_patch;
in vec2 located_uv;
out vec4 fragment;

void main() {
    fragment = vec4(located_patch, located_uv, 1.0);
}
