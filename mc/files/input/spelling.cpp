#include "mc/files/input/spelling.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

namespace gearpod::mc {
namespace {

// Unit suffixes of the schema and others that users try.
constexpr std::array kUnits = {
    "_kg_mm2", "_rad_s", "_kg_m2", "_N_s_mm", "_N_s_m",  "_kN_m", "_MN_m", "_N_um", "_N_mm",
    "_N_m",    "_m_s2",  "_mm_s2", "_arcsec", "_arcmin", "_inch", "_rad",  "_deg",  "_rpm",
    "_rps",    "_kHz",   "_MHz",   "_GPa",    "_MPa",    "_kPa",  "_Nm",   "_mrad", "_mm",
    "_um",     "_cm",    "_Hz",    "_Pa",     "_kg",     "_ms",   "_us",   "_Ns_m", "_in",
    "_m",      "_s",     "_g",     "_t",      "_N"};

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::vector<int>> d(a.size() + 1, std::vector<int>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = static_cast<int>(i + j);
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1,
                                d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1)});
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) {
                d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
            }
        }
    }
    return d[a.size()][b.size()];
}

std::string_view nearest(std::string_view word, const std::vector<std::string_view>& candidates) {
    const auto found = std::min_element(candidates.begin(), candidates.end(),
                                        [&](std::string_view a, std::string_view b) {
                                            return edit_distance(word, a) < edit_distance(word, b);
                                        });
    return found == candidates.end() ? std::string_view{} : *found;
}

std::string suggest(std::string_view word, const std::vector<std::string_view>& candidates) {
    const std::string_view best = nearest(word, candidates);
    if (best.empty()) {
        return "";
    }
    // A part of a name is more likely meant than a name with as many other letters.
    const auto whole = std::ranges::find_if(candidates, [&](std::string_view candidate) {
        return word.size() >= 3 && candidate.find(word) != std::string_view::npos;
    });
    if (whole != candidates.end()) {
        return "did you mean " + std::string(*whole) + "?";
    }
    const int allowed = std::max(2, static_cast<int>(std::max(best.size(), word.size())) / 3);
    if (edit_distance(word, best) <= allowed) {
        return "did you mean " + std::string(best) + "?";
    }
    constexpr std::size_t kMostListed = 12;
    return candidates.size() > kMostListed
               ? ""
               : fmt::format("use one of {}", fmt::join(candidates, ", "));
}

std::string_view without_unit(std::string_view key) {
    std::size_t longest = 0;
    for (const std::string_view unit : kUnits) {
        if (key.size() > unit.size() && key.ends_with(unit)) {
            longest = std::max(longest, unit.size());
        }
    }
    return key.substr(0, key.size() - longest);
}

}  // namespace gearpod::mc
