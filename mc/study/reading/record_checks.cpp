// Checks of the distributions in [random] that vary from record to record.
#include <fmt/format.h>

#include "mc/study/reading/parts.hpp"
#include "mc/study/schema/schema.hpp"

namespace gearpod::mc {
namespace {

// Short form of a record distribution: its key and the scatter that it gives.
struct ShortForm {
    std::string key;
    double scatter;
};

ShortForm short_form(const Study& study, RecordQuantity quantity) {
    const Life& life = study.life;
    switch (quantity) {
        case RecordQuantity::torque:
            return life.interval_h ? ShortForm{"life.torque_scatter", life.torque_scatter}
                                   : ShortForm{"features.baseline_torque_scatter",
                                               study.features.baseline_torque_scatter};
        case RecordQuantity::speed:
            return {"life.speed_scatter", life.speed_scatter};
        case RecordQuantity::gain:
            return {"life.gain_scatter", life.gain_scatter};
        case RecordQuantity::noise:
            return {"life.noise_scatter", life.noise_scatter};
    }
    return {};
}

void check_input(StudyDraft& draft, const RandomInput& input) {
    const Study& study = draft.study;
    const auto quantity = record_quantity(input.key);
    const auto reject = [&](const std::string& what, const std::string& remedy) {
        draft.reject(draft.given_random[input.key], "random." + input.key + ".per", what, remedy);
    };
    const Key& key = *find_key(input.key);
    if (!quantity && study.life.interval_h) {
        reject(fmt::format("{} is the same in all records of a life", key.name),
               "remove per; only operation.torque_N_m, a speed, sensor.gain and sensor.noise_m_s2 "
               "can vary from record to record of a life");
    }
    if (quantity && std::get<NumberAccess>(key.access).get(study).value_or(0.0) <= 0.0) {
        reject("needs a nominal value above 0, about which the records scatter",
               fmt::format("give {} in [{}]", key.name, key.section));
    }
    const ShortForm same = quantity ? short_form(study, *quantity) : ShortForm{};
    if (same.scatter > 0.0) {
        reject("conflicts with " + same.key, "give the scatter of records only once");
    }
    if (study.ensemble.threshold_records > 1) {
        draft.reject("ensemble.threshold_records",
                     fmt::format("the {} records of a gearbox differ only in their noise, but {} "
                                 "varies from record to record",
                                 study.ensemble.threshold_records, input.key),
                     "remove threshold_records, or per in [random]");
    }
}

}  // namespace

// Runs only on a study without other problems.
void check_records(StudyDraft& draft) {
    if (!draft.problems.empty()) {
        return;
    }
    for (const RandomInput& input : draft.study.random) {
        if (input.distribution.per_record()) {
            check_input(draft, input);
        }
    }
}

}  // namespace gearpod::mc
