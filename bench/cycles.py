"""A ball under a map by Cycles: blender -b --factory-startup -P cycles.py -- MAP OUT MATERIAL SIZE SAMPLES SEED

MAP is a lat-long in Blender's convention; MATERIAL diffuse, mirror, metal:ROUGHNESS or glass. The camera is where
`welkin render --position 0,0,-4 --look 0 --fov 29` has it. Nothing is clamped, denoised or filtered beyond the pixel.
"""
import sys

import bpy
from mathutils import Vector

map_file, out, material_name, size, samples, seed = sys.argv[sys.argv.index("--") + 1:]

bpy.ops.wm.read_factory_settings(use_empty=True)
scene = bpy.context.scene
bpy.ops.mesh.primitive_uv_sphere_add(segments=512, ring_count=256, radius=1)
ball = bpy.context.object
bpy.ops.object.shade_smooth()

material = bpy.data.materials.new("ball")
material.use_nodes = True
nodes, links = material.node_tree.nodes, material.node_tree.links
nodes.clear()
kind, _, roughness = material_name.partition(":")
node = nodes.new({"diffuse": "ShaderNodeBsdfDiffuse", "glass": "ShaderNodeBsdfGlass"}.get(kind, "ShaderNodeBsdfGlossy"))
node.inputs["Color"].default_value = (0.8, 0.8, 0.8, 1) if kind == "diffuse" else (1, 1, 1, 1)
if kind == "glass":
    node.inputs["IOR"].default_value = 1.5
if kind != "diffuse":
    node.inputs["Roughness"].default_value = float(roughness or 0)
    node.distribution = "MULTI_GGX" if roughness else "GGX"
surface = nodes.new("ShaderNodeOutputMaterial")
links.new(node.outputs["BSDF"], surface.inputs["Surface"])
ball.data.materials.append(material)

world = bpy.data.worlds.new("world")
scene.world = world
world.use_nodes = True
nodes, links = world.node_tree.nodes, world.node_tree.links
image = bpy.data.images.load(map_file)
image.colorspace_settings.name = "Linear"
environment = nodes.new("ShaderNodeTexEnvironment")
environment.image = image
links.new(environment.outputs["Color"], nodes["Background"].inputs["Color"])
world.cycles.sampling_method = "AUTOMATIC"

camera_data = bpy.data.cameras.new("camera")
camera_data.angle = 29 * 3.141592653589793 / 180
camera = bpy.data.objects.new("camera", camera_data)
scene.collection.objects.link(camera)
camera.location = (0, 4, 0)
camera.rotation_euler = Vector((0, -1, 0)).to_track_quat("-Z", "Y").to_euler()
scene.camera = camera

scene.render.engine = "CYCLES"
cycles = scene.cycles
cycles.device = "CPU"
cycles.samples = int(samples)
cycles.seed = int(seed)
cycles.use_adaptive_sampling = False
cycles.use_denoising = False
cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0
cycles.blur_glossy = 0
cycles.max_bounces = cycles.glossy_bounces = cycles.transmission_bounces = cycles.diffuse_bounces = 16
cycles.caustics_reflective = cycles.caustics_refractive = True
cycles.pixel_filter_type = "BOX"
cycles.filter_width = 1
scene.render.film_transparent = True
cycles.film_transparent_glass = False
scene.render.resolution_x = scene.render.resolution_y = int(size)
scene.render.resolution_percentage = 100
scene.view_settings.view_transform = "Raw"
scene.render.image_settings.file_format = "OPEN_EXR"
scene.render.image_settings.color_depth = "32"
scene.render.image_settings.color_mode = "RGBA"
scene.render.image_settings.exr_codec = "ZIP"
scene.render.filepath = out
bpy.ops.render.render(write_still=True)
