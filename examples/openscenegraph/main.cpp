// SPDX-License-Identifier: MIT
//
// The scenes in OpenSceneGraph, shadowed by osgShadow's techniques and by ours: scripts/engines osg. Nothing here needs
// to be copied; that is shadowmath_cascades.hpp.
#include "examples/engines/trial.hpp"
#include "examples/openscenegraph/shadowmath_cascades.hpp"

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/LightSource>
#include <osg/Version>
#include <osgDB/ReadFile>
#include <osgShadow/LightSpacePerspectiveShadowMap>
#include <osgShadow/MinimalShadowMap>
#include <osgShadow/ParallelSplitShadowMap>
#include <osgShadow/ShadowMap>
#include <osgShadow/ViewDependentShadowMap>
#include <osgUtil/SceneView>
#include <osgViewer/Viewer>

#include <cmath>

namespace shadowmath::engines {
namespace {

constexpr double lambda = 0.65;

osg::Vec3d to_osg(glm::dvec3 v) {
    return {v.x, v.y, v.z};
}

using TechniquePointer = osg::ref_ptr<osgShadow::ShadowTechnique>;

class OsgEngine : public Engine {
public:
    std::string name() const override { return std::string("OpenSceneGraph ") + osgGetVersion(); }

    std::vector<SetUp> set_ups() const override {
        return {{"pssm-by-depth", "ParallelSplitShadowMap, by depth", 4},
                {"pssm", "ParallelSplitShadowMap", 4},
                {"stable-by-depth", "shadowmath, stable cascades, by depth", 4, true, "pssm-by-depth"},
                {"stable", "shadowmath, stable cascades", 4, true, "pssm"},
                {"tight", "shadowmath, tight cascades", 4, true, "pssm"},
                {"vdsm-2", "ViewDependentShadowMap", 2},
                {"tight-2", "shadowmath, tight cascades", 2, true, "vdsm-2"},
                {"shadow-map", "ShadowMap", 1},
                {"minimal", "MinimalShadowMap", 1},
                {"minimal-cull", "MinimalCullBoundsShadowMap", 1},
                {"lispsm", "LightSpacePerspectiveShadowMapCB", 1},
                {"vdsm", "ViewDependentShadowMap", 1},
                {"focus", "shadowmath, focused map", 1, true, "minimal-cull"},
                {"warped", "shadowmath, warped map", 1, true}};
    }

    void load(backend::Scene const& scene) override {
        bodies_ = new osg::Group;
        auto* const positions = new osg::Vec3Array;
        auto* const normals = new osg::Vec3Array;
        auto* const colours = new osg::Vec4ubArray;
        for (backend::Vertex const& vertex : scene.vertices) {
            positions->push_back(osg::Vec3(vertex.position.x, vertex.position.y, vertex.position.z));
            normals->push_back(osg::Vec3(vertex.normal.x, vertex.normal.y, vertex.normal.z));
            colours->push_back(osg::Vec4ub(vertex.albedo[0], vertex.albedo[1], vertex.albedo[2], 255));
        }
        colours->setNormalize(true);
        for (backend::Object const& object : scene.objects) {
            auto* const geometry = new osg::Geometry;
            geometry->setUseDisplayList(false);
            geometry->setUseVertexBufferObjects(true);
            geometry->setVertexArray(positions);
            geometry->setNormalArray(normals, osg::Array::BIND_PER_VERTEX);
            geometry->setColorArray(colours, osg::Array::BIND_PER_VERTEX);
            geometry->addPrimitiveSet(
                new osg::DrawElementsUInt(GL_TRIANGLES, object.index_count, scene.indices.data() + object.first_index));
            // What OpenSceneGraph would find is the box of all vertices.
            osg::BoundingBox const box(object.lo.x, object.lo.y, object.lo.z, object.hi.x, object.hi.y, object.hi.z);
            geometry->setInitialBound(box);
            geometry->setComputeBoundingBoxCallback(new Box(box));
            auto* const geode = new osg::Geode;
            geode->addDrawable(geometry);
            geode->setNodeMask(receives | (object.casts ? casts : 0u));
            bodies_->addChild(geode);
        }
        box_ = new osg::Group;
        box_->addChild(box_of(scene));
    }

