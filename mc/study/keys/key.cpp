#include "mc/study/keys/key.hpp"

#include <fmt/format.h>

namespace gearpod::mc {

std::string Key::path() const {
    return fmt::format("{}.{}", section, name);
}

std::string_view Key::stem() const {
    return unit.suffix.empty() ? name : name.substr(0, name.size() - unit.suffix.size() - 1);
}

std::string Key::column() const {
    return unit.si_suffix.empty() ? std::string(stem())
                                  : fmt::format("{}_{}", stem(), unit.si_suffix);
}

}  // namespace gearpod::mc
