#version 120
// The paper where nothing is drawn on it. Ours, as paper.vert.
// In:  paperCoord from paper.vert; paperTexture.
// Out: gl_FragColor, the paper's colour.

uniform sampler2D paperTexture;

varying vec2 paperCoord;

void main() {
    gl_FragColor = texture2D(paperTexture, paperCoord);
}