    Drawn draw(SetUp const& set_up, scenes::View const& view, backend::Extent extent) override {
        Drawn drawn;
        Stage stage(*bodies_, set_up, view, extent);
        for (int frame = 0; frame < 3; ++frame) stage.frame();
        drawn.frame = stage.read();
        Stage const empty(*box_, set_up, view, extent);
        drawn.microseconds = empty.cull_microseconds();
        return drawn;
    }

private:
    static constexpr unsigned receives = 1, casts = 2;

    class Box : public osg::Drawable::ComputeBoundingBoxCallback {
    public:
        explicit Box(osg::BoundingBox const& box) : box_(box) {}
        osg::BoundingBox computeBound(osg::Drawable const&) const override { return box_; }

    private:
        osg::BoundingBox box_;
    };

    static osg::ref_ptr<osg::Geode> box_of(backend::Scene const& scene) {
        auto* const corners = new osg::Vec3Array;
        for (unsigned i = 0; i < 8; ++i)
            corners->push_back(osg::Vec3(i & 1 ? scene.hi.x : scene.lo.x, i & 2 ? scene.hi.y : scene.lo.y,
                                         i & 4 ? scene.hi.z : scene.lo.z));
        osg::ref_ptr<osg::Geometry> const geometry = new osg::Geometry;
        geometry->setVertexArray(corners);
        geometry->addPrimitiveSet(new osg::DrawArrays(GL_POINTS, 0, 8));
        osg::ref_ptr<osg::Geode> const geode = new osg::Geode;
        geode->addDrawable(geometry);
        geode->setNodeMask(receives | casts);
        return geode;
    }

    static osg::ref_ptr<osg::Shader> shader(osg::Shader::Type type, char const* file) {
        osg::ref_ptr<osg::Shader> const shader = new osg::Shader(type);
        if (!shader->loadShaderSourceFromFile(std::string(TRIAL_MEDIA "/") + file))
            throw std::runtime_error(std::string(TRIAL_MEDIA "/") + file + ": cannot be read");
        return shader;
    }

    // A viewer without a window, and all that one picture takes.
    class Stage {
    public:
        Stage(osg::Group& bodies, SetUp const& set_up, scenes::View const& view, backend::Extent extent)
            : picture_(image(extent, GL_UNSIGNED_BYTE, GL_RGBA8)), judged_(image(extent, GL_FLOAT, GL_RGBA32F_ARB)) {
            technique_ = technique(set_up, view);
            osg::ref_ptr<osgShadow::ShadowedScene> const scene = new osgShadow::ShadowedScene(technique_);
            osgShadow::ShadowSettings* const settings = scene->getShadowSettings();
            settings->setReceivesShadowTraversalMask(receives);
            settings->setCastsShadowTraversalMask(casts);
            settings->setTextureSize(osg::Vec2s(map_size, map_size));
            settings->setMaximumShadowMapDistance(view.shadow_distance);
            settings->setNumShadowMapsPerLight(unsigned(set_up.maps));
            settings->setShaderHint(osgShadow::ShadowSettings::NO_SHADERS);
            scene->addChild(sun(view));
            scene->addChild(&bodies);
            receive(*bodies.getOrCreateStateSet(), set_up, view, extent);
            aim(view, extent);
            viewer_.setSceneData(scene);
        }
        Stage(Stage const&) = delete;
        Stage& operator=(Stage const&) = delete;

