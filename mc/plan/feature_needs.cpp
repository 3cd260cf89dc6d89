#include "mc/plan/feature_needs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "mc/plan/scene_error.hpp"

namespace gearpod::mc {
std::string RecordLength::text() const {
    return seconds ? fmt::format("{:g} s", *seconds)
                   : fmt::format("{:g} carrier turns", *carrier_turns);
}

RecordLength record_length(const Study& study) {
    return {"sensor", study.sensor.record_s, study.sensor.record_turns};
}

bool has_record_length(const Study& study) {
    return record_length(study).given();
}

RecordLength life_record_length(const Study& study) {
    const RecordLength own{"life", study.life.record_s, study.life.record_turns};
    return own.given() ? own : record_length(study);
}

namespace {

double meshes_of_record(const RecordLength& length, const signals::SpanLayout& span,
                        double mesh_frequency_Hz) {
    return length.seconds ? *length.seconds * mesh_frequency_Hz
                          : *length.carrier_turns * span.carrier_meshes;
}

// Throws SceneError if features need longer records than these.
void check_covered_features(const Study& study, const FeaturePlan& features, int meshes) {
    std::vector<std::string> names;
    int needed = 0;
    for (const features::Feature* feature : features.used) {
        const int least = features.least_meshes(*feature);
        if (least > meshes) {
            names.push_back(fmt::format("\"{}\"", feature->name));
            needed = std::max(needed, least);
        }
    }
    if (!names.empty()) {
        const RecordLength length = record_length(study);
        throw SceneError("features.use",
                         fmt::format("{} need{} {} mesh periods, but a record has {} (sensor.{})",
                                     fmt::join(names, ", "), names.size() == 1 ? "s" : "", needed,
                                     meshes, length.key()),
                         "remove them, or record longer");
    }
}

}  // namespace

int whole_turns(const RecordLength& length, const signals::SpanLayout& span,
                double mesh_frequency_Hz) {
    const double turns = meshes_of_record(length, span, mesh_frequency_Hz) / span.planet_teeth;
    return static_cast<int>(std::min(1e6, turns + 1e-9));
}

void check_record_length(const RecordLength& length, const signals::SpanLayout& span,
                         double mesh_frequency_Hz) {
    const std::string key = length.section + "." + length.key();
    if (length.carrier_turns && span.carrier_meshes == 1) {
        throw SceneError(key, "the carrier stands still", "use record_s");
    }
    if (whole_turns(length, span, mesh_frequency_Hz) < kLeastRecordTurns) {
        const double least = kLeastRecordTurns * span.planet_teeth;
        throw SceneError(
            key,
            fmt::format("{:.1f} mesh periods, but windows repeat every {}",
                        meshes_of_record(length, span, mesh_frequency_Hz), span.planet_teeth),
            fmt::format("give at least {} of these, {:.3g} {}", kLeastRecordTurns,
                        least / (length.seconds ? mesh_frequency_Hz : double(span.carrier_meshes)),
                        length.seconds ? "s" : "turns"));
    }
}

int signal_meshes(const Study& study, const FeaturePlan& features, double mesh_frequency_Hz) {
    const RecordLength length = record_length(study);
    if (!length.given()) {
        return features.signal_meshes;
    }
    const signals::SpanLayout& span = features.span;
    constexpr int kMostSpans = 100;
    check_record_length(length, span, mesh_frequency_Hz);
    const int turns = whole_turns(length, span, mesh_frequency_Hz);
    if (turns > kMostSpans * span.ring_teeth) {
        throw SceneError("sensor." + std::string(length.key()),
                         fmt::format("is more than {} times the {} mesh periods after which all "
                                     "teeth have met",
                                     kMostSpans, span.meshes()),
                         "shorten the record");
    }
    const int meshes = turns * span.planet_teeth;
    check_covered_features(study, features, meshes);
    return span.meshes() + meshes;
}

}  // namespace gearpod::mc
