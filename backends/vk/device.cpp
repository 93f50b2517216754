// SPDX-License-Identifier: MIT
#define VOLK_IMPLEMENTATION
#include "backends/vk/device.hpp"

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <optional>
#include <stdexcept>

namespace shadowmath::backend::vk {
namespace {

constexpr char const* validation_layer = "VK_LAYER_KHRONOS_validation";
constexpr char const* no_loader =
    "there is no Vulkan loader (libvulkan.so.1) here; the Debian package libvulkan1 brings it";
constexpr char const* no_driver = "there is no Vulkan 1.1 driver with depth clamping here; the Debian package "
                                  "mesa-vulkan-drivers brings a software one";

bool has_validation_layer() {
    std::uint32_t count = 0;
    vkEnumerateInstanceLayerProperties(&count, nullptr);
    std::vector<VkLayerProperties> layers(count);
    vkEnumerateInstanceLayerProperties(&count, layers.data());
    return std::ranges::any_of(layers, [](auto const& l) { return std::strcmp(l.layerName, validation_layer) == 0; });
}

VKAPI_ATTR VkBool32 VKAPI_CALL keep(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                    VkDebugUtilsMessengerCallbackDataEXT const* data, void* messages) {
    std::string line = data->pMessage;
    std::ranges::replace(line, '\n', ' ');
    static_cast<std::vector<std::string>*>(messages)->push_back(line);
    return VK_FALSE;
}

VkDebugUtilsMessengerCreateInfoEXT listening(std::vector<std::string>& messages) {
    VkDebugUtilsMessengerCreateInfoEXT info{};
    info.sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT;
    info.messageSeverity =
        VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
    info.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_TYPE_PERFORMANCE_BIT_EXT;
    info.pfnUserCallback = keep;
    info.pUserData = &messages;
    return info;
}

std::optional<std::uint32_t> drawing_queue_family(VkPhysicalDevice device) {
    std::uint32_t count = 0;
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, nullptr);
    std::vector<VkQueueFamilyProperties> families(count);
    vkGetPhysicalDeviceQueueFamilyProperties(device, &count, families.data());
    constexpr VkQueueFlags needed = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    auto const found = std::ranges::find_if(families, [](auto const& f) { return (f.queueFlags & needed) == needed; });
    if (found == families.end()) return std::nullopt;
    return static_cast<std::uint32_t>(std::distance(families.begin(), found));
}

bool has_extension(VkPhysicalDevice device, char const* name) {
    std::uint32_t count = 0;
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, nullptr);
    std::vector<VkExtensionProperties> extensions(count);
    vkEnumerateDeviceExtensionProperties(device, nullptr, &count, extensions.data());
    return std::ranges::any_of(extensions, [&](auto const& e) { return std::strcmp(e.extensionName, name) == 0; });
}

// The lower, the better; nothing for a device that cannot draw what the backend draws.
std::optional<int> rank(VkPhysicalDevice device, bool software) {
    VkPhysicalDeviceProperties properties;
    VkPhysicalDeviceFeatures features;
    vkGetPhysicalDeviceProperties(device, &properties);
    vkGetPhysicalDeviceFeatures(device, &features);
    if (properties.apiVersion < VK_API_VERSION_1_1 || features.depthClamp != VK_TRUE) return std::nullopt;
    if (!drawing_queue_family(device)) return std::nullopt;
    if (software && properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU) return std::nullopt;
    constexpr std::array best_first{VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU, VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU,
                                    VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU, VK_PHYSICAL_DEVICE_TYPE_CPU};
    return static_cast<int>(std::ranges::find(best_first, properties.deviceType) - best_first.begin());
}

}  // namespace

void demand(VkResult result, char const* what) {
    if (result != VK_SUCCESS)
        throw std::runtime_error(std::string("Vulkan could not ") + what + " (VkResult " + std::to_string(result) +
                                 ")");
}

Device::Device(VulkanOptions const& options) : last_words_(options.last_words) {
    try {
        make_instance(options.validation);
        choose_physical(options.software);
        find_abilities();
        make_device();
    } catch (...) {
        destroy();
        throw;
    }
}

Device::~Device() {
    destroy();
    if (last_words_ != nullptr) std::ranges::move(messages, std::back_inserter(*last_words_));
}

std::string Device::description() const {
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical_, &properties);
    auto const version = [](std::uint32_t v) {
        return std::to_string(VK_API_VERSION_MAJOR(v)) + "." + std::to_string(VK_API_VERSION_MINOR(v)) + "." +
               std::to_string(VK_API_VERSION_PATCH(v));
    };
    return std::string(properties.deviceName) + ", Vulkan " + version(properties.apiVersion);
}

std::uint32_t Device::memory_type(std::uint32_t allowed, VkMemoryPropertyFlags required,
                                  VkMemoryPropertyFlags wished) const {
    VkPhysicalDeviceMemoryProperties memory;
    vkGetPhysicalDeviceMemoryProperties(physical_, &memory);
    for (VkMemoryPropertyFlags const flags : {required | wished, required})
        for (std::uint32_t type = 0; type < memory.memoryTypeCount; ++type)
            if ((allowed >> type & 1u) != 0u && (memory.memoryTypes[type].propertyFlags & flags) == flags) return type;
    throw std::runtime_error("the Vulkan driver has no memory for what is to be drawn");
}