        void frame() { viewer_.frame(); }  // the first one opens a context
        // Of a traversal for drawing, without the drawing: where shadow cameras are aimed. Over one box as large as the
        // scene, that is the technique's own work.
        [[nodiscard]] double cull_microseconds() const {
            osg::ref_ptr<osgUtil::SceneView> const traversal = new osgUtil::SceneView;
            traversal->setDefaults(osgUtil::SceneView::COMPILE_GLOBJECTS_AT_INIT);
            traversal->setState(new osg::State);
            traversal->setCamera(new osg::Camera(*viewer_.getCamera()), true);
            traversal->setSceneData(const_cast<osg::Node*>(viewer_.getSceneData()));
            traversal->setFrameStamp(new osg::FrameStamp);
            traversal->update();
            return median_microseconds([&] { traversal->cull(); });
        }
        [[nodiscard]] backend::Frame read() const {
            backend::Extent const extent{picture_->s(), picture_->t()};
            backend::Frame frame;
            frame.colour = backend::Image<backend::Rgba8>(extent);
            frame.position = frame.normal = backend::Image<backend::Texel4>(extent);
            std::memcpy(frame.colour.pixels.data(), picture_->data(), 4 * frame.colour.pixels.size());
            std::memcpy(frame.position.pixels.data(), judged_->data(), 16 * frame.position.pixels.size());
            for (std::size_t i = 0; i < frame.position.pixels.size(); ++i) {
                float& w = frame.position.pixels[i].w;
                frame.normal.pixels[i] = {0.0f, 1.0f, 0.0f, w};
                w = w < -1.0f ? -2.0f : -1.0f;
            }
            return frame;
        }

    private:
        static osg::ref_ptr<osg::Image> image(backend::Extent extent, GLenum type, int format) {
            osg::ref_ptr<osg::Image> const image = new osg::Image;
            image->allocateImage(extent.width, extent.height, 1, GL_RGBA, type);
            image->setInternalTextureFormat(format);
            return image;
        }

        static osg::ref_ptr<osg::LightSource> sun(scenes::View const& view) {
            osg::ref_ptr<osg::LightSource> const source = new osg::LightSource;
            source->getLight()->setPosition(osg::Vec4(osg::Vec3(to_osg(-view.light_travel)), 0.0f));
            source->getLight()->setDirection(osg::Vec3(to_osg(view.light_travel)));
            source->setNodeMask(receives | casts);
            return source;
        }

        static TechniquePointer technique(SetUp const& set_up, scenes::View const& view) {
            std::string const& id = set_up.id;
            auto const standard = [](auto* technique) {
                technique->setTextureSize(osg::Vec2s(map_size, map_size));
                return technique;
            };
            auto const minimal = [&](auto* technique) {
                technique->setMaxFarPlane(float(view.shadow_distance));
                technique->setMinLightMargin(150.0f);  // metres toward the light where casters count; 0 as it comes
                return standard(technique);
            };
            if (id.starts_with("pssm")) {
                auto* const pssm = new osgShadow::ParallelSplitShadowMap(nullptr, set_up.maps);
                pssm->setTextureResolution(map_size);
                pssm->setMaxFarDistance(view.shadow_distance);
                pssm->setPolygonOffset(osg::Vec2f(1.1f, 4.0f));  // its siblings' own; it comes with none
                return pssm;
            }
            if (id.starts_with("vdsm")) return new osgShadow::ViewDependentShadowMap;
            if (id == "shadow-map") {
                auto* const map = new osgShadow::ShadowMap;
                map->setTextureSize(osg::Vec2s(map_size, map_size));
                return map;
            }
            if (id == "minimal") return minimal(new osgShadow::MinimalShadowMap);
            if (id == "minimal-cull") return minimal(new osgShadow::MinimalCullBoundsShadowMap);
            if (id == "lispsm") return minimal(new osgShadow::LightSpacePerspectiveShadowMapCB);
            CascadeOptions<double> options;
            options.count = set_up.maps;
            options.map_size = map_size;
            options.lambda = lambda;
            options.shadow_distance = view.shadow_distance;
            if (id.starts_with("tight")) options.fit = CascadeFit::tight;
            if (id == "focus") options.fit = CascadeFit::focus;
            if (id == "warped") options.fit = CascadeFit::warped;
            osg::ref_ptr<ShadowmathCascades> const ours = new ShadowmathCascades(options);
            // A warped map is steep where w changes, and the slope that hardware offsets by counts that too.
            if (id == "warped") ours->polygon_offset().setFactor(0.5f);
            return ours;
        }

