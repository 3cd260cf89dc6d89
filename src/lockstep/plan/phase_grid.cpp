#include "lockstep/plan/phase_grid.hpp"

#include <stdexcept>

namespace gearpod::lockstep {

PhaseGrid make_phase_grid(int samples, int steps_per_mesh, std::span<const double> transitions) {
    if (samples < 1 || steps_per_mesh < 1) {
        throw std::invalid_argument("a phase grid needs at least one sample and one step");
    }
    const int per_sample = (steps_per_mesh + samples - 1) / samples;
    const int count = per_sample * samples;
    std::vector<double> cuts(transitions.begin(), transitions.end());
    std::sort(cuts.begin(), cuts.end());

    PhaseGrid grid;
    grid.samples = samples;
    grid.lengths.push_back(1.0 / count);
    auto cut = cuts.begin();
    for (int i = 0; i < count; ++i) {
        double start = static_cast<double>(i) / count;
        const double end = static_cast<double>(i + 1) / count;
        int sample = i % per_sample == 0 ? i / per_sample : -1;
        const auto add = [&](double to) {
            const double length = to - start;
            grid.steps.push_back({start, length, find_or_add(grid.lengths, length), sample});
            start = to;
            sample = -1;
        };
        for (; cut != cuts.end() && *cut < end - kSamePhase; ++cut) {
            if (*cut > start + kSamePhase) {
                add(*cut);
            }
        }
        add(end);
    }
    return grid;
}

}  // namespace gearpod::lockstep
