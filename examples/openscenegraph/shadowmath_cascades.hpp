// SPDX-License-Identifier: MIT
//
// shadowmath as a shadow technique of OpenSceneGraph 3.6: the one file to copy into a project.
//
//     osg::ref_ptr<ShadowmathCascades> cascades = new ShadowmathCascades(options);  // CascadeOptions<double>
//     osg::ref_ptr<osgShadow::ShadowedScene> scene = new osgShadow::ShadowedScene(cascades.get());
//
// Each map is a depth texture with comparison on, and a texgen in eye space, on texture units from base_unit on, as the
// techniques of osgShadow leave theirs: a shader that reads those reads these. split_ends() is a uniform of the depths
// at which the splits end. One view; one light, sun or spot: the first that is found. In double, as OpenSceneGraph is.
#pragma once

#include <shadowmath/cascades.hpp>

#include <glm/gtc/type_ptr.hpp>

#include <osg/Camera>
#include <osg/ComputeBoundsVisitor>
#include <osg/Light>
#include <osg/PolygonOffset>
#include <osg/TexGen>
#include <osg/Texture2D>
#include <osgShadow/ShadowTechnique>
#include <osgShadow/ShadowedScene>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderStage>

#include <algorithm>
#include <vector>

// Vectors are rows to OpenSceneGraph, columns to GLM: in memory their matrices are the same sixteen numbers.
namespace from_osg {

inline glm::dvec3 point(osg::Vec3d const& v) {
    return {v.x(), v.y(), v.z()};
}

inline glm::dmat4 matrix(osg::Matrixd const& from) {
    return glm::make_mat4(from.ptr());
}

// The sides come from the projection, so a camera off its centre is right too; so does the near distance, as was set.
inline shadowmath::ViewVolume<double> view(osg::Matrixd const& eye_from_world, osg::Matrixd const& projection) {
    glm::dmat4 const at = matrix(osg::Matrixd::inverse(eye_from_world));
    shadowmath::Pose<double> const pose{glm::dvec3(at[3]), glm::dvec3(at[0]), glm::dvec3(at[1]), -glm::dvec3(at[2])};
    double left, right, bottom, top, z_near = 0.0, z_far = 0.0;
    if (!projection.getFrustum(left, right, bottom, top, z_near, z_far))
        projection.getOrtho(left, right, bottom, top, z_near, z_far);
    return shadowmath::view_from_projection(pose, matrix(projection), z_near, z_far);
}

// The first light of those that the traversal has met, in world space; none: one without direction, which has no map.
inline shadowmath::Light<double> light(osgUtil::CullVisitor& cull, osg::Matrixd const& eye_from_world) {
    glm::dmat4 const world_from_eye = matrix(osg::Matrixd::inverse(eye_from_world));
    auto const& met = cull.getCurrentRenderBin()->getStage()->getPositionalStateContainer()->getAttrMatrixList();
    for (auto const& [attribute, eye_from_local] : met) {
        auto const* const from = dynamic_cast<osg::Light const*>(attribute.get());
        if (from == nullptr) continue;
        glm::dmat4 const world_from_local = eye_from_local ? world_from_eye * matrix(*eye_from_local) : world_from_eye;
        osg::Vec4d const position = from->getPosition();
        glm::dvec4 const at = world_from_local * glm::dvec4(position.x(), position.y(), position.z(), position.w());
        if (at.w == 0.0) return shadowmath::directional(-glm::dvec3(at));
        glm::dvec3 const axis = glm::dmat3(world_from_local) * point(from->getDirection());
        double const half_angle = osg::DegreesToRadians(double(from->getSpotCutoff()));
        return shadowmath::spot(glm::dvec3(at) / at.w, axis, half_angle, 1e4);
    }
    return shadowmath::directional(glm::dvec3(0.0));
}

// Of all that the mask lets through, in view or not: what the eye does not see may shadow what it does.
inline shadowmath::Aabb<double> bounds(osg::Group& scene, osg::Node::NodeMask mask) {
    osg::ComputeBoundsVisitor visitor;
    visitor.setTraversalMask(mask);
    scene.accept(visitor);
    osg::BoundingBox const& box = visitor.getBoundingBox();
    if (!box.valid()) return {};
    return {glm::dvec3(box.xMin(), box.yMin(), box.zMin()), glm::dvec3(box.xMax(), box.yMax(), box.zMax())};
}

}  // namespace from_osg

class ShadowmathCascades : public osgShadow::ShadowTechnique {
public:
    explicit ShadowmathCascades(shadowmath::CascadeOptions<double> const& options, unsigned base_unit = 1)
        : options_(options), base_unit_(base_unit), split_ends_(new osg::Uniform("split_ends", osg::Vec4f())),
          offset_(new osg::PolygonOffset(1.1f, 4.0f)) {
        options_.count = std::clamp(options.count, 1, shadowmath::max_splits);
    }

    [[nodiscard]] shadowmath::Cascades<double> const& cascades() const { return cascades_; }  // of the last frame
    [[nodiscard]] osg::PolygonOffset& polygon_offset() { return *offset_; }                   // of the casters
    [[nodiscard]] osg::Uniform& split_ends() { return *split_ends_; }  // four; those beyond the count repeat the last

    // Again after dirty(), which a scene that grew or shrank must call.
    void init() override {
        auto const* const settings = _shadowedScene->getShadowSettings();
        casters_ = from_osg::bounds(*_shadowedScene, settings->getCastsShadowTraversalMask());
        receivers_ = from_osg::bounds(*_shadowedScene, settings->getReceivesShadowTraversalMask());
        if (maps_.empty()) {
            receiving_ = new osg::StateSet;
            receiving_->addUniform(split_ends_);
            casting_ = new osg::StateSet;
            casting_->setAttributeAndModes(offset_, osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE);
            for (int i = 0; i < options_.count; ++i) add_map(base_unit_ + unsigned(i));
        }
        _dirty = false;
    }

