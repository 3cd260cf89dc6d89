#include "mc/plan/rare_event_studies.hpp"

#include "mc/study/schema/sizes.hpp"

namespace gearpod::mc {
namespace {

Study of_feature(const Study& study, const std::string& feature, double noise_level) {
    Study restricted = study;
    restricted.features.use = {feature};
    restricted.sensor.noise_levels = {noise_level};
    restricted.ensemble.until = {};
    return restricted;
}

Study with_fault(const Study& study, double size) {
    Study restricted = study;
    const std::string key = fault_size_key(study).path();
    std::erase_if(restricted.random, [&](const RandomInput& input) { return input.key == key; });
    std::erase_if(restricted.correlations,
                  [&](const Correlation& pair) { return pair.first == key || pair.second == key; });
    set_fault_size(restricted, size);
    restricted.detection.size_edges_m.clear();
    restricted.detection.size_edges.clear();
    return restricted;
}

}  // namespace

Study study_for_miss_rate(const Study& study, const MissRateRequest& request) {
    Study restricted =
        with_fault(of_feature(study, request.feature, request.noise_level), request.size);
    restricted.ensemble.instances = request.gearboxes;
    restricted.ensemble.threshold_records = request.records;
    restricted.ensemble.importance_sampling = true;
    return restricted;
}

analysis::Alarm RareRateRequest::towards() const {
    const analysis::Alarm alarm = features::find_feature(feature)->alarm;
    return rate ? alarm : analysis::opposite(alarm);
}

Study study_for_rare_rate(const Study& study, const RareRateRequest& request) {
    Study restricted = of_feature(study, request.feature, request.noise_level);
    if (!request.rate) {
        restricted = with_fault(restricted, request.size);
    }
    restricted.ensemble.instances = request.gearboxes;
    restricted.ensemble.threshold_records = 1;
    restricted.ensemble.importance_sampling.reset();
    restricted.ensemble.sampling = SamplingKind::plain;
    return restricted;
}

}  // namespace gearpod::mc
