// Rewrites the golden curves, all or the named ones: make_golden [NAME ...]
#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <string>
#include <vector>

#include "tests/golden/golden.hpp"

int main(int count, char** arguments) {
    using namespace gearpod::golden;
    const std::vector<std::string> names(arguments + 1, arguments + count);
    std::size_t written = 0;
    try {
        for (const Golden& golden : goldens()) {
            if (!names.empty() &&
                std::find(names.begin(), names.end(), golden.name) == names.end()) {
                continue;
            }
            write_curves(golden, compute(golden));
            fmt::print("{}\n", curves_path(golden));
            ++written;
        }
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
    if (written < names.size() || written == 0) {
        fmt::print(stderr, "some names are not in tests/golden/table.cpp\n");
        return 2;
    }
    return 0;
}
