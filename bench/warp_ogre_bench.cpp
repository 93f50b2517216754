// SPDX-License-Identifier: MIT
//
// Four focused and warped cascades of one view: ours, and OGRE's PSSM over its LiSPSM set-up. Both are given the view,
// the light, and a box around what the eye sees and what casts shadows. OGRE is called without a render system: what a
// frame would have told it of visible objects is put in its place.
#include "bench/cases.hpp"

#include <shadowmath/cascades.hpp>

#include <OgreCamera.h>
#include <OgreDefaultHardwareBufferManager.h>
#include <OgreLight.h>
#include <OgreLogManager.h>
#include <OgreMaterialManager.h>
#include <OgreRoot.h>
#include <OgreSceneManagerEnumerator.h>
#include <OgreSceneNode.h>
#include <OgreShadowCameraSetupPSSM.h>

#include <benchmark/benchmark.h>

#include <memory>
#include <string>
#include <vector>

using namespace shadowmath;

namespace {

using bench::cameras;
using bench::view_count;

Aabb<float> const scene{glm::vec3(-120, 0, -120), glm::vec3(120, 30, 120)};

void ours(benchmark::State& state) {
    auto const views = bench::views_of(cameras());
    CascadeOptions<float> options;
    options.fit = CascadeFit::warped;
    Light<float> const sun = directional(bench::sun);
    std::size_t i = 0;
    for (auto _ : state) {
        Cascades<float> const cascades = fit_cascades(views[i++ % view_count], sun, scene, scene, options);
        benchmark::DoNotOptimize(cascades);
    }
}

Ogre::Vector3 to_ogre(glm::vec3 const& v) {
    return {v.x, v.y, v.z};
}

// A scene that every camera sees the same box of.
class BoxOfObjects : public Ogre::DefaultSceneManager {
public:
    BoxOfObjects() : DefaultSceneManager("box") {}
    void show_to(Ogre::Camera* camera) {
        Ogre::VisibleObjectsBoundsInfo seen;
        seen.aabb = seen.receiverAabb = Ogre::AxisAlignedBox(to_ogre(scene.lo), to_ogre(scene.hi));
        seen.minDistance = seen.minDistanceInFrustum = 0.1f;
        seen.maxDistance = seen.maxDistanceInFrustum = 200.0f;
        mCamVisibleObjectsMap[camera] = seen;
    }
};

void ogre(benchmark::State& state) {
    Ogre::LogManager log;
    log.createLog("bench", true, false, true);
    Ogre::Root const root("", "", "");
    Ogre::DefaultHardwareBufferManager buffers;
    Ogre::MaterialManager::getSingleton().initialise();
    {
        BoxOfObjects manager;
        std::vector<Ogre::Camera*> eyes;
        for (textbook::Camera const& camera : cameras()) {
            Ogre::Camera* const eye = manager.createCamera("eye" + std::to_string(eyes.size()));
            Ogre::SceneNode* const node = manager.getRootSceneNode()->createChildSceneNode();
            node->attachObject(eye);
            node->setPosition(to_ogre(camera.position));
            node->setDirection(to_ogre(camera.forward), Ogre::Node::TS_WORLD);
            eye->setFOVy(Ogre::Radian(camera.fov_y));
            eye->setAspectRatio(camera.aspect);
            eye->setNearClipDistance(camera.z_near);
            eye->setFarClipDistance(camera.z_far);
            manager.show_to(eye);
            eyes.push_back(eye);
        }
        Ogre::Camera* const map = manager.createCamera("map");
        manager.getRootSceneNode()->createChildSceneNode()->attachObject(map);
        Ogre::Light* const sun = manager.createLight("sun");
        sun->setType(Ogre::Light::LT_DIRECTIONAL);
        Ogre::SceneNode* const of_sun = manager.getRootSceneNode()->createChildSceneNode();
        of_sun->attachObject(sun);
        of_sun->setDirection(to_ogre(bench::sun), Ogre::Node::TS_WORLD);
        manager.getRootSceneNode()->_update(true, false);
        manager.setShadowFarDistance(200.0f);
        Ogre::PSSMShadowCameraSetup setup;
        std::size_t i = 0;
        for (auto _ : state) {
            Ogre::Camera* const eye = eyes[i++ % view_count];
            setup.calculateSplitPoints(4, 0.1f, 200.0f, 0.5f);
            for (std::size_t k = 0; k < 4; ++k) {
                setup.getShadowCamera(&manager, eye, nullptr, sun, map, k);
                benchmark::DoNotOptimize(map->getProjectionMatrix());
                benchmark::DoNotOptimize(map->getViewMatrix());
            }
        }
    }
}

}  // namespace

BENCHMARK(ours)->Name("warped_cascades/ours");
BENCHMARK(ogre)->Name("warped_cascades/ogre");
