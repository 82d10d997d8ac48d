#version 120
// Noise that lies on the model and turns with it, as wallpaper glued on along the axis its normal is nearest to. Ours.
// In: objectPosition, objectNormal from charcoal-object.vert; noiseScale, noise textures a scene radius across and up; the part
//     grain-*.
// Out: the noise texture's coordinate.

uniform vec2 noiseScale;

varying vec3 objectPosition;
varying vec3 objectNormal;

vec2 grainPlace(vec2 place);

vec2 noisePlace() {
    vec3 along = abs(objectNormal);
    vec2 place = objectPosition.xy;
    if (along.x > along.y && along.x > along.z) place = objectPosition.zy;
    else if (along.y > along.z) place = objectPosition.xz;
    return grainPlace(place * noiseScale);
}
