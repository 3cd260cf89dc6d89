#include "stiffness/pair_gap.hpp"

#include <cmath>
#include <vector>

#include "stiffness/mesh_stiffness.hpp"
#include "stiffness/teeth/positions.hpp"

namespace gearpod::stiffness {

namespace {

constexpr double kSideOffset = 4 * kPositionTolerance;

// True if starts and ends of paths coincide, so that the pairs that join and leave cannot be
// distinguished.
bool whole(double contact_ratio) {
    return std::abs(contact_ratio - std::round(contact_ratio)) < 10 * kSideOffset;
}

}  // namespace

bool NominalPairs::fault_passes(double inside) const {
    return faulty_ && inside > 0 && inside < faulty_->duration();
}

void NominalPairs::total(std::span<const double> tau, double inside,
                         std::span<double> stiffness) const {
    if (fault_passes(inside)) {
        faulty_->total(tau, inside, stiffness);
    } else {
        spur_.total(tau, inside, stiffness);
    }
}

void NominalPairs::pair(int tooth, std::span<const double> tau, double inside,
                        std::span<double> stiffness) const {
    if (fault_passes(inside)) {
        faulty_->tooth_pair(tooth, tau, inside, stiffness);
        return;
    }
    std::vector<double> shifted(tau.begin(), tau.end());
    for (double& position : shifted) {
        position -= tooth;
    }
    spur_.slice_stiffness(0, shifted, inside - tooth, stiffness);
}

double PathExtension::weight(double tau) const {
    if (tau >= 0 && tau <= contact_ratio()) {
        return 1;
    }
    const double gap = gears::corner_gap(geometry_, tau);
    const double left = gap < approach_ ? 1 - gap / approach_ : 0;
    return left * left;
}

double ExtendedPairs::pair_at(int tooth, double tau, double inside) const {
    double value = 0;
    pairs_.pair(tooth, {&tau, 1}, inside, {&value, 1});
    return value;
}

double ExtendedPairs::total_at(double tau, double inside) const {
    double value = 0;
    pairs_.total({&tau, 1}, inside, {&value, 1});
    return value;
}

ExtendedPairs::Change ExtendedPairs::make_change(int tooth, bool joins) const {
    const double ratio = extension_.contact_ratio();
    const double position = joins ? tooth : tooth + ratio;
    const double with = joins ? position + kSideOffset : position - kSideOffset;
    const double without = joins ? position - kSideOffset : position + kSideOffset;
    Change change;
    change.pair = pair_at(tooth, position, with);
    if (whole(ratio)) {
        change.added = change.pair;
        return change;
    }
    change.added = std::max(0.0, total_at(position, with) - total_at(position, without));
    for (int other = tooth - static_cast<int>(ratio) - 1; other < position; ++other) {
        if (other == tooth || other + ratio <= position) {
            continue;
        }
        const double before = pair_at(other, position, without);
        change.others[other] = before > 0 ? pair_at(other, position, with) / before : 1;
    }
    return change;
}

const ExtendedPairs::Change& ExtendedPairs::change(int tooth, bool joins) {
    const auto key = std::pair{tooth, joins};
    auto known = changes_.find(key);
    if (known == changes_.end()) {
        known = changes_.emplace(key, make_change(tooth, joins)).first;
    }
    return known->second;
}

// Applies the effect of a pair near its path's end to another pair on its path.
void ExtendedPairs::apply(int tooth, int other, bool joins, std::span<const double> tau,
                          std::span<double> values) {
    const auto& factors = change(other, joins).others;
    const auto factor = factors.find(tooth);
    if (factor == factors.end()) {
        return;
    }
    for (std::size_t i = 0; i < tau.size(); ++i) {
        values[i] *= 1 + extension_.weight(tau[i] - other) * (factor->second - 1);
    }
}

void ExtendedPairs::stiffness(int tooth, std::span<const double> tau, std::span<double> values) {
    const double ratio = extension_.contact_ratio();
    const double middle = tau[tau.size() / 2];
    if (middle < tooth || middle > tooth + ratio) {
        const Change& end = change(tooth, middle < tooth);
        std::transform(tau.begin(), tau.end(), values.begin(), [&](double position) {
            return end.stiffness(extension_.weight(position - tooth));
        });
        return;
    }
    pairs_.pair(tooth, tau, middle, values);
    const int reach = static_cast<int>(std::ceil(ratio));
    for (int other = tooth - reach; other <= tooth + reach; ++other) {
        if (other != tooth && other > middle && other - extension_.fade().before < middle) {
            apply(tooth, other, true, tau, values);
        }
        if (other != tooth && other + ratio < middle &&
            middle < other + ratio + extension_.fade().after) {
            apply(tooth, other, false, tau, values);
        }
    }
}

}  // namespace gearpod::stiffness
