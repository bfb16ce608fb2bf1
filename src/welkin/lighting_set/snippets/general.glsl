// GLSL
vec3 diffuse = albedo * textureLod(diffuse_map, n, 0.0).rgb;
vec2 dfg = texture(dfg_table, vec2(dot(n, v), roughness)).rg;
vec3 specular = textureLod(specular_map, reflect(-v, n), roughness * (levels - 1.0)).rgb * (f0 * dfg.x + dfg.y);
