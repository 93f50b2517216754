// SPDX-License-Identifier: MIT
//
// shadowmath as a shadow camera set-up of OGRE 1.12 and later: the one file to copy into a project.
//
//     auto setup = std::make_shared<ShadowmathCameraSetup>(options);         // shadowmath::CascadeOptions<float>
//     scene_manager->setShadowTextureCountPerLightType(Ogre::Light::LT_DIRECTIONAL, options.count);
//     scene_manager->setShadowCameraSetup(setup);
//
// In place of PSSMShadowCameraSetup. Materials stay as they are: `texture_viewproj_matrix` gives the matrices,
// `split_ends` what an integrated PSSM material calls its split points. Spot lights are served too, with one map.
//
// OGRE asks for one shadow camera after the other; all are fitted when it asks for the first. What it hands over is in
// the convention of OpenGL, whatever it renders with, and so must be what it gets: CascadeOptions::clip stays gl_clip.
#pragma once

#include <shadowmath/cascades.hpp>
#include <shadowmath/vdsm.hpp>

#include <OgreCamera.h>
#include <OgreLight.h>
#include <OgreSceneManager.h>
#include <OgreSceneNode.h>
#include <OgreShadowCameraSetup.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>

namespace from_ogre {

inline glm::vec3 point(Ogre::Vector3 const& v) {
    return {v.x, v.y, v.z};
}

// Empty where OGRE's is; its infinite box is one that reaches as far as floats do.
inline shadowmath::Aabb<float> box(Ogre::AxisAlignedBox const& from) {
    if (from.isNull()) return {};
    if (from.isInfinite()) return {glm::vec3(-1e18f), glm::vec3(1e18f)};
    return {point(from.getMinimum()), point(from.getMaximum())};
}

// OGRE writes its matrices by rows.
inline glm::mat4 matrix(Ogre::Matrix4 const& from) {
    glm::mat4 to;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) to[column][row] = from[std::size_t(row)][std::size_t(column)];
    return to;
}

// Sides come from the projection matrix, so a camera off its centre, jittered or orthographic is right too.
inline shadowmath::ViewVolume<float> view(Ogre::Camera const& camera) {
    shadowmath::Pose<float> const pose{point(camera.getDerivedPosition()), point(camera.getDerivedRight()),
                                       point(camera.getDerivedUp()), point(camera.getDerivedDirection())};
    float const far_distance = camera.getFarClipDistance();  // OGRE's 0 is no end
    return shadowmath::view_from_projection(
        pose, matrix(camera.getProjectionMatrix()), camera.getNearClipDistance(),
        far_distance > 0.0f ? far_distance : std::numeric_limits<float>::infinity());
}

inline shadowmath::Light<float> light(Ogre::Light const& from) {
    if (from.getType() == Ogre::Light::LT_DIRECTIONAL)
        return shadowmath::directional(point(from.getDerivedDirection()));
    return shadowmath::spot(point(from.getDerivedPosition()), point(from.getDerivedDirection()),
                            0.5f * from.getSpotlightOuterAngle().valueRadians(), from.getAttenuationRange());
}

struct Bounds {
    shadowmath::Aabb<float> casters, receivers;
};

// Of all below a node, in view or not: what the eye does not see may shadow what it does. (The node's own box is of no
// use: cameras hang in the scene too, and theirs are as large as what they see. Nor is the box that OGRE keeps of what
// is visible: when shadow cameras are aimed it is that of the last frame.)
inline void add(Bounds& bounds, Ogre::SceneNode const& node) {
    constexpr auto no_bodies = Ogre::SceneManager::FRUSTUM_TYPE_MASK | Ogre::SceneManager::LIGHT_TYPE_MASK;
    for (Ogre::MovableObject const* object : node.getAttachedObjects()) {
        if (!object->isVisible() || (object->getTypeFlags() & no_bodies) != 0) continue;
        auto const body = box(object->getWorldBoundingBox());
        if (object->getCastShadows()) bounds.casters = shadowmath::merge(bounds.casters, body);
        bounds.receivers = shadowmath::merge(bounds.receivers, body);
    }
    for (Ogre::Node const* child : node.getChildren()) add(bounds, static_cast<Ogre::SceneNode const&>(*child));
}

inline Bounds bounds(Ogre::SceneManager const& scene) {
    Bounds all;
    add(all, *const_cast<Ogre::SceneManager&>(scene).getRootSceneNode());
    return all;
}

}  // namespace from_ogre

namespace to_ogre {

inline Ogre::Matrix4 matrix(glm::mat4 const& from) {
    Ogre::Matrix4 to;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) to[std::size_t(row)][std::size_t(column)] = from[column][row];
    return to;
}

