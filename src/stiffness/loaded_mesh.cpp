#include "stiffness/loaded_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "stiffness/teeth/position_range.hpp"

namespace gearpod::stiffness {

namespace {

struct TouchingPair {
    double stiffness, gap;
};

// The approach that F asks for: with the pairs of the smallest gaps first, the first number of them
// that the next one would not join.
double approach_of(std::vector<TouchingPair> pairs, double force) {
    std::sort(pairs.begin(), pairs.end(),
              [](const auto& a, const auto& b) { return a.gap < b.gap; });
    double stiffness = 0, preload = 0;
    for (std::size_t n = 0; n < pairs.size(); ++n) {
        stiffness += pairs[n].stiffness;
        preload += pairs[n].stiffness * pairs[n].gap;
        const double d = (force + preload) / stiffness;
        if (n + 1 == pairs.size() || d <= pairs[n + 1].gap) {
            return d;
        }
    }
    return std::numeric_limits<double>::infinity();
}

}  // namespace

LoadedMesh::LoadedMesh(const MeshStiffness& mesh, std::function<double(double)> gap,
                       std::vector<double> kinks, double force_N)
    : mesh_(mesh), gap_(std::move(gap)), force_(force_N), phases_(mesh.transitions()) {
    for (const double kink : kinks) {
        phases_.push_back(kink - std::floor(kink));
    }
    std::sort(phases_.begin(), phases_.end());
    phases_.erase(std::unique(phases_.begin(), phases_.end(),
                              [](double a, double b) { return b - a < kPositionTolerance; }),
                  phases_.end());
}

double LoadedMesh::approach(double tau, double inside) const {
    double total = 0;
    mesh_.total({&tau, 1}, inside, {&total, 1});
    std::vector<TouchingPair> pairs;
    // Pairs that stand at tau + age, youngest first.
    for (int age = -static_cast<int>(std::floor(inside)); inside + age < mesh_.contact_ratio();
         ++age) {
        const double position = tau + age;
        double share = 0;
        mesh_.share({&position, 1}, inside + age, {&share, 1});
        if (share > 0) {
            pairs.push_back({share * total, gap_(position)});
        }
    }
    return approach_of(std::move(pairs), force_);
}

double LoadedMesh::error(double tau, double inside) const {
    double total = 0;
    mesh_.total({&tau, 1}, inside, {&total, 1});
    return approach(tau, inside) - force_ / total;
}

double LoadedMesh::error_rate(double tau, double inside) const {
    // The error is smooth but for kinks; a third-order rounding error is far below what a stage
    // node's damping feels.
    constexpr double kStep = 1e-5;
    const double towards = tau < inside ? 1 : -1;
    return towards * (error(tau + towards * kStep, inside) - error(tau, inside)) / kStep;
}

LoadedMesh::Range LoadedMesh::range() const {
    constexpr int kPoints = 64;  // a piece
    Range range{std::numeric_limits<double>::infinity(), 0, 0};
    for (std::size_t i = 0; i < phases_.size(); ++i) {
        const double begin = phases_[i], end = i + 1 < phases_.size() ? phases_[i + 1] : 1;
        const double inside = 0.5 * (begin + end);
        for (int p = 0; p <= kPoints; ++p) {
            const double d = approach(begin + (end - begin) * p / kPoints, inside);
            range.least = std::min(range.least, d);
            range.largest = std::max(range.largest, d);
            const double weight = p == 0 || p == kPoints ? 0.5 : 1.0;
            range.mean += weight * d * (end - begin) / kPoints;
        }
    }
    return range;
}

}  // namespace gearpod::stiffness
