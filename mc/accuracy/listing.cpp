#include "mc/accuracy/listing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "mc/numerics/ladder.hpp"
#include "mc/study/fluctuations.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// Candidates have up to this many times the steps of an integrator's own rule, which aims at 0.1 %.
constexpr double kBeyondOwnRule = 1.5;
// Only three graded grids are measured, because each one costs a pilot. None is made if its fewest
// steps would cost more than this many times the least expensive integrator's own steps.
constexpr double kGridTolerances[] = {1e-2, 1e-3, 1e-4};
constexpr double kWorthGrading = 3.0;

// Cost of the integrator's own uniform steps, in rk4 steps.
double own_cost(const Study& study, const Flight& flight) {
    const auto cost = step_cost(study, flight.integrator, flight.other);
    return cost && flight.own_steps > 0 ? *cost * flight.own_steps : INFINITY;
}

void add_graded(const Study& study, const Flight& flight, double least_cost,
                std::vector<ListedRung>& all) {
    const double over = kFewestGraded * own_cost(study, flight) / least_cost;
    if (over > kWorthGrading) {
        all.push_back({{flight.integrator, 0, study.numerics.settle_tolerance, flight.other},
                       fmt::format("not tried: an eighth of its {} uniform steps would cost {:.0f} "
                                   "times as much as the steps of the least expensive integrator",
                                   flight.own_steps, over)});
        return;
    }
    for (std::size_t i = 0; i < flight.size(); ++i) {
        if (std::find(std::begin(kGridTolerances), std::end(kGridTolerances),
                      flight.grid_tolerances[i]) != std::end(kGridTolerances)) {
            all.push_back({flight.rung(i, settle_tolerances().front()), ""});
        }
    }
}

}  // namespace

Study without_steps(const Study& study) {
    Study free = study;
    free.numerics.integrator.reset();
    free.numerics.steps_per_mesh = 0;
    return free;
}

std::vector<ListedRung> listed_rungs(const Study& study) {
    const std::vector<Flight> all_flights = flights(without_steps(study), kBeyondOwnRule);
    double least_cost = INFINITY;
    for (const Flight& flight : all_flights) {
        least_cost = flight.graded() ? least_cost : std::min(least_cost, own_cost(study, flight));
    }
    std::vector<ListedRung> all{{own_rung(study), ""}};
    for (const Flight& flight : all_flights) {
        if (flight.graded()) {
            add_graded(study, flight, least_cost, all);
            continue;
        }
        if (flight.size() == 0) {
            all.push_back({{flight.integrator, 0, study.numerics.settle_tolerance, flight.other},
                           flight.refusal});
        }
        for (std::size_t i = 0; i < flight.size(); ++i) {
            all.push_back({flight.rung(i, settle_tolerances().front()), ""});
        }
    }
    if (study.numerics.horizon == Horizon::superpose || why_no_mesh_repeats(study).empty()) {
        all.push_back({own_rung(study), ""});
        all.back().rung.other.push_back("numerics.horizon=march");
    }
    return all;
}

bool marches_everything(const Rung& rung) {
    return !rung.other.empty() && rung.other.back() == "numerics.horizon=march";
}

std::size_t place_of(const Rung& rung, const std::vector<RungResult>& rungs) {
    const auto same = std::find_if(rungs.begin(), rungs.end(), [&](const RungResult& r) {
        return r.rung.text() == rung.text();
    });
    return static_cast<std::size_t>(same - rungs.begin());
}

std::vector<std::size_t> cheapest_first(const Study& study, const std::vector<RungResult>& rungs,
                                        std::size_t from) {
    std::vector<std::pair<double, std::size_t>> costs;
    for (std::size_t i = from; i < rungs.size(); ++i) {
        const Rung& rung = rungs[i].rung;
        const auto step = step_cost(study, rung.integrator, rung.other);
        const double cost = step && rung.steps > 0 ? *step * rung.steps : INFINITY;
        costs.emplace_back(i == 0 ? 0.0 : cost, i);
    }
    std::sort(costs.begin(), costs.end());
    std::vector<std::size_t> places;
    for (const auto& [cost, place] : costs) {
        places.push_back(place);
    }
    return places;
}

}  // namespace gearpod::mc
