#include "mc/study/keys/key.hpp"

#include <fmt/format.h>

#include <iterator>

namespace gearpod::mc {

std::string Key::path() const {
    return fmt::format("{}.{}", section, name);
}

std::string Key::table() const {
    const std::string whole = path();
    return whole.substr(0, whole.rfind('.'));
}

std::string_view Key::label() const {
    return std::string_view(name).substr(name.rfind('.') + 1);
}

std::string_view Key::stem() const {
    const std::string_view whole = name;
    return unit.suffix.empty() ? whole : whole.substr(0, whole.size() - unit.suffix.size() - 1);
}

std::string Key::column() const {
    std::string column(stem());
    std::ranges::replace(column, '.', '_');
    return unit.si_suffix.empty() ? column : fmt::format("{}_{}", column, unit.si_suffix);
}

std::string flat_path(std::string_view path) {
    std::string flat(path);
    if (const auto dot = std::ranges::find(flat, '.'); dot != flat.end()) {
        std::replace(std::next(dot), flat.end(), '.', '_');
    }
    return flat;
}

}  // namespace gearpod::mc
