// SPDX-License-Identifier: MIT
//
// The scenes in OGRE, shadowed by its own set-ups and by ours: scripts/engines ogre. Nothing here needs to be copied;
// that is shadowmath_camera_setup.hpp.
#include "examples/engines/trial.hpp"
#include "examples/ogre/shadowmath_camera_setup.hpp"

#include <OgreEntity.h>
#include <OgreHardwareBufferManager.h>
#include <OgreHardwarePixelBuffer.h>
#include <OgreLogManager.h>
#include <OgreMaterialManager.h>
#include <OgreMesh.h>
#include <OgreMeshManager.h>
#include <OgreMovablePlane.h>
#include <OgreRenderTexture.h>
#include <OgreRenderWindow.h>
#include <OgreRoot.h>
#include <OgreShadowCameraSetupFocused.h>
#include <OgreShadowCameraSetupLiSPSM.h>
#include <OgreShadowCameraSetupPSSM.h>
#include <OgreShadowCameraSetupPlaneOptimal.h>
#include <OgreSubMesh.h>
#include <OgreTechnique.h>
#include <OgreTextureManager.h>
#include <OgreViewport.h>

#include <cmath>

namespace shadowmath::engines {
namespace {

using Ogre::Vector3;

Vector3 to_ogre_vector(glm::dvec3 v) {
    return {float(v.x), float(v.y), float(v.z)};
}

constexpr float lambda = 0.65f;
constexpr char const* group = "General";

// What a set-up is: the shadow cameras, and how the receivers choose between the maps.
struct Aimed {
    Ogre::ShadowCameraSetupPtr setup;
    bool by_depth = true;
    std::function<Ogre::Vector4()> split_ends;
};

class OgreEngine : public Engine {
public:
    OgreEngine() {
        log_.createLog("trial", true, false, true);
        root_ = std::make_unique<Ogre::Root>("", "", "");
        root_->loadPlugin(OGRE_PLUGINS "/RenderSystem_GL3Plus");
        root_->setRenderSystem(root_->getAvailableRenderers().front());
        root_->initialise(false);
        Ogre::NameValuePairList const hidden{{"hidden", "true"}};
        root_->createRenderWindow("trial", 64, 64, false, &hidden)->setAutoUpdated(false);
        auto& resources = Ogre::ResourceGroupManager::getSingleton();
        resources.addResourceLocation(TRIAL_MEDIA, "FileSystem", group);
        resources.addResourceLocation(OGRE_MEDIA "/ShadowVolume", "FileSystem", group);  // OGRE itself asks for it
        resources.initialiseAllResourceGroups();
    }

    std::string name() const override {
        return "OGRE " + std::to_string(OGRE_VERSION_MAJOR) + "." + std::to_string(OGRE_VERSION_MINOR) + "." +
               std::to_string(OGRE_VERSION_PATCH) + ", " + root_->getRenderSystem()->getName() + " on " +
               root_->getRenderSystem()->getCapabilities()->getDeviceName();
    }

    std::vector<SetUp> set_ups() const override {
        return {{"pssm", "PSSM, λ 0.95", 4},
                {"pssm-065", "PSSM, λ 0.65", 4},
                {"pssm-065-holding", "PSSM, λ 0.65, first map that holds the point", 4},
                {"stable", "shadowmath, stable cascades, λ 0.65", 4, true},
                {"stable-holding", "shadowmath, stable cascades, λ 0.65, first map that holds the point", 4, true},
                {"tight", "shadowmath, tight cascades, λ 0.65", 4, true},
                {"tight-holding", "shadowmath, tight cascades, λ 0.65, first map that holds the point", 4, true},
                {"focused-4", "shadowmath, focused cascades, λ 0.65", 4, true, "pssm"},
                {"focused-4-holding", "shadowmath, focused cascades, λ 0.65, first map that holds the point", 4, true,
                 "pssm-065-holding"},
                {"default", "Default", 1},
                {"focused", "Focused", 1},
                {"lispsm", "LiSPSM", 1},
                {"plane-optimal", "Plane optimal", 1},
                {"focus", "shadowmath, focused map", 1, true, "focused"},
                {"warped", "shadowmath, warped map", 1, true, "lispsm", 0.5f},
                {"plane", "shadowmath, view-dependent map", 1, true, "plane-optimal", 0.5f},
                {"plane-2", "shadowmath, view-dependent map, focused map behind it", 2, true, {}, 0.5f}};
    }

