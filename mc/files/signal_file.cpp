#include "mc/files/signal_file.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace gearpod::mc {

std::string SignalFile::find(const ColumnChoice& choice) {
    return has(choice.name) ? choice.name : "";
}

std::string SignalFile::contents() {
    return listed_text(names());
}

bool SignalFile::has(const std::string& name) const {
    const auto all = names();
    return std::find(all.begin(), all.end(), name) != all.end();
}

std::string listed_text(const std::vector<std::string>& texts) {
    constexpr std::size_t kShown = 20;
    const auto end = texts.begin() + static_cast<std::ptrdiff_t>(std::min(texts.size(), kShown));
    const std::string rest =
        texts.size() > kShown ? fmt::format(" and {} more", texts.size() - kShown) : "";
    return texts.empty() ? "none" : fmt::format("{}{}", fmt::join(texts.begin(), end, ", "), rest);
}

}  // namespace gearpod::mc
