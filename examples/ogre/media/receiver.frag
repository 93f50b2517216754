#version 330 core
// SPDX-License-Identifier: MIT
//
// Shades as the gallery's receivers do. The filter is nine texels, each lit or not, and each compared with the depth
// that the surface's own plane has there (Isidoro 2006); what no map holds is lit.
in vec3 point;
in vec3 shading_normal;
in vec3 reflectance;
layout(location = 0) out vec4 picture;
layout(location = 1) out vec4 judged;  // the point, and how much of the light it sees

uniform mat4 map0_from_world;
uniform mat4 map1_from_world;
uniform mat4 map2_from_world;
uniform mat4 map3_from_world;
uniform mat4 eye_from_world;
uniform vec3 eye;
uniform vec3 light_travel;
uniform sampler2D map0;
uniform sampler2D map1;
uniform sampler2D map2;
uniform sampler2D map3;
uniform vec4 split_ends;  // eye depths
uniform int map_count;
uniform int by_depth;  // 1: the map of the split that the point is in; 0: the first map that holds it

struct Place {
    vec3 at;        // in the map: u, v and depth, 0 to 1 inside
    vec2 gradient;  // of depth along u and v, on the surface's own plane
    bool ahead;     // w > 0
};

Place place_in(mat4 map_from_world, vec3 normal) {
    vec4 p = map_from_world * vec4(point, 1.0);
    vec3 along = normalize(cross(normal, abs(normal.x) > 0.7 ? vec3(0.0, 1.0, 0.0) : vec3(1.0, 0.0, 0.0)));
    vec4 da = map_from_world * vec4(along, 0.0), db = map_from_world * vec4(cross(normal, along), 0.0);
    vec3 a = da.xyz * p.w - p.xyz * da.w, b = db.xyz * p.w - p.xyz * db.w;  // times w * w
    float area = a.x * b.y - a.y * b.x;
    vec2 gradient = vec2(a.z * b.y - a.y * b.z, a.x * b.z - a.z * b.x) / area;
    if (!(abs(gradient.x) + abs(gradient.y) < 1e4)) gradient = vec2(0.0);  // the light grazes the surface
    vec3 at = p.xyz / p.w;
    return Place(vec3(at.xy, 0.5 * at.z + 0.5), 0.5 * gradient, p.w > 0.0);
}

float visibility_in(sampler2D map, Place place) {
    vec2 size = vec2(textureSize(map, 0));
    ivec2 texel = ivec2(floor(place.at.xy * size));
    float lit = 0.0;
    for (int y = -1; y <= 1; ++y)
        for (int x = -1; x <= 1; ++x) {
            ivec2 tap = texel + ivec2(x, y);
            bool outside = any(lessThan(tap, ivec2(0))) || any(greaterThanEqual(tap, ivec2(size)));
            float depth = place.at.z + dot(place.gradient, (vec2(tap) + 0.5) / size - place.at.xy);
            lit += outside || min(depth, 1.0) <= texelFetch(map, tap, 0).r ? 1.0 : 0.0;
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
    Place places[4] = Place[](place_in(map0_from_world, normal), place_in(map1_from_world, normal),
                              place_in(map2_from_world, normal), place_in(map3_from_world, normal));
    float depth = -(eye_from_world * vec4(point, 1.0)).z;
    vec2 size = vec2(textureSize(map0, 0));
    int chosen = map_count;
    for (int map = map_count - 1; map >= 0; --map)
        if (by_depth == 1 ? depth <= split_ends[map] : holds(places[map], size)) chosen = map;
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
    vec3 to_eye = normalize(eye - point);
    vec3 plane_normal = normalize(cross(dFdx(point), dFdy(point)));
    if (dot(plane_normal, to_eye) < 0.0) plane_normal = -plane_normal;
    vec3 normal = normalize(shading_normal);
    if (dot(normal, plane_normal) < 0.0) normal = -normal;  // the back of an open mesh
    vec3 to_light = -normalize(light_travel);
    float diffuse = max(dot(normal, to_light), 0.0);
    float specular = diffuse > 0.0 ? 0.15 * pow(max(dot(normal, normalize(to_light + to_eye)), 0.0), 24.0) : 0.0;
    float seen = visibility(plane_normal);
    vec3 direct = vec3(1.0, 0.95, 0.85) * ((diffuse + specular) * seen);
    picture = vec4(encoded(min((vec3(0.30, 0.34, 0.42) + direct) * reflectance, 1.0)), 1.0);
    judged = vec4(point, seen);
}
