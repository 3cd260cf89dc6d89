#include "mc/plan/feature_needs.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "mc/plan/scene_error.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {
namespace {

using features::Gear;
using features::SignalSet;

// Signals of folded records.
constexpr SignalSet kFolded =
    SignalSet::of<features::TeTurn, features::SensorPower, features::ToothRms<Gear::planet>,
                  features::TeParts, features::HealthyRecords>();

}  // namespace

std::vector<const features::Feature*> used_features(const Study& study) {
    std::vector<const features::Feature*> used;
    for (const std::string& name : study.features.use) {
        const features::Feature* feature = find_feature(study, name);
        if (feature == nullptr) {
            throw std::invalid_argument("unknown feature " + name);
        }
        used.push_back(feature);
    }
    return used;
}

SignalSet needs_of(std::span<const features::Feature* const> features) {
    const ComparedNeeds needs = compared_needs(features);
    SignalSet all = needs.record;
    all |= needs.change;
    return all;
}

ComparedNeeds compared_needs(std::span<const features::Feature* const> features) {
    ComparedNeeds needs;
    for (const features::Feature* feature : features) {
        switch (feature->baseline_use) {
            case features::BaselineUse::nothing:
                needs.record |= feature->needs;
                break;
            case features::BaselineUse::change:
                needs.record |= SignalSet::of<features::SensorSamples>();
                needs.baseline |= SignalSet::of<features::SensorSamples>();
                needs.change |= feature->needs;
                break;
            case features::BaselineUse::record_and_change:
                needs.record |= feature->needs;
                needs.record |= SignalSet::of<features::SensorSamples>();
                needs.baseline |= SignalSet::of<features::SensorSamples>();
                needs.change |= feature->needs;
                break;
            case features::BaselineUse::baseline:
                needs.record |= feature->needs;
                needs.baseline |= feature->needs;
                break;
        }
    }
    return needs;
}

bool needs_samples(SignalSet needs) {
    return !needs.within(kFolded);
}

int meshes_needed(const Study& study, const signals::SpanLayout& span, SignalSet needs) {
    int meshes = span.meshes();
    if (needs.has<features::ToothRms<Gear::sun>, features::ToothMoments<Gear::sun>>()) {
        meshes = std::max(meshes, central_turns(span, *teeth_of(study, Member::sun)).meshes());
    }
    if (needs.has<features::ToothRms<Gear::ring>, features::ToothMoments<Gear::ring>>()) {
        meshes = std::max(meshes, central_turns(span, *teeth_of(study, Member::ring)).meshes());
    }
    return meshes;
}

signals::GearTurns central_turns(const signals::SpanLayout& span, int teeth) {
    const auto turns = signals::turns_of_span(teeth, span.carrier_meshes, span.meshes());
    return turns.turns > 0 ? turns : signals::fewest_turns(teeth, span.carrier_meshes);
}

int least_meshes(const features::Feature& feature, const Study& study,
                 const signals::SpanLayout& span) {
    // Cyclic statistics of the samples tell the lines of the planet turn from their neighbours.
    if (feature.needs.has<features::SensorSamples>() && feature.needs.has<features::SensorTurn>()) {
        return kLeastRecordTurns * span.planet_teeth;
    }
    return feature.needs.overlaps(features::kCentralGears) ||
                   feature.needs.has<features::FilteredSensor>()
               ? meshes_needed(study, span, feature.needs)
               : span.planet_teeth;
}

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
void check_covered_features(const Study& study, const signals::SpanLayout& span, int meshes) {
    std::vector<std::string> names;
    int needed = 0;
    for (const features::Feature* feature : used_features(study)) {
        const int least = least_meshes(*feature, study, span);
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

int signal_meshes(const Study& study, const signals::SpanLayout& span, double mesh_frequency_Hz) {
    const int of_features = meshes_needed(study, span, needs_of(used_features(study)));
    const RecordLength length = record_length(study);
    if (!length.given()) {
        return of_features;
    }
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
    check_covered_features(study, span, meshes);
    return span.meshes() + meshes;
}

}  // namespace gearpod::mc
