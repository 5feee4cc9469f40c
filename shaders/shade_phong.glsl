// ang_phong of core/scene/scene.h: headlight, two-sided, weighted by the gradient's length.
uniform float phong_ambient;
uniform float phong_diffuse;
uniform float phong_specular;
uniform float phong_power;
uniform float phong_g0; // HU/mm

// `along_mm` leads along the ray, of any length; where `wanted` is false nobody looks at the result.
vec3 shade(vec3 colour, vec3 place, vec3 along_mm, bool wanted) {
    vec3 gradient = gradient_at(place, wanted);
    float squared = dot(gradient, gradient);
    if (!(squared > 0.0)) return colour;
    float facing = min(abs(dot(gradient, along_mm)) * inversesqrt(squared * dot(along_mm, along_mm)), 1.0);
    // pow(0, y) is log of nothing on some drivers.
    float highlight = facing > 0.0 ? pow(facing, phong_power) : (phong_power > 0.0 ? 0.0 : 1.0);
    vec3 shaded = colour * (phong_ambient + phong_diffuse * facing) + phong_specular * highlight;
    return mix(colour, shaded, squared / (squared + phong_g0 * phong_g0));
}
