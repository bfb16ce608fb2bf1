import { EYE_DISTANCE, FIELD_OF_VIEW, ballMesh, cameraAxes, upright } from "/pages/balls.js";
import { MATERIALS, glb } from "/pages/glb.js";

// Filament renders into a texture of floats, which its interface cannot read: WebGL, under it, tells which one that is, and reads it.
function watchFloatTexture(gl) {
  gl.getExtension("EXT_color_buffer_float");
  const seen = {}, allocate = gl.texStorage2D;
  gl.texStorage2D = function (target, levels, format, ...size) {
    if (format === gl.RGBA32F) seen.texture = gl.getParameter(gl.TEXTURE_BINDING_2D);
    allocate.call(gl, target, levels, format, ...size);
  };
  return seen;
}

function readTexture(gl, texture, size) {
  const before = gl.getParameter(gl.READ_FRAMEBUFFER_BINDING), frame = gl.createFramebuffer();
  const pixels = new Float32Array(size * size * 4);
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, frame);
  gl.framebufferTexture2D(gl.READ_FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, texture, 0);
  gl.readPixels(0, 0, size, size, gl.RGBA, gl.FLOAT, pixels);
  gl.bindFramebuffer(gl.READ_FRAMEBUFFER, before);
  gl.deleteFramebuffer(frame);
  return pixels;
}

export async function draw({ size, views, maps, loadLight, show }) {
  await new Promise((resolve) => Filament.init([], resolve));
  const canvas = document.createElement("canvas");
  canvas.width = canvas.height = size;
  const seen = watchFloatTexture(canvas.getContext("webgl2", { majorVersion: 2, minorVersion: 0, antialias: false, depth: true, alpha: false }));
  const engine = Filament.Engine.create(canvas), gl = engine.context;
  const scene = engine.createScene(), chain = engine.createSwapChain(), renderer = engine.createRenderer(), view = engine.createView();
  const camera = engine.createCamera(Filament.EntityManager.get().create());
  const color = Filament.Texture.Builder().width(size).height(size).levels(1).sampler(Filament.Texture$Sampler.SAMPLER_2D)
    .format(Filament.Texture$InternalFormat.RGBA32F)
    .usage(Filament.Texture$Usage.COLOR_ATTACHMENT.value | Filament.Texture$Usage.SAMPLEABLE.value).build(engine);
  view.setRenderTarget(Filament.RenderTarget.Builder().texture(Filament.RenderTarget$AttachmentPoint.COLOR, color).build(engine));
  view.setViewport([0, 0, size, size]);
  view.setScene(scene);
  view.setCamera(camera);
  view.setPostProcessingEnabled(false);
  camera.setProjectionFov((FIELD_OF_VIEW * 180) / Math.PI, 1, 1, 2 * EYE_DISTANCE, Filament.Camera$Fov.VERTICAL);
  camera.setExposure(1, 1.2, 100);  // 1 cd/m² becomes 1

  for (const map of maps) {
    await loadLight({ engine, scene, folder: `/set/${map}` });
    scene.setSkybox(null);  // the texture has no depth: the sky would lie over the balls
    for (const [number, toward] of views.entries()) {
      const mesh = ballMesh(size, toward);
      camera.lookAt(cameraAxes(toward).eye, [0, 0, 0], [0, 1, 0]);
      for (const [ball, material] of Object.entries(MATERIALS)) {
        const loader = engine.createAssetLoader(), asset = loader.createAsset(glb(mesh, material));
        await new Promise((resolve) => asset.loadResources(resolve));
        scene.addEntities(asset.getRenderableEntities());
        // Materials are compiled, and textures filled, in the frames before.
        for (let frame = 0; frame < 3; ++frame) {
          renderer.render(chain, view);
          engine.execute();
          await new Promise(requestAnimationFrame);
        }
        const pixels = readTexture(gl, seen.texture, size);
        for (const entity of asset.getRenderableEntities()) scene.remove(entity);
        await show(`${map}-${ball}-${number}`, upright(pixels, size));
      }
    }
  }
}
