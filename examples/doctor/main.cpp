// SPDX-License-Identifier: MIT
//
// Reads what an engine says of its shadow maps and says what is wrong with them: docs/doctor.md.
#include "examples/doctor/json_tree.hpp"
#include "examples/doctor/picture.hpp"
#include "examples/doctor/report.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <iostream>

namespace {

struct Arguments {
    std::filesystem::path file, picture;
    int width = 480;
};

int examine(Arguments const& arguments) {
    using namespace shadowmath::doctor;
    Case const read = read_case(arguments.file);
    shadowmath::backend::Scene const scene = scene_of(read);
    Sight const sight = look(read, scene, arguments.width);
    if (sight.points.empty())
        throw std::runtime_error(arguments.file.string() +
                                 ": the camera sees nothing that the light could reach; are scene and camera in the "
                                 "same place, and the same unit?");
    Diagnosis const diagnosis = diagnose(read, sight);
    std::vector<Advice> others;
    for (auto const fit : {shadowmath::CascadeFit::stable, shadowmath::CascadeFit::rectangle})
        if (auto const other = advice(read, scene, sight, fit)) others.push_back(*other);
    if (!arguments.picture.empty()) shadowmath::example::write_png(arguments.picture, picture(read, sight, diagnosis));
    std::cout << report(read, sight, diagnosis, others);
    if (!arguments.picture.empty()) std::cout << "\nWrote " << arguments.picture.string() << ": " << legend() << '\n';
    return diagnosis.faults() == 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
    CLI::App app{
        "Reads a camera, a light and shadow-map matrices as an engine made them, and says what is wrong with "
        "them and what would mend it. Ends with 0 when nothing is, 1 when something is, 2 when the file cannot "
        "be read."};
    Arguments arguments;
    app.add_option("case", arguments.file, "the JSON file; docs/doctor.md tells its format")->required();
    app.add_option("--picture", arguments.picture, "a PNG file to write");
    app.add_option("--width", arguments.width, "points across the picture that are looked at")
        ->check(CLI::Range(16, 2048))
        ->capture_default_str();
    try {
        app.parse(argc, argv);
        return examine(arguments);
    } catch (CLI::ParseError const& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        std::cerr << "doctor: " << error.what() << " (--help tells the options)\n";
    } catch (std::bad_alloc const&) {
        std::cerr << "doctor: out of memory\n";
    } catch (std::exception const& error) {
        std::string line = error.what();
        std::ranges::replace(line, '\n', ' ');
        std::cerr << line << '\n';
    }
    return 2;
}
