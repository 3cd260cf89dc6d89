#include "lockstep/steps/graded_grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "lockstep/tile/rigid_rotation.hpp"
#include "lockstep/tile/tile_integrators.hpp"

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

constexpr auto kLanes = static_cast<std::size_t>(kPilotLanes);

class PilotIntegration {
  public:
    PilotIntegration(const Pilot& pilot, PhaseGrid grid)
        : pilot_(pilot),
          plan_(in_double_precision(pilot.plan(std::move(grid)))),
          integrator_(make_mesh_integrator<kPilotLanes>(plan_, pilot.inputs)),
          rotation_(plan_.layout, pilot.inputs),
          periodic_(FaultSchedule(plan_, pilot.faults).periodic_overrides()) {}

    TileState periodic_orbit() const {
        TileState state = equilibrium_state(plan_, pilot_.inputs);
        MeshRecord scratch = make_record(plan_, kPilotLanes, false);
        for (int mesh = 0; mesh < pilot_.convergence_meshes; ++mesh) {
            step(periodic_, state, scratch);
        }
        return state;
    }

    // Records from the periodic orbit: a healthy mesh period, those of the fault's first passage,
    // and one more.
    std::vector<MeshRecord> records(TileState state) const {
        FaultSchedule schedule(plan_, pilot_.faults);
        std::vector<MeshRecord> all;
        const auto add = [&](const MeshOverrides& overrides) {
            all.push_back(make_record(plan_, kPilotLanes, false));
            step(overrides, state, all.back());
        };
        add(periodic_);
        if (pilot_.faults.pattern.passages.empty()) {
            return all;
        }
        const int length = pilot_.faults.pattern.length;
        int k = static_cast<int>(std::floor(pilot_.faults.pattern.passages[0].start));
        for (int last = k + length; k < last; ++k) {
            add(schedule.all_overrides(k));
            if (!schedule.continues_after(k)) {
                break;
            }
        }
        add(schedule.all_overrides(k + 1));
        return all;
    }

  private:
    void step(const MeshOverrides& overrides, TileState& state, MeshRecord& record) const {
        (*integrator_)(overrides, state, record);
        rotation_.remove(state);
    }

    const Pilot& pilot_;
    const IntegrationPlan plan_;
    const std::unique_ptr<const MeshIntegrator<kPilotLanes>> integrator_;
    const RigidRotation rotation_;
    const MeshOverrides periodic_;
};

// Squared deviation of a lane's values from others, and of themselves from 0 or from their mean.
struct Squares {
    double deviation = 0.0, size = 0.0;
};
Squares squares(const machine::AlignedVector& values, const machine::AlignedVector& other,
                LaneId lane, bool about_mean) {
    double mean = 0.0;
    const double count = static_cast<double>(values.size() / kLanes);
    for (auto i = static_cast<std::size_t>(lane); about_mean && i < values.size(); i += kLanes) {
        mean += values[i] / count;
    }
    Squares s;
    for (auto i = static_cast<std::size_t>(lane); i < values.size(); i += kLanes) {
        s.deviation += (values[i] - other[i]) * (values[i] - other[i]);
        s.size += (values[i] - mean) * (values[i] - mean);
    }
    return s;
}

double relative(const Squares& s) {
    return s.size > 0.0 ? std::sqrt(s.deviation / s.size) : 0.0;
}

// Relative rms difference of the worst lane; NaN counts as infinite.
double difference(const std::vector<MeshRecord>& a, const std::vector<MeshRecord>& b) {
    double worst = 0.0;
    for (LaneId lane{0}; lane < kLanes; ++lane) {
        Squares sensor, te;
        for (std::size_t r = 0; r < a.size(); ++r) {
            const Squares x = squares(a[r].acceleration, b[r].acceleration, lane, false);
            const Squares y = squares(a[r].te, b[r].te, lane, true);
            sensor = {sensor.deviation + x.deviation, sensor.size + x.size};
            te = {te.deviation + y.deviation, te.size + y.size};
        }
        const double error = std::max(relative(sensor), relative(te));
        worst =
            std::isfinite(error) ? std::max(worst, error) : std::numeric_limits<double>::infinity();
    }
    return worst;
}

bool coarser(const Grading& a, const Grading& b) {
    return a.first >= b.first && a.growth >= b.growth && a.longest >= b.longest;
}

struct Candidate {
    Grading grading;
    std::size_t steps;
};

// Uniform steps of that length and all coarser gradings, fewest steps first.
std::vector<Candidate> candidates(double step,
                                  const std::function<PhaseGrid(const Grading&)>& grid_of) {
    std::vector<Candidate> all;
    const auto add = [&](const Grading& grading) {
        all.push_back({grading, grid_of(grading).steps.size()});
    };
    add({step, 0.0, step});
    for (const double first : {step, 2.0 * step, 4.0 * step}) {
        for (const double ratio : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
            for (int halvings = 0; halvings <= 6; ++halvings) {
                add({first, std::ldexp(1.0, -halvings), first * ratio});
            }
        }
    }
    std::stable_sort(all.begin(), all.end(),
                     [](const Candidate& a, const Candidate& b) { return a.steps < b.steps; });
    return all;
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

GradedChoice choose_grading(const Pilot& pilot, double step, double tolerance,
                            const std::function<PhaseGrid(const Grading&)>& grid_of) {
    constexpr int kMostHalvings = 3;
    GradedChoice best;
    for (int halving = 0; halving <= kMostHalvings; ++halving, step /= 2.0) {
        const PilotIntegration fine(pilot, grid_of({step / 2.0, 0.0, step / 2.0}));
        const TileState periodic_orbit = fine.periodic_orbit();
        const std::vector<MeshRecord> reference = fine.records(periodic_orbit);
        const auto error_of = [&](const PhaseGrid& grid) {
            return difference(reference, PilotIntegration(pilot, grid).records(periodic_orbit));
        };
        best.grading = {step, 0.0, step};
        best.grid = grid_of(best.grading);
        best.error = error_of(best.grid);
        if (!(best.error <= tolerance)) {
            continue;
        }
        best.reached = true;
        std::vector<Grading> failed;
        for (const Candidate& candidate : candidates(step, grid_of)) {
            if (std::any_of(failed.begin(), failed.end(), [&](const Grading& grading) {
                    return coarser(candidate.grading, grading);
                })) {
                continue;
            }
            PhaseGrid grid = grid_of(candidate.grading);
            const double error = error_of(grid);
            if (error <= tolerance) {
                return {std::move(grid), candidate.grading, error, true};
            }
            failed.push_back(candidate.grading);
        }
        return best;
    }
    return best;
}

}  // namespace gearpod::lockstep