    void load(backend::Scene const& scene) override {
        unload();
        scene_ = root_->createSceneManager();
        vertices_ = upload_vertices(scene);
        indices_ = upload_indices(scene);
        feet_.clear();
        for (backend::Object const& object : scene.objects) add(scene, object);
        sun_ = scene_->createLight();
        sun_->setType(Ogre::Light::LT_DIRECTIONAL);
        sun_->setCastShadows(true);
        scene_->getRootSceneNode()->createChildSceneNode()->attachObject(sun_);
        camera_ = scene_->createCamera("eye");
        scene_->getRootSceneNode()->createChildSceneNode()->attachObject(camera_);
        scene_->setShadowTechnique(Ogre::SHADOWTYPE_TEXTURE_ADDITIVE_INTEGRATED);
        scene_->setShadowTextureSelfShadow(true);
        scene_->setShadowCasterRenderBackFaces(false);
        // As many as any set-up uses: where their number falls, OGRE 1.12.10 keeps projectors that are no more.
        scene_->setShadowTextureSettings(map_size, 4, Ogre::PF_DEPTH32F);
        scene_->setShadowTextureCasterMaterial(Ogre::MaterialManager::getSingleton().getByName("trial/caster"));
    }

    Drawn draw(SetUp const& set_up, scenes::View const& view, backend::Extent extent) override {
        aim_eye(view, extent);
        scene_->setShadowFarDistance(float(view.shadow_distance));
        scene_->setShadowTextureCountPerLightType(Ogre::Light::LT_DIRECTIONAL, std::size_t(set_up.maps));
        Ogre::MovablePlane ground(Vector3::UNIT_Y, ground_height(view));
        Aimed const aimed = aimed_as(set_up, view, ground);
        scene_->setShadowCameraSetup(aimed.setup);

        Ogre::MaterialManager::getSingleton()
            .getByName("trial/caster")
            ->getTechnique(0)
            ->getPass(0)
            ->setDepthBias(-2.0f, -set_up.slope_bias);  // OGRE counts toward the eye
        Target target(extent, *camera_);
        Ogre::GpuProgramParametersSharedPtr const parameters = Ogre::MaterialManager::getSingleton()
                                                                   .getByName("trial/receiver")
                                                                   ->getTechnique(0)
                                                                   ->getPass(0)
                                                                   ->getFragmentProgramParameters();
        parameters->setNamedConstant("map_count", set_up.maps);
        parameters->setNamedConstant("by_depth", aimed.by_depth ? 1 : 0);
        // OGRE's own set-ups see the visible objects of the frame before; the splits of ours are known after it.
        for (int frame = 0; frame < 2; ++frame) {
            target.draw();
            parameters->setNamedConstant("split_ends", aimed.split_ends());
        }
        Drawn drawn;
        drawn.frame = target.read();
        std::array<Ogre::Camera*, 4> shadow_cameras{};
        for (std::size_t i = 0; i < 4; ++i)
            shadow_cameras[i] =
                scene_->getShadowTexture(i)->getBuffer()->getRenderTarget()->getViewport(0)->getCamera();
        drawn.microseconds = median_microseconds([&] {
            for (std::size_t i = 0; i < std::size_t(set_up.maps); ++i)
                aimed.setup->getShadowCamera(scene_, camera_, target.viewport(), sun_, shadow_cameras[i], i);
        });
        // A set-up that leaves the cameras as they are (PlaneOptimal does at times) must not profit from the last.
        for (Ogre::Camera* const camera : shadow_cameras) to_ogre::aim(*camera, ShadowMap<float>{});
        scene_->setShadowCameraSetup(Ogre::DefaultShadowCameraSetup::create());
        return drawn;
    }

private:
    // What is drawn to: the picture, and what the judge asks of each pixel.
    class Target {
    public:
        Target(backend::Extent extent, Ogre::Camera& camera) : extent_(extent) {
            picture_ = texture("picture", Ogre::PF_BYTE_RGBA);
            judged_ = texture("judged", Ogre::PF_FLOAT32_RGBA);
            both_ = Ogre::Root::getSingleton().getRenderSystem()->createMultiRenderTarget("both");
            both_->bindSurface(0, picture_->getBuffer()->getRenderTarget());
            both_->bindSurface(1, judged_->getBuffer()->getRenderTarget());
            both_->setAutoUpdated(false);
            viewport_ = both_->addViewport(&camera);
            viewport_->setOverlaysEnabled(false);
            viewport_->setBackgroundColour(Ogre::ColourValue(0.81f, 0.88f, 0.95f, -2.0f));
        }
        ~Target() {
            Ogre::Root::getSingleton().getRenderSystem()->destroyRenderTarget("both");
            Ogre::TextureManager::getSingleton().remove(picture_);
            Ogre::TextureManager::getSingleton().remove(judged_);
        }
        Target(Target const&) = delete;
        Target& operator=(Target const&) = delete;