        // Over whatever program the technique brings.
        void receive(osg::StateSet& state, SetUp const& set_up, scenes::View const& view, backend::Extent) {
            osg::ref_ptr<osg::Program> const program = new osg::Program;
            program->addShader(shader(osg::Shader::VERTEX, "receiver.vert"));
            program->addShader(shader(osg::Shader::FRAGMENT, "receiver.frag"));
            state.setAttributeAndModes(
                program, osg::StateAttribute::ON | osg::StateAttribute::OVERRIDE | osg::StateAttribute::PROTECTED);
            for (int i = 0; i < 4; ++i)
                state.addUniform(
                    new osg::Uniform(("map" + std::to_string(i)).c_str(), std::min(i, set_up.maps - 1) + 1));
            state.addUniform(new osg::Uniform("map_count", set_up.maps));
            bool const by_depth = set_up.maps == 1 || set_up.id.ends_with("by-depth");
            state.addUniform(new osg::Uniform("by_depth", by_depth ? (set_up.ours ? 1 : 2) : 0));
            auto const pose = pose_looking(view.eye, view.forward, view.up);
            osg::Matrixf const world_from_eye(osg::Matrixd(
                pose.right.x, pose.right.y, pose.right.z, 0, pose.up.x, pose.up.y, pose.up.z, 0, -pose.forward.x,
                -pose.forward.y, -pose.forward.z, 0, pose.position.x, pose.position.y, pose.position.z, 1));
            state.addUniform(new osg::Uniform("world_from_eye", world_from_eye));
        }

        void aim(scenes::View const& view, backend::Extent extent) {
            auto const traits = new osg::GraphicsContext::Traits;
            traits->width = traits->height = 64;
            traits->pbuffer = true;
            traits->doubleBuffer = false;
            traits->readDISPLAY();
            osg::ref_ptr<osg::GraphicsContext> const context = osg::GraphicsContext::createGraphicsContext(traits);
            if (!context) throw std::runtime_error("OpenSceneGraph opens no pbuffer here");
            viewer_.setThreadingModel(osgViewer::Viewer::SingleThreaded);
            viewer_.setLightingMode(osg::View::NO_LIGHT);
            osg::Camera* const camera = viewer_.getCamera();
            camera->setGraphicsContext(context);
            camera->setViewport(0, 0, extent.width, extent.height);
            camera->setRenderTargetImplementation(osg::Camera::FRAME_BUFFER_OBJECT);
            camera->attach(osg::Camera::COLOR_BUFFER0, picture_.get());
            camera->attach(osg::Camera::COLOR_BUFFER1, judged_.get());
            camera->setClearColor(osg::Vec4(0.81f, 0.88f, 0.95f, -2.0f));
            camera->setComputeNearFarMode(osg::Camera::DO_NOT_COMPUTE_NEAR_FAR);
            camera->setCullingMode(osg::CullSettings::VIEW_FRUSTUM_CULLING);
            auto const pose = pose_looking(view.eye, view.forward, view.up);
            camera->setViewMatrixAsLookAt(to_osg(pose.position), to_osg(pose.position + pose.forward), to_osg(pose.up));
            camera->setProjectionMatrixAsPerspective(osg::RadiansToDegrees(view.fov_y_radians),
                                                     double(extent.width) / double(extent.height), view.z_near,
                                                     std::max(2000.0, 2.0 * view.shadow_distance));
        }

        osg::ref_ptr<osg::Image> picture_, judged_;
        TechniquePointer technique_;
        osgViewer::Viewer viewer_;
    };

    osg::ref_ptr<osg::Group> bodies_, box_;
};

}  // namespace
}  // namespace shadowmath::engines

int main(int argc, char** argv) {
    using namespace shadowmath::engines;
    return run_trial(argc, argv, "osg", [] { return std::make_unique<OsgEngine>(); });
}
