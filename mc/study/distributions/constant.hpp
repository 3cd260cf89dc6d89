// Degenerate distribution: one value for all gearboxes.
#pragma once

#include <cstdint>
#include <string_view>
#include <tuple>
#include <vector>

#include "mc/random/philox.hpp"
#include "mc/study/distributions/field.hpp"
#include "mc/study/distributions/support.hpp"

namespace gearpod::mc {

struct Constant : LawDefaults {
    static constexpr std::string_view kName = "constant";
    double value = 0.0;

    static constexpr auto fields() { return std::tuple{Field{"value", &Constant::value}}; }
    double median() const { return value; }
    Support support() const { return {value, value, false, false}; }
    std::vector<double> levels() const { return {value}; }
    double draw(Philox&, std::uint64_t) const { return value; }
    bool operator==(const Constant&) const = default;
};

}  // namespace gearpod::mc
