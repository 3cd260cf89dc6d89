#include "stiffness/helical_slices.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "stiffness/loaded_mesh.hpp"

namespace gearpod::stiffness {

namespace {

constexpr double kSliceTolerance = 1e-10;  // fraction of the largest stiffness or force
constexpr int kPositions = 2000;           // at which an engagement is sampled
constexpr int kContactHalvings = 50;       // of the interval in which a gap is reached
constexpr double kShortestSlice = 1e-9;    // mesh periods
constexpr int kFewestCuts = 8, kMostCuts = 17;
constexpr int kWornParts = 8;  // of the part with small gaps of worn flanks

// Gaps at which the engagement is cut, in nominal approaches, ascending. They are densest near 1,
// where the flanks of most teeth touch; teeth with index errors of half the approach use all.
std::vector<double> cuts_of(int number) {
    constexpr double kLeast = 0.3, kLargest = 3.2;
    const int below = (number - 1) * 9 / 20, above = number - 1 - below;
    std::vector<double> cuts;
    for (int i = below; i > 0; --i)
        cuts.push_back(1 - (1 - kLeast) * std::pow(static_cast<double>(i) / below, 1.2));
    for (int i = 0; i <= above; ++i)
        cuts.push_back(1 + (kLargest - 1) * std::pow(static_cast<double>(i) / above, 2.0));
    return cuts;
}

// Number of cuts for which a gear pair has springs enough. The part with small gaps has `across`
// times `along` of them; parts along the path take the place of cuts.
int number_of_cuts(double contact_ratio, int across, int along) {
    const int pairs = static_cast<int>(std::ceil(contact_ratio));
    return std::clamp(kMostSlicedSprings / pairs - across * along, kFewestCuts,
                      kMostCuts - across * (along - 1));
}

using Factor = std::function<double(double)>;

double sampled_position(double ratio, int i) {
    return ratio * (i + 0.5) / kPositions;
}

RunningIntegral integral_of(const ToothPairCurve& curve, const std::vector<double>& points,
                            const Factor& factor) {
    double largest = 0;
    for (int i = 0; i < kPositions; ++i) {
        const double position = sampled_position(points.back(), i);
        largest = std::max(largest, std::abs(curve(position) * factor(position)));
    }
    return {[&](std::span<const double> positions, double, std::span<double> values) {
                curve(positions, values);
                for (std::size_t i = 0; i < positions.size(); ++i)
                    values[i] *= factor(positions[i]);
            },
            points, kSliceTolerance * largest};
}

double closest_position(const Factor& gap, double ratio) {
    double closest = 0, least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < kPositions; ++i) {
        const double position = sampled_position(ratio, i);
        if (const double value = gap(position); value < least) {
            least = value;
            closest = position;
        }
    }
    return closest;
}

// Approach at which springs of all positions carry the force. They touch together on average over
// a mesh period.
double mean_approach(const ToothPairCurve& curve, const Factor& gap, double ratio,
                     double crowning_m, double force_N) {
    constexpr int kAcross = 16;
    std::vector<ContactSpring> springs;
    for (int i = 0; i < kPositions; ++i) {
        const double position = sampled_position(ratio, i);
        const double k = curve(position) * ratio / (kPositions * kAcross), gap_m = gap(position);
        for (int slice = 0; slice < kAcross; ++slice) {
            const double across = (2 * slice + 1.0) / kAcross - 1;
            springs.push_back({k, gap_m + crowning_m * across * across});
        }
    }
    return approach_of(springs, force_N);
}

}  // namespace

HelicalSlices::HelicalSlices(const ToothPairCurve& curve, const std::vector<double>& points,
                             const PairGap& gap, double overlap_ratio, int across, double force_N)
    : gap_(gap),
      ratio_(points.back()),
      overlap_(overlap_ratio),
      stiffness_{integral_of(curve, points, [](double) { return 1.0; }),
                 integral_of(curve, points, [](double position) { return position; }),
                 integral_of(curve, points, [](double position) { return position * position; })},
      force_(integral_of(curve, points, [this](double position) { return gap_at(position); })),
      flank_position_(integral_of(
          curve, points, [this](double position) { return flank_position_at(position); })) {
    if (gap_.flanks.wear)
        wear_.emplace(
            integral_of(curve, points, [this](double position) { return wear_at(position); }));
    const auto gap_of = [this](double position) { return gap_at(position); };
    const double closest = closest_position(gap_of, ratio_);
    const double approach =
        force_N > 0 ? mean_approach(curve, gap_of, ratio_, gap_.flanks.crowning_m(), force_N)
                    : std::numeric_limits<double>::infinity();
    Positions inner{closest, closest};
    const auto add_around = [&](const Positions& within) {
        add_slice({{{within.begin, inner.begin}, {inner.end, within.end}}}, {});
    };
    const int along = gap_.flanks.wear ? std::max(1, kWornParts / across) : 1;
    for (const double cut : cuts_of(number_of_cuts(ratio_ + overlap_, across, along))) {
        const Positions within{reaches(cut * approach, closest, 0),
                               reaches(cut * approach, closest, ratio_)};
        if (slices_.empty()) {
            const auto cut_at = [&](int part) {
                return part == along ? within.end : within.begin + within.length() * part / along;
            };
            for (int part = 0; part < along; ++part)
                for (int i = 0; i < across; ++i)
                    add_slice({{{cut_at(part), cut_at(part + 1)}, {}}},
                              {static_cast<double>(i) / across, (i + 1.0) / across});
        } else {
            add_around(within);
        }
        inner = within;
    }
    add_around({0, ratio_});
}

