// SPDX-License-Identifier: MIT
#include "examples/gallery/staging.hpp"

#include <unistd.h>

#include <stdexcept>
#include <string>
#include <system_error>

namespace shadowmath::gallery {
namespace {

namespace fs = std::filesystem;

void demand(std::error_code error, fs::path const& path, char const* what) {
    if (error) throw std::runtime_error(path.string() + ": " + what + " (" + error.message() + ")");
}

// Another program's folder is nobody's to delete.
bool may_be_replaced(fs::path const& destination) {
    std::error_code error;
    if (!fs::exists(fs::symlink_status(destination, error))) return true;
    if (!fs::is_directory(destination, error)) return false;
    bool const empty = fs::is_empty(destination, error);
    return !error && (empty || (fs::exists(destination / "results.json", error) &&
                                fs::exists(destination / "index.html", error)));
}

}  // namespace

Staging::Staging(fs::path const& destination) {
    std::error_code error;
    destination_ = fs::absolute(destination, error).lexically_normal();
    demand(error, destination, "is no usable path");
    if (!destination_.has_filename()) destination_ = destination_.parent_path();
    if (!may_be_replaced(destination_))
        throw std::runtime_error(destination.string() + ": exists and is not a gallery; it will not be overwritten");
    fs::create_directories(destination_.parent_path(), error);
    demand(error, destination_.parent_path(), "cannot be made");
    fs::path folder = destination_.parent_path() / ".";
    folder += destination_.filename().string() + ".unfinished-" + std::to_string(::getpid());
    fs::create_directory(folder, error);
    demand(error, folder, "cannot be made");
    folder_ = folder;
}

Staging::~Staging() {
    std::error_code ignored;
    if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

void Staging::publish() {
    std::error_code error;
    fs::path const old = folder_.string() + "-old";
    bool const replaces = fs::exists(destination_, error);
    if (replaces) fs::rename(destination_, old, error);
    demand(error, destination_, "cannot be replaced");
    fs::rename(folder_, destination_, error);
    if (error && replaces) {
        std::error_code ignored;
        fs::rename(old, destination_, ignored);
    }
    demand(error, destination_, "cannot be written");
    folder_.clear();
    if (replaces) fs::remove_all(old, error);
}

}  // namespace shadowmath::gallery
