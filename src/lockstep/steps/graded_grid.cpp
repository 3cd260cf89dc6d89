#include "lockstep/steps/graded_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "lockstep/plan/step_kinds.hpp"

namespace gearpod::lockstep {
namespace {

// Distinct nodes at the transitions and at the ends of the mesh period, ascending.
std::vector<double> stretch_ends(std::span<const double> transitions) {
    std::vector<double> all(transitions.begin(), transitions.end());
    all.push_back(0.0);
    all.push_back(1.0);
    std::sort(all.begin(), all.end());
    std::vector<double> apart;
    for (const double phase : all) {
        if (apart.empty() || phase - apart.back() > kSamePhase) {
            apart.push_back(phase);
        }
    }
    apart.back() = 1.0;
    return apart;
}

void add_step(PhaseGrid& grid, double phase, double length) {
    grid.steps.push_back({phase, length, find_or_add(grid.lengths, length), -1, 0, 0});
}

// Assigns every sample to the step that contains it.
void place_samples(PhaseGrid& grid) {
    auto step = grid.steps.begin();
    for (int sample = 0; sample < grid.samples; ++sample) {
        const double phase = static_cast<double>(sample) / grid.samples;
        while (step + 1 != grid.steps.end() && phase > (step + 1)->phase - kSamePhase) {
            ++step;
        }
        if (phase < step->phase + kSamePhase) {
            step->sample = sample;
        } else {
            step->first_inside = step->inside == 0 ? sample : step->first_inside;
            ++step->inside;
        }
    }
}

}  // namespace

double longest_step(const Grading& grading, double since) {
    return std::min(grading.longest, std::max(grading.first, grading.growth * since));
}

double since_transition(std::span<const double> transitions, double phase) {
    double since = std::numeric_limits<double>::infinity();
    for (const double transition : transitions) {
        const double apart = phase - transition;
        since = std::min(since, apart < -kSamePhase ? apart + 1.0 : std::max(apart, 0.0));
    }
    return since;
}

PhaseGrid make_graded_grid(int samples, std::span<const double> transitions,
                           const Grading& grading) {
    if (samples < 1 || !(grading.first > 0.0 && grading.growth >= 0.0 && grading.longest > 0.0)) {
        throw std::invalid_argument("a graded grid needs at least one sample and positive steps");
    }
    PhaseGrid grid;
    grid.samples = samples;
    const std::vector<double> ends = stretch_ends(transitions);
    for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
        const double since = since_transition(transitions, ends[i]);
        double phase = ends[i];
        while (phase < ends[i + 1]) {
            const double allowed = longest_step(grading, since + (phase - ends[i]));
            const int level = std::max(0, std::ilogb(allowed / grading.first * (1.0 + 1e-9)));
            const double length = std::ldexp(grading.first, level);
            const double left = ends[i + 1] - phase;
            if (left < 1.5 * length) {
                add_step(grid, phase, left);
                break;
            }
            add_step(grid, phase, length);
            phase += length;
        }
    }
    place_samples(grid);
    return grid;
}

}  // namespace gearpod::lockstep
