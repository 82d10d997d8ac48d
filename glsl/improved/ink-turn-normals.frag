#version 120
// A crease where the model's normals turn at once: between a pixel and one of opposite ones, by more than an angle. Where a surface
// is round, even if narrow, it turns half before the pixel and half behind it.
// In:  texels of normal-map.frag on four sides; planeMap, textureUnit: that of the pixel itself; creaseCosine, cosine of the angle.
// Out: whether there is one; none where one of the texels is the background.

uniform sampler2D planeMap;
uniform vec2 textureUnit;
uniform float creaseCosine;

vec3 decodedNormal(vec4 texel) {
    vec2 disc = texel.ba * 2.0 - 1.0;
    float height = 1.0 - dot(disc, disc);
    return vec3(2.0 * sqrt(max(height, 0.0)) * disc, 2.0 * height - 1.0);
}

bool turnsFrom(vec3 normal, vec4 texel) {
    return texel.r != 0.0 && dot(normal, decodedNormal(texel)) < creaseCosine;
}

bool turns(vec4 left, vec4 right, vec4 below, vec4 above) {
    vec4 own = texture2D(planeMap, gl_FragCoord.xy * textureUnit);
    vec3 normal = decodedNormal(own);
    return own.r != 0.0
        && (turnsFrom(normal, left) || turnsFrom(normal, right) || turnsFrom(normal, below) || turnsFrom(normal, above));
}
