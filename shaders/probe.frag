// Reads the tessellation evaluator back: one texel a grid point (patch.tese with PROBE).

flat in vec4 probed_parameters;
flat in vec4 probed_point;
flat in vec3 probed_normal;

layout(location = 0) out vec4 parameters;
layout(location = 1) out vec4 point;
layout(location = 2) out vec4 normal;

void main() {
    parameters = probed_parameters;
    point = probed_point;
    normal = vec4(probed_normal, 0.0);
}
