// A ball under the set's light, in WebGL2: the specular chain as a cube texture with levels, nine harmonics, and a table of the
// integrals of GGX. Without WebGL2 the page's pictures remain.
'use strict';

const element = id => document.getElementById(id);
const data = JSON.parse(element('data').textContent);
const bytesOf = base64 => Uint8Array.from(atob(base64), c => c.charCodeAt(0));

const vertexSource = `#version 300 es
out vec2 at;
void main() {
  at = vec2(gl_VertexID == 1 ? 3 : -1, gl_VertexID == 2 ? 3 : -1);
  gl_Position = vec4(at, 0, 1);
}`;

const fragmentSource = `#version 300 es
precision highp float;
uniform samplerCube chain;
uniform sampler2D table;
uniform mat3 world, camera;
uniform vec3 harmonics[9], colour;
uniform vec2 size;
uniform float field, away, level, backgroundLevel, roughness, metal, factor;
in vec2 at;
out vec4 pixel;

vec3 lookUp(vec3 direction, float lod) { return textureLod(chain, world * direction, lod).rgb; }

// Irradiance / pi.
vec3 diffuseLight(vec3 n) {
  return max(vec3(0), 0.282095 * harmonics[0]
    + 0.325735 * (n.y * harmonics[1] + n.z * harmonics[2] + n.x * harmonics[3])
    + 0.273137 * (n.x * n.y * harmonics[4] + n.y * n.z * harmonics[5] + n.x * n.z * harmonics[7])
    + 0.0788479 * (3.0 * n.z * n.z - 1.0) * harmonics[6] + 0.136569 * (n.x * n.x - n.y * n.y) * harmonics[8]);
}

vec3 shade(vec3 n, vec3 v) {
  float cosine = clamp(dot(n, v), 0.0, 1.0);
  // Texels stand for the middle of their cells.
  vec2 ab = texture(table, vec2(cosine, roughness)).rg;
  vec3 f0 = mix(vec3(0.04), colour, metal);
  vec3 single = f0 * ab.x + ab.y;
  float missing = 1.0 - ab.x - ab.y;
  vec3 mean = f0 + (1.0 - f0) / 21.0;
  vec3 multiple = single * mean * missing / (1.0 - mean * missing);
  vec3 below = (1.0 - metal) * colour * (1.0 - single - multiple);
  return single * lookUp(reflect(-v, n), level) + (multiple + below) * diffuseLight(n);
}

void main() {
  vec3 ray = camera * normalize(vec3(at * size / min(size.x, size.y) * field, 1.0));
  vec3 eye = camera * vec3(0, 0, -away);
  float along = dot(eye, ray), inside = along * along - dot(eye, eye) + 1.0;
  vec3 light = lookUp(ray, backgroundLevel);
  if (inside > 0.0 && along < 0.0) {
    vec3 n = eye + ray * (-along - sqrt(inside));
    // The last pixel of the rim is shared with the background.
    float edge = clamp(inside / fwidth(inside), 0.0, 1.0);
    light = mix(light, shade(normalize(n), -ray), edge);
  }
  light *= factor;
  vec3 low = light * 12.92, high = 1.055 * pow(max(light, 1e-6), vec3(1.0 / 2.4)) - 0.055;
  pixel = vec4(mix(high, low, lessThan(light, vec3(0.0031308))), 1);
}`;

function programOf(gl) {
  const program = gl.createProgram();
  for (const [type, source] of [[gl.VERTEX_SHADER, vertexSource], [gl.FRAGMENT_SHADER, fragmentSource]]) {
    const shader = gl.createShader(type);
    gl.shaderSource(shader, source);
    gl.compileShader(shader);
    gl.attachShader(program, shader);
  }
  gl.linkProgram(program);
  if (!gl.getProgramParameter(program, gl.LINK_STATUS)) {
    throw new Error([gl.getProgramInfoLog(program), ...gl.getAttachedShaders(program).map(s => gl.getShaderInfoLog(s))].join('\n'));
  }
  return program;
}

function loadChain(gl) {
  gl.activeTexture(gl.TEXTURE0);
  gl.bindTexture(gl.TEXTURE_CUBE_MAP, gl.createTexture());
  data.levels.forEach(({ width, faces }, level) => {
    const texels = new Uint32Array(bytesOf(faces).buffer), count = width * width;
    for (let face = 0; face < 6; ++face) {
      gl.texImage2D(gl.TEXTURE_CUBE_MAP_POSITIVE_X + face, level, gl.RGB9_E5, width, width, 0, gl.RGB, gl.UNSIGNED_INT_5_9_9_9_REV,
        texels.subarray(face * count, (face + 1) * count));
    }
  });
  gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MIN_FILTER, gl.LINEAR_MIPMAP_LINEAR);
  gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MAG_FILTER, gl.LINEAR);
  gl.texParameteri(gl.TEXTURE_CUBE_MAP, gl.TEXTURE_MAX_LEVEL, data.levels.length - 1);
}