void Device::make_instance(bool validation) {
    // At run time: a program with this backend starts where there is no Vulkan, and draws with another one.
    if (volkInitialize() != VK_SUCCESS) throw std::runtime_error(no_loader);
    if (validation && !has_validation_layer())
        throw std::runtime_error(
            "the Vulkan validation layers are missing; the Debian package vulkan-validationlayers brings them");

    VkApplicationInfo application{};
    application.sType = VK_STRUCTURE_TYPE_APPLICATION_INFO;
    application.pApplicationName = "shadowmath";
    application.apiVersion = VK_API_VERSION_1_1;

    // The messenger hears a device's life, this chained one the instance's own beginning and end.
    VkDebugUtilsMessengerCreateInfoEXT listener = listening(messages);
    VkValidationFeatureEnableEXT const synchronisation = VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT;
    VkValidationFeaturesEXT features{};
    features.sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT;
    features.enabledValidationFeatureCount = 1;
    features.pEnabledValidationFeatures = &synchronisation;
    features.pNext = &listener;
    constexpr char const* extension = VK_EXT_DEBUG_UTILS_EXTENSION_NAME;

    VkInstanceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO;
    info.pApplicationInfo = &application;
    if (validation) {
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = &validation_layer;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = &extension;
    }
    VkResult const result = vkCreateInstance(&info, nullptr, &instance_);
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER) throw std::runtime_error(no_driver);
    demand(result, "make an instance");
    volkLoadInstance(instance_);
    if (!validation) return;
    auto const create = reinterpret_cast<PFN_vkCreateDebugUtilsMessengerEXT>(
        vkGetInstanceProcAddr(instance_, "vkCreateDebugUtilsMessengerEXT"));
    listener.pNext = nullptr;
    demand(create(instance_, &listener, nullptr, &messenger_), "listen to the validation layers");
}

void Device::choose_physical(bool software) {
    std::uint32_t count = 0;
    vkEnumeratePhysicalDevices(instance_, &count, nullptr);
    std::vector<VkPhysicalDevice> candidates(count);
    vkEnumeratePhysicalDevices(instance_, &count, candidates.data());
    std::optional<int> best;
    for (VkPhysicalDevice const candidate : candidates) {
        std::optional<int> const found = rank(candidate, software);
        if (!found || (best && *best <= *found)) continue;
        best = found;
        physical_ = candidate;
    }
    if (!best) throw std::runtime_error(no_driver);
    queue_family_ = *drawing_queue_family(physical_);
}

void Device::find_abilities() {
    VkPhysicalDeviceMultiviewFeatures multiview{};
    multiview.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES;
    VkPhysicalDeviceFeatures2 features{};
    features.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2;
    features.pNext = &multiview;
    vkGetPhysicalDeviceFeatures2(physical_, &features);
    VkPhysicalDeviceMultiviewProperties views{};
    views.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_PROPERTIES;
    VkPhysicalDeviceProperties2 properties{};
    properties.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2;
    properties.pNext = &views;
    vkGetPhysicalDeviceProperties2(physical_, &properties);
    abilities_.geometry_shader = features.features.geometryShader == VK_TRUE;
    abilities_.layer_from_vertex_shader = has_extension(physical_, VK_EXT_SHADER_VIEWPORT_INDEX_LAYER_EXTENSION_NAME);
    abilities_.doubles = features.features.shaderFloat64 == VK_TRUE;
    abilities_.statistics = features.features.pipelineStatisticsQuery == VK_TRUE;
    abilities_.views_at_once = multiview.multiview == VK_TRUE ? views.maxMultiviewViewCount : 0u;
}

void Device::make_device() {
    float const priority = 1.0f;
    VkDeviceQueueCreateInfo queue{};
    queue.sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO;
    queue.queueFamilyIndex = queue_family_;
    queue.queueCount = 1;
    queue.pQueuePriorities = &priority;
    VkPhysicalDeviceFeatures features{};
    features.depthClamp = VK_TRUE;
    features.geometryShader = abilities_.geometry_shader ? VK_TRUE : VK_FALSE;
    features.shaderFloat64 = abilities_.doubles ? VK_TRUE : VK_FALSE;
    features.pipelineStatisticsQuery = abilities_.statistics ? VK_TRUE : VK_FALSE;
    VkPhysicalDeviceMultiviewFeatures multiview{};
    multiview.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_MULTIVIEW_FEATURES;
    multiview.multiview = abilities_.views_at_once > 0u ? VK_TRUE : VK_FALSE;
    constexpr char const* extension = VK_EXT_SHADER_VIEWPORT_INDEX_LAYER_EXTENSION_NAME;
    VkDeviceCreateInfo info{};
    info.sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO;
    info.pNext = &multiview;
    info.enabledExtensionCount = abilities_.layer_from_vertex_shader ? 1u : 0u;
    info.ppEnabledExtensionNames = &extension;
    info.queueCreateInfoCount = 1;
    info.pQueueCreateInfos = &queue;
    info.pEnabledFeatures = &features;
    demand(vkCreateDevice(physical_, &info, nullptr, &device_), "open the device");
    vkGetDeviceQueue(device_, queue_family_, 0, &queue_);
}

void Device::destroy() noexcept {
    if (device_ != VK_NULL_HANDLE) vkDestroyDevice(device_, nullptr);
    if (messenger_ != VK_NULL_HANDLE)
        reinterpret_cast<PFN_vkDestroyDebugUtilsMessengerEXT>(
            vkGetInstanceProcAddr(instance_, "vkDestroyDebugUtilsMessengerEXT"))(instance_, messenger_, nullptr);
    if (instance_ != VK_NULL_HANDLE) vkDestroyInstance(instance_, nullptr);
}

}  // namespace shadowmath::backend::vk
