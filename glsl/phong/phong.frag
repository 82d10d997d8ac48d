#version 120
// Phong's equation with the light of the cartoon styles: ambient + diffuse + specular, none of them weaker with the light's
// distance. Weights and exponent are ours, for the paper prints none (errata E14).
// In:  normalEye, positionEye, gl_Color.
// Out: gl_FragColor, opaque.

varying vec3 normalEye;
varying vec3 positionEye;

const vec3 lightPos = vec3(1.0, 1.0, 1.0);
const float ambient = 0.25;
const float specular = 0.35;
const float shininess = 24.0;

void main() {
    vec3 normal = normalize(normalEye);
    vec3 lightDir = normalize(lightPos - positionEye);
    vec3 viewDir = normalize(-positionEye);
    float diffuse = max(dot(lightDir, normal), 0.0);
    float highlight = 0.0;
    if (diffuse > 0.0) highlight = pow(max(dot(reflect(-lightDir, normal), viewDir), 0.0), shininess);
    gl_FragColor = vec4(gl_Color.rgb * (ambient + (1.0 - ambient) * diffuse) + vec3(specular * highlight), 1.0);
}
