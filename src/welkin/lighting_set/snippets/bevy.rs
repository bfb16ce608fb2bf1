commands.spawn((Camera3d::default(), EnvironmentMapLight {
    diffuse_map: assets.load("diffuse.ktx2"),
    specular_map: assets.load("specular.ktx2"),
    intensity: 1000.0,
    ..default()
}));
