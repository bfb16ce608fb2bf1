var sky := Sky.new()
sky.sky_material = PanoramaSkyMaterial.new()
sky.sky_material.panorama = load("res://panorama.exr")
$WorldEnvironment.environment.sky = sky