        void draw() { both_->update(); }
        [[nodiscard]] Ogre::Viewport* viewport() const { return viewport_; }

        // Row 0 of OGRE's pictures is the top one, of ours the bottom one.
        [[nodiscard]] backend::Frame read() const {
            auto const width = std::uint32_t(extent_.width), height = std::uint32_t(extent_.height);
            backend::Image<backend::Rgba8> picture(extent_);
            backend::Image<backend::Texel4> judged(extent_);
            picture_->getBuffer()->blitToMemory({width, height, 1, Ogre::PF_BYTE_RGBA, picture.pixels.data()});
            judged_->getBuffer()->blitToMemory({width, height, 1, Ogre::PF_FLOAT32_RGBA, judged.pixels.data()});
            backend::Frame frame;
            frame.colour = backend::Image<backend::Rgba8>(extent_);
            frame.position = frame.normal = backend::Image<backend::Texel4>(extent_);
            for (int y = 0; y < extent_.height; ++y)
                for (int x = 0; x < extent_.width; ++x) {
                    int const from = extent_.height - 1 - y;
                    backend::Texel4 const texel = judged.at(x, from);
                    frame.colour.at(x, y) = picture.at(x, from);
                    frame.position.at(x, y) = {texel.x, texel.y, texel.z, texel.w < -1.0f ? -2.0f : -1.0f};
                    frame.normal.at(x, y) = {0.0f, 1.0f, 0.0f, texel.w};
                }
            return frame;
        }

    private:
        Ogre::TexturePtr texture(char const* name, Ogre::PixelFormat format) const {
            auto made = Ogre::TextureManager::getSingleton().createManual(
                name, group, Ogre::TEX_TYPE_2D, std::uint32_t(extent_.width), std::uint32_t(extent_.height), 0, format,
                Ogre::TU_RENDERTARGET);
            made->getBuffer()->getRenderTarget()->setAutoUpdated(false);
            return made;
        }

        backend::Extent extent_;
        Ogre::TexturePtr picture_, judged_;
        Ogre::MultiRenderTarget* both_ = nullptr;
        Ogre::Viewport* viewport_ = nullptr;
    };