    osg::Object* cloneType() const override { return new ShadowmathCascades(options_, base_unit_); }
    osg::Object* clone(osg::CopyOp const&) const override { return cloneType(); }
    void update(osg::NodeVisitor& visitor) override { _shadowedScene->osg::Group::traverse(visitor); }

    // The eye's traversal comes first: it meets the light.
    void cull(osgUtil::CullVisitor& cull) override {
        osg::Matrixd const eye_from_world = *cull.getModelViewMatrix();
        auto const* const settings = _shadowedScene->getShadowSettings();
        auto const mask = cull.getTraversalMask();
        cull.setTraversalMask(mask & settings->getReceivesShadowTraversalMask());
        cull.pushStateSet(receiving_.get());
        _shadowedScene->osg::Group::traverse(cull);
        cull.popStateSet();

        auto const light = from_osg::light(cull, eye_from_world);
        auto const view = from_osg::view(eye_from_world, *cull.getProjectionMatrix());
        shadowmath::Cascades<double> const last = cascades_;
        cascades_ = shadowmath::fit_cascades(view, light, casters_, receivers_, options_, &last);
        osg::Vec4f ends;
        for (int i = 0; i < 4 && cascades_.count > 0; ++i)
            ends[unsigned(i)] = float(cascades_.at[std::min(i, cascades_.count - 1)].range.end);
        split_ends_->set(ends);

        cull.setTraversalMask(mask & settings->getCastsShadowTraversalMask());
        cull.pushStateSet(casting_.get());
        for (int i = 0; i < options_.count; ++i)  // beyond the count of cascades stand maps that see nothing
            draw(maps_[std::size_t(i)], cascades_.at[i].map, base_unit_ + unsigned(i), cull, eye_from_world);
        cull.popStateSet();
        cull.setTraversalMask(mask);
    }

    void resizeGLObjectBuffers(unsigned size) override {
        for (Map& map : maps_) map.camera->resizeGLObjectBuffers(size), map.texture->resizeGLObjectBuffers(size);
    }
    void releaseGLObjects(osg::State* state = nullptr) const override {
        for (Map const& map : maps_) map.camera->releaseGLObjects(state), map.texture->releaseGLObjects(state);
    }

private:
    struct Map {
        osg::ref_ptr<osg::Camera> camera;
        osg::ref_ptr<osg::Texture2D> texture;
        osg::ref_ptr<osg::TexGen> texgen;
    };

    void add_map(unsigned unit) {
        Map map{new osg::Camera, new osg::Texture2D, new osg::TexGen};
        int const size = options_.map_size;
        map.texture->setTextureSize(size, size);
        map.texture->setInternalFormat(GL_DEPTH_COMPONENT24);
        map.texture->setSourceFormat(GL_DEPTH_COMPONENT);
        map.texture->setShadowComparison(true);
        for (auto const side : {osg::Texture::WRAP_S, osg::Texture::WRAP_T})
            map.texture->setWrap(side, osg::Texture::CLAMP_TO_BORDER);
        map.texture->setBorderColor(osg::Vec4d(1.0, 1.0, 1.0, 1.0));  // lit
        map.texgen->setMode(osg::TexGen::EYE_LINEAR);
        map.camera->setReferenceFrame(osg::Camera::ABSOLUTE_RF_INHERIT_VIEWPOINT);
        map.camera->setRenderOrder(osg::Camera::PRE_RENDER);
        map.camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
        map.camera->attach(osg::Camera::DEPTH_BUFFER, map.texture.get());
        map.camera->setViewport(0, 0, size, size);
        map.camera->setClearMask(GL_DEPTH_BUFFER_BIT);
        map.camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
        map.camera->setCullingMode(osg::CullSettings::VIEW_FRUSTUM_CULLING);
        map.camera->setCullCallback(new CameraCullCallback(this));
        receiving_->setTextureAttributeAndModes(unit, map.texture);
        for (int const mode : {GL_TEXTURE_GEN_S, GL_TEXTURE_GEN_T, GL_TEXTURE_GEN_R, GL_TEXTURE_GEN_Q})
            receiving_->setTextureMode(unit, GLenum(mode), osg::StateAttribute::ON);
        maps_.push_back(map);
    }

    // The whole matrix is the projection: OpenSceneGraph culls casters by its inverse.
    void draw(Map& target, shadowmath::ShadowMap<double> const& map, unsigned unit, osgUtil::CullVisitor& cull,
              osg::Matrixd const& eye_from_world) {
        target.camera->setProjectionMatrix(osg::Matrixd(&map.clip_from_world[0][0]));
        target.camera->accept(cull);
        glm::dmat4 const texture_from_world = shadowmath::texture_from_world(map);
        target.texgen->setPlanesFromMatrix(osg::Matrixd(&texture_from_world[0][0]));
        cull.getCurrentRenderBin()->getStage()->addPositionedTextureAttribute(unit, new osg::RefMatrix(eye_from_world),
                                                                              target.texgen.get());
    }

    shadowmath::CascadeOptions<double> options_;
    unsigned base_unit_;
    osg::ref_ptr<osg::Uniform> split_ends_;
    osg::ref_ptr<osg::PolygonOffset> offset_;
    osg::ref_ptr<osg::StateSet> receiving_, casting_;
    std::vector<Map> maps_;
    shadowmath::Aabb<double> casters_, receivers_;
    shadowmath::Cascades<double> cascades_;
};
