// Features of one recorded signal, and their comparison with healthy gearboxes.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "mc/recordings/measured_features.hpp"
#include "mc/recordings/population.hpp"

namespace gearpod::mc {

struct SignalRequest {
    SignalSource signal;
    SignalColumns columns;
    std::vector<SignalSource> healthy;  // recordings of healthy gearboxes
    SignalSource baseline;              // earlier recording of the same gearbox; empty: none
    double noise_level = 1.0;           // of simulated healthy gearboxes, used without `healthy`
    std::string against;                // results file of healthy gearboxes; "": none
    std::string feature;                // decides the alarm; "": the best ranked one in `against`
};

struct SignalFeatures {
    MeasuredSignal signal;
    Measurement measured;
    // Healthy gearboxes of a results file, and the decisions, which point into them.
    struct Against {
        Population population;
        PopulationDecisions decided;
    };
    std::optional<Against> against;
    // Statements of the recordings that are not used, and assumptions (MeasuredSignal).
    std::vector<std::string> notes;
    signals::SpanLayout span;  // of the study

    int planet_turns() const { return signal.planet_turns(span); }
};

// Throws SignalError with one line per problem, or if no feature can be computed; other exceptions
// for a results file that cannot be used.
SignalFeatures signal_features(const SignalRequest& request, const TilePlan& tile);

// The same as JSON; `features --json` writes it.
nlohmann::ordered_json signal_features_json(const SignalFeatures& features,
                                            const SignalRequest& request);

}  // namespace gearpod::mc