    static Ogre::HardwareVertexBufferSharedPtr upload_vertices(backend::Scene const& scene) {
        auto buffer = Ogre::HardwareBufferManager::getSingleton().createVertexBuffer(
            sizeof(backend::Vertex), scene.vertices.size(), Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
        buffer->writeData(0, buffer->getSizeInBytes(), scene.vertices.data(), true);
        return buffer;
    }

    static Ogre::HardwareIndexBufferSharedPtr upload_indices(backend::Scene const& scene) {
        auto buffer = Ogre::HardwareBufferManager::getSingleton().createIndexBuffer(
            Ogre::HardwareIndexBuffer::IT_32BIT, scene.indices.size(), Ogre::HardwareBuffer::HBU_STATIC_WRITE_ONLY);
        buffer->writeData(0, buffer->getSizeInBytes(), scene.indices.data(), true);
        return buffer;
    }

    // A range of the two buffers, with a box of its own, so that OGRE culls it for eye and light.
    void add(backend::Scene const& scene, backend::Object const& object) {
        auto mesh = Ogre::MeshManager::getSingleton().createManual("object" + std::to_string(meshes_.size()), group);
        Ogre::SubMesh* const part = mesh->createSubMesh();
        part->useSharedVertices = false;
        part->vertexData = OGRE_NEW Ogre::VertexData();
        part->vertexData->vertexCount = scene.vertices.size();
        auto* const layout = part->vertexData->vertexDeclaration;
        layout->addElement(0, offsetof(backend::Vertex, position), Ogre::VET_FLOAT3, Ogre::VES_POSITION);
        layout->addElement(0, offsetof(backend::Vertex, normal), Ogre::VET_FLOAT3, Ogre::VES_NORMAL);
        layout->addElement(0, offsetof(backend::Vertex, albedo), Ogre::VET_UBYTE4_NORM, Ogre::VES_DIFFUSE);
        part->vertexData->vertexBufferBinding->setBinding(0, vertices_);
        part->indexData->indexBuffer = indices_;
        part->indexData->indexStart = object.first_index;
        part->indexData->indexCount = object.index_count;
        Ogre::AxisAlignedBox const box(to_ogre_vector(object.lo), to_ogre_vector(object.hi));
        mesh->_setBounds(box, false);
        mesh->_setBoundingSphereRadius(std::max(box.getMinimum().length(), box.getMaximum().length()));
        mesh->load();
        Ogre::Entity* const entity = scene_->createEntity(mesh);
        entity->setMaterialName("trial/receiver");
        entity->setCastShadows(object.casts);
        scene_->getRootSceneNode()->createChildSceneNode()->attachObject(entity);
        meshes_.push_back(mesh);
        if (object.receives) feet_.push_back(object.lo.y);
    }

    void unload() {
        if (scene_ == nullptr) return;
        root_->destroySceneManager(scene_);
        for (Ogre::MeshPtr const& mesh : meshes_) Ogre::MeshManager::getSingleton().remove(mesh);
        meshes_.clear();
    }

    void aim_eye(scenes::View const& view, backend::Extent extent) {
        auto const pose = pose_looking(view.eye, view.forward, view.up);
        Ogre::SceneNode* const node = camera_->getParentSceneNode();
        node->setPosition(to_ogre_vector(pose.position));
        node->setOrientation(
            Ogre::Quaternion(to_ogre_vector(pose.right), to_ogre_vector(pose.up), to_ogre_vector(-pose.forward)));
        camera_->setFOVy(Ogre::Radian(float(view.fov_y_radians)));
        camera_->setAspectRatio(float(extent.width) / float(extent.height));
        camera_->setNearClipDistance(float(view.z_near));
        camera_->setFarClipDistance(float(std::max(2000.0, 2.0 * view.shadow_distance)));
        sun_->getParentSceneNode()->setDirection(to_ogre_vector(view.light_travel), Ogre::Node::TS_WORLD);
    }

    // Where most things stand; the same plane for OGRE's set-up and ours.
    float ground_height(scenes::View const&) const {
        std::vector<float> feet = feet_;
        auto const middle = feet.begin() + std::ptrdiff_t(feet.size() / 2);
        std::nth_element(feet.begin(), middle, feet.end());
        return *middle;
    }

    Aimed aimed_as(SetUp const& set_up, scenes::View const& view, Ogre::MovablePlane const& ground) const {
        std::string const& id = set_up.id;
        bool const holding = id.ends_with("-holding") || set_up.maps == 2;
        if (id.starts_with("pssm")) {
            auto pssm = std::make_shared<Ogre::PSSMShadowCameraSetup>();
            pssm->calculateSplitPoints(4, float(view.z_near), float(view.shadow_distance),
                                       id == "pssm" ? 0.95f : lambda);
            pssm->setSplitPadding(float(view.z_near));
            auto const ends = [pssm] {
                auto const& points = pssm->getSplitPoints();
                return Ogre::Vector4(points[1], points[2], points[3], points[4]);
            };
            return {pssm, !holding, ends};
        }
        auto const one = [&view] { return Ogre::Vector4(float(view.shadow_distance)); };
        if (id == "default") return {Ogre::DefaultShadowCameraSetup::create(), true, one};
        if (id == "focused") return {Ogre::FocusedShadowCameraSetup::create(), true, one};
        if (id == "lispsm") return {Ogre::LiSPSMShadowCameraSetup::create(), true, one};
        if (id == "plane-optimal") return {Ogre::PlaneOptimalShadowCameraSetup::create(&ground), true, one};
        if (id.starts_with("plane")) {
            auto const plane = std::make_shared<ShadowmathPlaneSetup>(ground._getDerivedPlane(), map_size);
            return {plane, !holding, one};
        }
        CascadeOptions<float> options;
        options.count = set_up.maps;
        options.map_size = map_size;
        options.lambda = lambda;
        if (id.starts_with("tight")) options.fit = CascadeFit::tight;
        if (id.starts_with("focus")) options.fit = CascadeFit::focus;
        if (id == "warped") options.fit = CascadeFit::warped;
        auto const ours = std::make_shared<ShadowmathCameraSetup>(options);
        return {ours, !holding, [ours] { return ours->split_ends(); }};
    }

    Ogre::LogManager log_;
    std::unique_ptr<Ogre::Root> root_;
    Ogre::SceneManager* scene_ = nullptr;
    Ogre::Light* sun_ = nullptr;
    Ogre::Camera* camera_ = nullptr;
    Ogre::HardwareVertexBufferSharedPtr vertices_;
    Ogre::HardwareIndexBufferSharedPtr indices_;
    std::vector<Ogre::MeshPtr> meshes_;
    std::vector<float> feet_;
};

}  // namespace
}  // namespace shadowmath::engines

int main(int argc, char** argv) {
    using namespace shadowmath::engines;
    return run_trial(argc, argv, "ogre", [] { return std::make_unique<OgreEngine>(); });
}