function loadTable(gl) {
  const values = new Float32Array(bytesOf(data.table).buffer), side = Math.sqrt(values.length / 2);
  gl.activeTexture(gl.TEXTURE1);
  gl.bindTexture(gl.TEXTURE_2D, gl.createTexture());
  gl.texImage2D(gl.TEXTURE_2D, 0, gl.RG16F, side, side, 0, gl.RG, gl.FLOAT, values);
  for (const name of [gl.TEXTURE_MIN_FILTER, gl.TEXTURE_MAG_FILTER]) gl.texParameteri(gl.TEXTURE_2D, name, gl.LINEAR);
  for (const name of [gl.TEXTURE_WRAP_S, gl.TEXTURE_WRAP_T]) gl.texParameteri(gl.TEXTURE_2D, name, gl.CLAMP_TO_EDGE);
}

// The level, between two, that is filtered for a roughness.
function levelOf(roughness) {
  const all = data.roughness;
  if (roughness <= all[0]) return 0;
  const above = all.findIndex(r => r >= roughness);
  if (above < 0) return all.length - 1;
  return above - 1 + (roughness - all[above - 1]) / (all[above] - all[above - 1]);
}

// What each screen column, row and depth is in the world, column by column.
function cameraOf(yaw, pitch) {
  const [sy, cy, sp, cp] = [Math.sin(yaw), Math.cos(yaw), Math.sin(pitch), Math.cos(pitch)];
  return [-cy, 0, sy, -sy * sp, cp, -cy * sp, sy * cp, sp, cy * cp];
}

function start() {
  const canvas = element('canvas');
  const gl = canvas.getContext('webgl2', { antialias: false, preserveDrawingBuffer: true });
  if (!gl) return;
  const program = programOf(gl);
  gl.useProgram(program);
  loadChain(gl);
  loadTable(gl);
  const at = name => gl.getUniformLocation(program, name);
  gl.uniform1i(at('chain'), 0);
  gl.uniform1i(at('table'), 1);
  gl.uniformMatrix3fv(at('world'), true, data.world);
  gl.uniform3fv(at('harmonics'), data.harmonics);

  const view = { yaw: 0.35, pitch: -0.05, field: 0.42, waiting: false };
  const linear = hex => [1, 3, 5].map(i => parseInt(hex.slice(i, i + 2), 16) / 255).map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);

  function draw() {
    view.waiting = false;
    const scale = Math.min(window.devicePixelRatio || 1, 2);
    canvas.width = Math.max(1, Math.round(canvas.clientWidth * scale));
    canvas.height = Math.max(1, Math.round(canvas.clientHeight * scale));
    gl.viewport(0, 0, canvas.width, canvas.height);
    const roughness = +element('roughness').value, stops = +element('exposure').value;
    element('roughness-value').value = roughness.toFixed(2);
    element('exposure-value').value = stops.toFixed(1);
    gl.uniform2f(at('size'), canvas.width, canvas.height);
    gl.uniform1f(at('field'), view.field);
    gl.uniform1f(at('away'), 4);
    gl.uniform1f(at('level'), levelOf(roughness));
    gl.uniform1f(at('backgroundLevel'), levelOf(+element('blur').value));
    gl.uniform1f(at('roughness'), roughness);
    gl.uniform1f(at('metal'), element('metal').checked ? 1 : 0);
    gl.uniform1f(at('factor'), data.exposure * 2 ** stops);
    gl.uniform3fv(at('colour'), linear(element('colour').value));
    gl.uniformMatrix3fv(at('camera'), false, cameraOf(view.yaw, view.pitch));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  function redraw() {
    if (!view.waiting) requestAnimationFrame(draw);
    view.waiting = true;
  }
  function turn(yaw, pitch) {
    view.yaw += yaw;
    view.pitch = Math.max(-1.55, Math.min(1.55, view.pitch + pitch));
    redraw();
  }

  for (const input of document.querySelectorAll('.controls input')) input.addEventListener('input', redraw);
  canvas.addEventListener('pointerdown', event => canvas.setPointerCapture(event.pointerId));
  canvas.addEventListener('pointermove', event => {
    if (event.buttons) turn(event.movementX * 0.006, event.movementY * 0.006);
  });
  canvas.addEventListener('wheel', event => {
    event.preventDefault();
    view.field = Math.max(0.15, Math.min(1.5, view.field * Math.exp(event.deltaY * 0.001)));
    redraw();
  }, { passive: false });
  canvas.addEventListener('keydown', event => {
    const step = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] }[event.key];
    if (!step) return;
    event.preventDefault();
    turn(...step);
  });
  addEventListener('resize', redraw);
  element('viewer').hidden = false;
  draw();
}

start();
