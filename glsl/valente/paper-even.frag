#version 120
// The paper where nothing is drawn on it, as parts lay it on the picture. Ours, as paper.vert.
// In:  paperCoord from paper.vert; paperTexture; the parts spread-* and grain-*.
// Out: gl_FragColor, the paper's colour.

uniform sampler2D paperTexture;

varying vec2 paperCoord;

vec2 onPaper(vec2 place);

void main() {
    gl_FragColor = texture2D(paperTexture, onPaper(paperCoord));
}