double HelicalSlices::gap_at(double position) const {
    return gap_(position - gap_.extension.reach().before, 0);
}

double HelicalSlices::wear_at(double position) const {
    return gap_.wear(position - gap_.extension.reach().before);
}

double HelicalSlices::flank_position_at(double position) const {
    return gap_.flank_position(position - gap_.extension.reach().before);
}

double HelicalSlices::reaches(double gap_m, double closest, double end) const {
    if (gap_at(end) < gap_m)
        return end;
    for (int i = 0; i < kContactHalvings; ++i) {
        const double middle = 0.5 * (closest + end);
        (gap_at(middle) < gap_m ? closest : end) = middle;
    }
    return closest;
}

void HelicalSlices::add_slice(const std::array<Positions, 2>& engaged, const FaceRange& face) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Slice slice{engaged, face, kInfinity, 0, kInfinity, 0};
    for (const Positions& positions : engaged) {
        if (positions.length() < kShortestSlice)
            continue;
        for (int i = 0; i <= kPositions; ++i) {
            const double position = positions.begin + positions.length() * i / kPositions;
            const double gap = gap_at(position), wear = wear_at(position);
            slice.least_gap = std::min(slice.least_gap, gap);
            slice.largest_gap = std::max(slice.largest_gap, gap);
            slice.least_wear = std::min(slice.least_wear, wear);
            slice.largest_wear = std::max(slice.largest_wear, wear);
        }
    }
    if (slice.least_gap <= slice.largest_gap)
        slices_.push_back(slice);
}

HelicalSlices::Positions HelicalSlices::covered(const Slice& slice, const Positions& engaged,
                                                double tau, const FaceRange& part) const {
    const double first = std::max(slice.face.begin, part.begin);
    const double last = std::min(slice.face.end, part.end);
    return {std::max(engaged.begin, tau - overlap_ * last),
            std::min(engaged.end, tau - overlap_ * first)};
}

double HelicalSlices::mean(const RunningIntegral& integral, int slice, double tau,
                           const FaceRange& part) const {
    const Slice& properties = slices_[static_cast<std::size_t>(slice)];
    double sum = 0;
    for (const Positions& engaged : properties.engaged) {
        const Positions contact = covered(properties, engaged, tau, part);
        if (contact.length() < kShortestSlice)
            continue;
        const double ends[] = {contact.begin, contact.end};
        double values[2];
        integral(ends, values);
        sum += values[1] - values[0];
    }
    return sum / (overlap_ * (part.end - part.begin));
}

double HelicalSlices::stiffness(int slice, double tau) const {
    return std::max(0.0, mean(stiffness_[0], slice, tau, {}));
}

// The contact at position s lies at y = (tau - s) / overlap on the face, where crowning is
// C (1 - 2 y)^2.
double HelicalSlices::gap(int slice, double tau) const {
    const Slice& properties = slices_[static_cast<std::size_t>(slice)];
    const double k = stiffness(slice, tau), crowning = gap_.flanks.crowning_m();
    if (k <= 0)
        return properties.largest_gap;
    const double gap =
        std::clamp(mean(force_, slice, tau, {}) / k, properties.least_gap, properties.largest_gap);
    if (crowning == 0)
        return gap;
    const double at_zero = 1 - 2 * tau / overlap_, growth = 2 / overlap_;
    const double first = mean(stiffness_[1], slice, tau, {}) / k;
    const double second = mean(stiffness_[2], slice, tau, {}) / k;
    const double across = at_zero * at_zero + growth * (2 * at_zero * first + growth * second);
    return gap + crowning * std::clamp(across, 0.0, 1.0);
}

double HelicalSlices::wear(int slice, double tau) const {
    if (!wear_)
        return 0;
    const Slice& properties = slices_[static_cast<std::size_t>(slice)];
    const double k = stiffness(slice, tau);
    return k > 0 ? std::clamp(mean(*wear_, slice, tau, {}) / k, properties.least_wear,
                              properties.largest_wear)
                 : properties.largest_wear;
}

double HelicalSlices::flank_position(int slice, double tau) const {
    const auto& engaged = slices_[static_cast<std::size_t>(slice)].engaged;
    const double k = stiffness(slice, tau);
    const double least = flank_position_at(engaged[0].begin);
    const double most = flank_position_at(std::max(engaged[0].end, engaged[1].end));
    return k > 0 ? std::clamp(mean(flank_position_, slice, tau, {}) / k, least, most)
                 : 0.5 * (least + most);
}

double HelicalSlices::on_path(int slice, double tau) const {
    const Slice& properties = slices_[static_cast<std::size_t>(slice)];
    const double begin = gap_.extension.reach().before;
    const double end = begin + gap_.extension.contact_ratio();
    double sum = 0;
    for (const Positions& engaged : properties.engaged) {
        const Positions contact = covered(properties, engaged, tau, {});
        sum += std::max(0.0, std::min(contact.end, end) - std::max(contact.begin, begin));
    }
    return sum / overlap_;
}

std::vector<double> HelicalSlices::changes() const {
    std::vector<double> phases;
    for (const Slice& slice : slices_)
        for (const Positions& engaged : slice.engaged)
            if (engaged.length() >= kShortestSlice)
                for (const double end : {engaged.begin, engaged.end})
                    for (const double face : {slice.face.begin, slice.face.end})
                        phases.push_back(end + overlap_ * face);
    return phases;
}

}  // namespace gearpod::stiffness
