#version 120
// The light as a hand would put it down: in slanting strokes, pressed now more, now less. Ours; the report leaves more irregular
// strokes and shading to others (section 5).
// In:  the light; noiseTexture and noiseSize, its texels; strokeScale, the picture's sides in shorter sides; the part paper-*.
// Out: the light, changed by a quarter at most, and not at all where there is none or all of it, so that closure stays.

const float STRENGTH = 0.2;
// Strokes across and along a shorter side of the picture, and how they slant.
const vec2 STROKES = vec2(84.0, 6.0);
const vec2 SLANT = vec2(0.80, 0.60);
const float PRESSURES = 4.0;

uniform sampler2D noiseTexture;
uniform vec2 noiseSize;
uniform vec2 strokeScale;

vec2 paperPlace();

// Smooth noise with a value for each whole number, 0 to 1.
float value(vec2 place) {
    vec2 cell = floor(place);
    vec2 share = fract(place);
    share = share * share * (3.0 - 2.0 * share);
    // Between the middles of four texels the filter mixes them.
    return texture2D(noiseTexture, (cell + share + 0.5) / noiseSize).r;
}

float stroked(float light) {
    vec2 place = paperPlace() * strokeScale;
    // Bent a little, as a hand turns about its wrist.
    place += 0.05 * vec2(value(place * PRESSURES + 7.5), value(place * PRESSURES + 31.5));
    vec2 along = vec2(place.x * SLANT.x - place.y * SLANT.y, place.x * SLANT.y + place.y * SLANT.x);
    float stroke = value(along * STROKES) - 0.5;
    float pressure = value(place * PRESSURES + 53.5) - 0.5;
    float tone = clamp(light, 0.0, 1.0);
    return max(light + STRENGTH * (1.5 * stroke + pressure) * 4.0 * tone * (1.0 - tone), 0.0);
}
