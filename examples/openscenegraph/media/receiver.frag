#version 130
// SPDX-License-Identifier: MIT
//
// One receiver for every technique, so that pictures differ by the maps alone: each leaves comparing depth textures on
// the units from 1 on, and texgen planes in eye space that lead into them. The filter is nine texels, each lit or not,
// and each compared with the depth that the surface's own plane has there (Isidoro 2006); what no map holds is lit.
in vec4 point;  // eye space
in vec3 shading_normal;
in vec3 reflectance;

uniform sampler2DShadow map0;
uniform sampler2DShadow map1;
uniform sampler2DShadow map2;
uniform sampler2DShadow map3;
uniform vec4 split_ends;  // eye depths; of shadowmath's techniques
uniform float zShadow0;   // NDC depths; of ParallelSplitShadowMap
uniform float zShadow1;
uniform float zShadow2;
uniform float zShadow3;
uniform int map_count;
uniform int by_depth;  // 0: the first map that holds the point; 1: the map of the split that it is in, by split_ends;
                       // 2: by zShadow; of one map, that one
uniform mat4 world_from_eye;

struct Place {
    vec3 at;        // in the map: u, v and depth, 0 to 1 inside
    vec2 gradient;  // of depth along u and v, on the surface's own plane
    bool ahead;     // w > 0
};

Place place_in(int unit, vec3 normal) {
    mat4 map_from_eye =
        transpose(mat4(gl_EyePlaneS[unit], gl_EyePlaneT[unit], gl_EyePlaneR[unit], gl_EyePlaneQ[unit]));
    vec4 p = map_from_eye * point;
    vec3 along = normalize(cross(normal, abs(normal.x) > 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec4 da = map_from_eye * vec4(along, 0.0), db = map_from_eye * vec4(cross(normal, along), 0.0);
    vec3 a = da.xyz * p.w - p.xyz * da.w, b = db.xyz * p.w - p.xyz * db.w;  // times w * w
    float area = a.x * b.y - a.y * b.x;
    vec2 gradient = vec2(a.z * b.y - a.y * b.z, a.x * b.z - a.z * b.x) / area;
    if (!(abs(gradient.x) + abs(gradient.y) < 1e4)) gradient = vec2(0.0);  // the light grazes the surface
    return Place(p.xyz / p.w, gradient, p.w > 0.0);
}

float visibility_in(sampler2DShadow map, Place place) {
    vec2 size = vec2(textureSize(map, 0));
    ivec2 texel = ivec2(floor(place.at.xy * size));
    float lit = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 tap = texel + ivec2(x, y);
            vec2 centre = (vec2(tap) + 0.5) / size;
            bool outside = any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(size)));
            float depth = clamp(place.at.z + dot(place.gradient, centre - place.at.xy), 0.0, 1.0);
            lit += outside ? 1.0 : step(0.5, textureLod(map, vec3(centre, depth), 0.0));
        }
    return lit / 9.0;
}

bool holds(Place place, vec2 size) {
    vec3 at = place.at;
    vec2 margin = 2.0 / size;
    return place.ahead && all(greaterThan(at.xy, margin)) && all(lessThan(at.xy, 1.0 - margin)) && at.z >= 0.0 &&
           at.z <= 1.0;
}

float visibility(vec3 normal) {
    Place places[4] = Place[](place_in(1, normal), place_in(2, normal), place_in(3, normal), place_in(4, normal));
    float z[4] = float[](zShadow0, zShadow1, zShadow2, zShadow3);
    vec2 size = vec2(textureSize(map0, 0));
    int chosen = map_count;
    for (int map = map_count - 1; map >= 0; --map) {
        bool serves = holds(places[map], size);
        if (by_depth == 1) serves = -point.z <= split_ends[map];
        if (by_depth == 2) serves = 2.0 * gl_FragCoord.z - 1.0 <= z[map];
        if (serves || (map_count == 1)) chosen = map;
    }
    if (chosen >= map_count || !places[chosen].ahead) return 1.0;
    if (chosen == 0) return visibility_in(map0, places[0]);
    if (chosen == 1) return visibility_in(map1, places[1]);
    if (chosen == 2) return visibility_in(map2, places[2]);
    return visibility_in(map3, places[3]);
}

vec3 encoded(vec3 linear) {
    return mix(linear * 12.92, 1.055 * pow(linear, vec3(1.0 / 2.4)) - 0.055, step(0.0031308, linear));
}

void main() {
    vec3 to_eye = normalize(-point.xyz);
    vec3 plane_normal = normalize(cross(dFdx(point.xyz), dFdy(point.xyz)));
    if (dot(plane_normal, to_eye) < 0.0) plane_normal = -plane_normal;
    vec3 normal = normalize(shading_normal);
    if (dot(normal, plane_normal) < 0.0) normal = -normal;  // the back of an open mesh
    vec3 to_light = normalize(gl_LightSource[0].position.xyz);
    float diffuse = max(dot(normal, to_light), 0.0);
    float specular = diffuse > 0.0 ? 0.15 * pow(max(dot(normal, normalize(to_light + to_eye)), 0.0), 24.0) : 0.0;
    float seen = visibility(plane_normal);
    vec3 direct = vec3(1.0, 0.95, 0.85) * ((diffuse + specular) * seen);
    gl_FragData[0] = vec4(encoded(min((vec3(0.30, 0.34, 0.42) + direct) * reflectance, 1.0)), 1.0);
    gl_FragData[1] = vec4((world_from_eye * point).xyz, seen);  // for the judge
}
