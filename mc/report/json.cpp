#include "mc/report/json.hpp"

#include <nlohmann/json.hpp>

#include "analysis/report/detection_json.hpp"
#include "analysis/report/json_values.hpp"
#include "analysis/report/reliability_json.hpp"
#include "features/feature.hpp"
#include "mc/gearbox/record_window.hpp"
#include "mc/report/example_gearboxes.hpp"
#include "mc/results/numerical_groups.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/study/faults/fault_kind.hpp"
#include "mc/study/noise.hpp"

namespace gearpod::mc {
namespace {

using Json = nlohmann::json;

// Numerical error compared with the statistical one; null if it was not verified.
Json numerical_json(const Results& frame, const std::vector<NumericalContribution>& contributions) {
    if (!frame.numerical) {
        return nullptr;
    }
    Json json{{"setting", frame.numerical->setting},
              {"finer", frame.numerical->finer},
              {"gearboxes", frame.numerical->gearboxes},
              {"healthy_pairs", frame.numerical->healthy_pairs},
              {"faulty_pairs", frame.numerical->faulty_pairs},
              {"shares", Json::array()}};
    for (const NumericalContribution& s : contributions) {
        json["shares"].push_back({{"feature", s.feature},
                                  {"noise_level", s.noise_level},
                                  {"rms", analysis::number(s.rms)},
                                  {"healthy_spread", analysis::number(s.spread)},
                                  {"pd", analysis::number(s.pd)},
                                  {"pd_half_width", analysis::number(s.pd_half_width)},
                                  {"a90", analysis::number(s.a90)},
                                  {"a90_interval", analysis::number(s.a90_interval)},
                                  {"larger", s.numerical_dominates ? "numerical" : "statistical"}});
        if (s.correction) {
            Json& correction = json["shares"].back()["correction"];
            for (const auto& number : kPairedCorrectionNumbers) {
                correction[number.name] = analysis::number((*s.correction).*number.member);
            }
            correction["pd_change"] = analysis::number(s.corrected->pd_change);
            correction["a90"] = analysis::number(s.corrected->a90);
            correction["a90_lower"] = analysis::number(s.corrected->a90_lower);
            correction["a90_upper"] = analysis::number(s.corrected->a90_upper);
        }
    }
    return json;
}

// Contact loss ratio of each mesh; null if teeth cannot separate or an earlier version wrote the
// file.
Json contact_loss_json(const std::vector<ContactLossSummary>& meshes) {
    Json json = Json::array();
    for (const ContactLossSummary& mesh : meshes) {
        json.push_back({{"mesh", mesh.mesh},
                        {"mean", mesh.mean},
                        {"lower", mesh.lower},
                        {"median", mesh.median},
                        {"upper", mesh.upper},
                        {"gearboxes", mesh.rows}});
    }
    return json.empty() ? Json(nullptr) : json;
}

// Error of the time steps where teeth lose contact; null if it was not measured.
Json step_error_json(const Results& frame) {
    if (!frame.step_error) {
        return nullptr;
    }
    Json json;
    for (const auto& one : kStepErrorNumbers) {
        json[one.name] = analysis::number((*frame.step_error).*one.member);
    }
    for (const auto& one : kStepErrorCounts) {
        json[one.name] = (*frame.step_error).*one.member;
    }
    return json;
}

Json change_json(const analysis::NumberDifference& change) {
    return change.refusal.empty() ? Json{{"difference", analysis::number(change.difference())},
                                         {"lower", analysis::number(change.bounds.lower)},
                                         {"upper", analysis::number(change.bounds.upper)}}
                                  : Json(nullptr);
}

// Detection by each sensor and by all together; null with one sensor.
Json sensors_json(const std::vector<SensorDetection>& sensors) {
    Json json = Json::array();
    for (const SensorDetection& one : sensors) {
        json.push_back({{"name", one.name},
                        {"feature", one.feature},
                        {"size", one.smallest ? Json(one.smallest->size) : Json(nullptr)},
                        {"a90", one.change ? change_json(one.change->a90) : Json(nullptr)},
                        {"auc", one.change ? change_json(one.change->auc) : Json(nullptr)}});
    }
    return json.empty() ? Json(nullptr) : json;
}

// Alarms of healthy gearboxes with another fault; null without one.
Json other_fault_json(const Results& frame, const std::vector<OtherFaultAlarms>& alarms) {
    Json json = Json::array();
    for (const OtherFaultAlarms& one : alarms) {
        json.push_back({{"feature", frame.features[one.feature].name},
                        {"noise_level", frame.noise_levels[one.level]},
                        {"alarms", one.alarms},
                        {"tested", one.tested},
                        {"lower", one.interval.lower},
                        {"upper", one.interval.upper},
                        {"without", one.without}});
    }
    return json.empty() ? Json(nullptr) : json;
}

Json features_json(const Results& frame) {
    Json json = Json::array();
    for (const FeatureResult& result : frame.features) {
        const features::Feature* feature = features::find_feature(result.name);
        json.push_back({{"name", result.name},
                        {"title", feature != nullptr ? std::string(feature->title) : ""},
                        {"unit", result.unit},
                        {"alarm", analysis::alarm_name(result.alarm)},
                        {"doc", feature != nullptr ? std::string(feature->doc) : ""}});
    }
    return json;
}

// Noise levels, and the noise that they multiply, if the study can be read.
Json noise_json(const Results& frame, const std::optional<Study>& study) {
    Json json{{"levels", frame.noise_levels},
              {"reference", reference_level(frame.noise_levels)},
              {"sensor_m_s2", nullptr},
              {"encoder_rad", nullptr}};
    if (study) {
        json["encoder_rad"] = study->sensor.encoder_noise_rad;
        if (!study->effects.quasi_static()) {
            json["sensor_m_s2"] = sensor_noise_m_s2(*study);
        }
    }
    return json;
}

}  // namespace

nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability,
                           const RunFindings& run) {
    Json json = examples_json(frame, rows);
    const std::optional<Study>& study = run.study;
    json["title"] = study ? study->title : "";
    json["assumptions"] = study ? run_conditions(*study) : "";
    json["fault"] = study && study->fault.kind ? Json(study->fault.kind->words()) : Json(nullptr);
    json["detection"] = analysis::detection_json(frame.detection, frame.request, subject_of(frame));
    json["reliability"] =
        reliability ? analysis::reliability_json(*reliability, frame.request) : Json(nullptr);
    json["smallest_fault"] =
        analysis::smallest_faults_json(frame.detection, reliability ? &*reliability : nullptr);
    json["findings"] = analysis::findings_json(run.report);
    json["numerical"] = numerical_json(frame, run.numerical);
    json["step_error"] = step_error_json(frame);
    json["contact_loss"] = contact_loss_json(run.contact_loss);
    json["sensors"] = sensors_json(run.sensors);
    json["other_fault"] = other_fault_json(frame, run.other_fault);
    json["features"] = features_json(frame);
    json["noise"] = noise_json(frame, study);
    json["failures"] = failures_json(frame, run.failures);
    json["over_time"] = alarms_json(frame, run.over_time);
    json["monitoring"] = run.monitoring ? monitoring_json(*run.monitoring) : Json(nullptr);
    json["gearboxes"] = json["failures"]["gearboxes"];
    json["failed"] = run.failures.counts.failed();
    json["provenance"] = Json::object();
    for (const auto& [name, value] : frame.provenance) {
        json["provenance"][name] = value;
    }
    json["timing"] = Json::object();
    for (const Timing& timing : frame.timing) {
        json["timing"][timing.name] = timing.seconds;
    }
    return json;
}

nlohmann::json report_json(const Results& frame, const RowSource& rows,
                           const std::optional<analysis::Reliability>& reliability) {
    return report_json(frame, rows, reliability, findings_of_run(frame, rows, reliability));
}

}  // namespace gearpod::mc