// The whole matrix as a projection: OGRE multiplies it with the view's, and culls casters by the product. It inverts it
// too, so a map that is not visible becomes a matrix that has an inverse, and looks at nothing, far from everything.
inline void aim(Ogre::Camera& shadow_camera, shadowmath::ShadowMap<float> const& map) {
    Ogre::Matrix4 const elsewhere(Ogre::Affine3::getTrans(1e7f, 0.0f, 0.0f));
    shadow_camera.setCustomViewMatrix(true, Ogre::Affine3::IDENTITY);
    shadow_camera.setCustomProjectionMatrix(true, map.visible ? matrix(map.clip_from_world) : elsewhere);
}

}  // namespace to_ogre

class ShadowmathCameraSetup : public Ogre::ShadowCameraSetup {
public:
    // count and map_size as the scene manager has them; a shadow distance of 0 is OGRE's own shadow far distance.
    explicit ShadowmathCameraSetup(shadowmath::CascadeOptions<float> const& options) : options_(options) {}

    // Of the last frame: eye depths at which the splits end, for the material. Those beyond the count repeat the last.
    [[nodiscard]] Ogre::Vector4 split_ends() const {
        std::array<float, 4> ends{};
        for (int i = 0; i < 4 && cascades_.count > 0; ++i)
            ends[std::size_t(i)] = cascades_.at[std::min(i, cascades_.count - 1)].range.end;
        return {ends[0], ends[1], ends[2], ends[3]};
    }

    // Of the last frame: matrices, ranges, texel sizes, and what the library found wrong with its inputs.
    [[nodiscard]] shadowmath::Cascades<float> const& cascades() const { return cascades_; }

    void getShadowCamera(Ogre::SceneManager const* scene, Ogre::Camera const* camera, Ogre::Viewport const*,
                         Ogre::Light const* light, Ogre::Camera* shadow_camera, std::size_t iteration) const override {
        if (iteration == 0) fit(*scene, *camera, *light);
        shadowmath::ShadowMap<float> map;
        if (int(iteration) < cascades_.count) map = cascades_.at[iteration].map;
        to_ogre::aim(*shadow_camera, map);
    }

private:
    void fit(Ogre::SceneManager const& scene, Ogre::Camera const& camera, Ogre::Light const& light) const {
        shadowmath::CascadeOptions<float> options = options_;
        if (options.shadow_distance == 0.0f) options.shadow_distance = light.getShadowFarDistance();
        if (light.getType() != Ogre::Light::LT_DIRECTIONAL) options.count = 1;
        from_ogre::Bounds const bounds = from_ogre::bounds(scene);
        shadowmath::Cascades<float> const last = cascades_;
        cascades_ = shadowmath::fit_cascades(from_ogre::view(camera), from_ogre::light(light), bounds.casters,
                                             bounds.receivers, options, &last);
    }

    shadowmath::CascadeOptions<float> options_;
    mutable shadowmath::Cascades<float> cascades_;
};

// In place of PlaneOptimalShadowCameraSetup: texels as the eye sees them, on one plane. The first map is exact there;
// a second one, if the scene manager has two a light, is fitted to all in view, for what the first does not hold.
class ShadowmathPlaneSetup : public Ogre::ShadowCameraSetup {
public:
    ShadowmathPlaneSetup(Ogre::Plane const& plane, int map_size)
        : plane_{from_ogre::point(plane.normal), plane.d}, map_size_(map_size) {}

    void getShadowCamera(Ogre::SceneManager const* scene, Ogre::Camera const* camera, Ogre::Viewport const*,
                         Ogre::Light const* light, Ogre::Camera* shadow_camera, std::size_t iteration) const override {
        shadowmath::ViewVolume<float> view = from_ogre::view(*camera);
        if (light->getShadowFarDistance() > 0.0f) view.z_far = light->getShadowFarDistance();
        from_ogre::Bounds const bounds = from_ogre::bounds(*scene);
        auto const source = from_ogre::light(*light);
        if (iteration == 0) {
            shadowmath::VdsmOptions<float> options;
            options.map_size = map_size_;
            auto const map = shadowmath::view_dependent_map(view, source, plane_, bounds.casters, bounds.receivers,
                                                            options, shadowmath::gl_clip);
            to_ogre::aim(*shadow_camera, map);
        } else {
            shadowmath::CascadeOptions<float> options;
            options.count = 1;
            options.map_size = map_size_;
            options.fit = shadowmath::CascadeFit::focus;
            auto const fitted = shadowmath::fit_cascades(view, source, bounds.casters, bounds.receivers, options);
            to_ogre::aim(*shadow_camera, fitted.at[0].map);
        }
    }

private:
    shadowmath::ShadowPlane<float> plane_;
    int map_size_;
};
