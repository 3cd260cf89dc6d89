// JSON that commands of the program print, and comparisons of its numbers.
#pragma once

#include <nlohmann/json.hpp>

#include "tests/mc/program.hpp"

namespace gearpod::test {

// JSON that a successful command prints.
inline nlohmann::json json_of(const Outcome& outcome) {
    return nlohmann::json::parse(require_success(outcome).output);
}
inline nlohmann::json json_of(const std::string& arguments) {
    return nlohmann::json::parse(require_success(arguments).output);
}

inline nlohmann::json json_of_file(const std::string& path) {
    return nlohmann::json::parse(bytes_of(path));
}

// Checks that numbers of these names agree within a share.
inline void check_alike(const nlohmann::json& found, const nlohmann::json& expected, double share,
                        const std::vector<std::string>& names) {
    for (const std::string& name : names) {
        INFO(name);
        REQUIRE(found.contains(name));
        CHECK(found[name].get<double>() == Approx(expected[name].get<double>()).epsilon(share));
    }
}

// Checks that all numbers of an object agree within a share.
inline void check_numbers(const nlohmann::json& found, const nlohmann::json& expected,
                          double share) {
    for (const auto& [name, value] : expected.items()) {
        check_alike(found, expected, share, {name});
    }
}

}  // namespace gearpod::test
