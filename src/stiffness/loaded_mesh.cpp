#include "stiffness/loaded_mesh.hpp"

#include <algorithm>
#include <boost/math/quadrature/gauss.hpp>
#include <cmath>
#include <limits>
#include <utility>

#include "stiffness/teeth/position_range.hpp"

namespace gearpod::stiffness {

namespace {

using SlicePoints = boost::math::quadrature::gauss<double, 20>;

// f(x, weight) at the points of [-1, 1], ascending.
template <class F>
void for_slice_points(const F& f) {
    const auto& x = SlicePoints::abscissa();
    const auto& w = SlicePoints::weights();
    for (std::size_t i = x.size(); i-- > 0;)
        f(-x[i], w[i]);
    for (std::size_t i = 0; i < x.size(); ++i)
        f(x[i], w[i]);
}

}  // namespace

LoadedMesh::LoadedMesh(const MeshStiffness& mesh, std::function<double(double)> gap,
                       std::vector<double> kinks, double force_N, double crowning_m)
    : mesh_(mesh),
      slice_(mesh.slice()),
      gap_(std::move(gap)),
      force_(force_N),
      crowning_(crowning_m),
      overlap_(mesh.contact_ratio() - slice_.contact_ratio()),
      slice_phases_(slice_.transitions()),
      phases_(mesh.transitions()) {
    for (const double kink : kinks) {
        slice_phases_.push_back(kink - std::floor(kink));
        for (const double at : {kink, kink + overlap_})
            phases_.push_back(at - std::floor(at));
    }
    sort_positions(slice_phases_);
    sort_positions(phases_);
}

// The approach that F asks for: with the pairs of the smallest gaps first, the first number of them
// that the next one would not join.
double LoadedMesh::approach_of(std::vector<TouchingPair> pairs, double force) {
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

void LoadedMesh::add_slice(double tau, double inside, double part, double gap,
                           std::vector<TouchingPair>& pairs) const {
    double total = 0;
    slice_.total({&tau, 1}, inside, {&total, 1});
    // Pairs that stand at tau + age, youngest first.
    for (int age = -static_cast<int>(std::floor(inside)); inside + age < slice_.contact_ratio();
         ++age) {
        const double position = tau + age;
        double share = 0;
        slice_.share({&position, 1}, inside + age, {&share, 1});
        if (share > 0) {
            pairs.push_back({part * (share * total), gap_(position) + gap});
        }
    }
}

void LoadedMesh::add_slices(double begin, double end, double tau,
                            std::vector<TouchingPair>& pairs) const {
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    for_slice_points([&](double x, double weight) {
        const double at = middle + half * x;
        const double from_middle = 2 * (tau - at) / overlap_ - 1;  // of the width: -1 to 1
        add_slice(at, middle, weight * half / overlap_, crowning_ * from_middle * from_middle,
                  pairs);
    });
}

double LoadedMesh::approach(double tau, double inside) const {
    std::vector<TouchingPair> pairs;
    if (overlap_ > 0) {
        std::vector<double> ends{tau - overlap_};
        for (double period = std::floor(ends[0]); period <= tau; ++period)
            for (const double phase : slice_phases_)
                if (const double at = period + phase; at > ends[0] && at < tau)
                    ends.push_back(at);
        ends.push_back(tau);
        for (std::size_t i = 0; i + 1 < ends.size(); ++i)
            add_slices(ends[i], ends[i + 1], tau, pairs);
    } else if (crowning_ > 0) {
        for_slice_points([&](double x, double weight) {
            add_slice(tau, inside, 0.5 * weight, crowning_ * x * x, pairs);
        });
    } else {
        add_slice(tau, inside, 1, 0, pairs);
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
