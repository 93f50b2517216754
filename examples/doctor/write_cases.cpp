// SPDX-License-Identifier: MIT
//
// Writes the sample cases: doctor_cases examples/doctor/cases
#include "examples/doctor/sample_cases.hpp"

#include <filesystem>
#include <fstream>
#include <iostream>

int main(int argc, char** argv) {
    if (argc != 2) {
        std::cerr << "doctor_cases FOLDER\n";
        return 2;
    }
    for (auto const& [name, text] : shadowmath::doctor::sample_cases()) {
        std::ofstream file(std::filesystem::path(argv[1]) / name, std::ios::binary);
        file << text;
        file.close();
        if (!file) {
            std::cerr << argv[1] << '/' << name << ": cannot be written\n";
            return 1;
        }
    }
    return 0;
}
