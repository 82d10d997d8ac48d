// three.js in headless Chromium: node edges.mjs MODEL.obj CAMERA.json DRAWING.png. Chromium's is the only full WebGL 2 without a window.
import { spawn } from 'node:child_process';
import { mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { tmpdir } from 'node:os';
import { dirname, extname, join } from 'node:path';
import { fileURLToPath } from 'node:url';

const [model, camera, drawing] = process.argv.slice(2);
const here = dirname(fileURLToPath(import.meta.url));
const packages = process.env.LEAGUE_NODE_MODULES ?? join(here, 'node_modules');
const types = { '.html': 'text/html', '.js': 'text/javascript' };
const profile = mkdtempSync(join(tmpdir(), 'league-'));
let browser;

function finish(result) {
  writeFileSync(drawing, Buffer.from(result.picture.split(',')[1], 'base64'));
  console.log(JSON.stringify({
    version: `three.js r${result.version}`, renderer: result.renderer, drawing_seconds: result.drawing_seconds }));
  browser.on('exit', () => {
    // Its other processes may still be writing there; then the folder stays behind.
    try { rmSync(profile, { recursive: true, force: true, maxRetries: 5 }); } catch { }
    process.exit(0);
  });
  browser.kill();
}

const server = createServer((request, response) => {
  const path = request.url.split('?')[0];
  if (path === '/drawing') {
    let body = '';
    request.on('data', (part) => { body += part; });
    request.on('end', () => { response.end(); finish(JSON.parse(body)); });
    return;
  }
  const file = path === '/model' ? model : path === '/camera' ? camera
    : path.startsWith('/node_modules/') ? join(packages, path.slice('/node_modules'.length)) : join(here, path);
  try {
    response.setHeader('Content-Type', types[extname(file)] ?? 'text/plain');
    response.end(readFileSync(file));
  } catch {
    response.writeHead(404).end();
  }
});
server.listen(0, '127.0.0.1', () => {
  const options = ['--headless=new', '--no-sandbox', '--disable-gpu-sandbox', '--use-gl=angle', '--use-angle=swiftshader',
    '--enable-unsafe-swiftshader', `--user-data-dir=${profile}`, `http://127.0.0.1:${server.address().port}/edges.html`];
  browser = spawn(process.env.LEAGUE_CHROMIUM ?? 'chromium', options, { stdio: 'ignore' });
});
