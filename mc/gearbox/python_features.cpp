#include "mc/gearbox/python_features.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <mutex>
#include <nlohmann/json.hpp>
#include <numbers>
#include <set>
#include <utility>

#include "mc/files/python/python_worker.hpp"
#include "mc/input/printable.hpp"
#include "mc/scene/feature_needs.hpp"
#include "mc/study/gears.hpp"

namespace gearpod::mc {

struct PythonFeatures::Request {
    std::vector<double> levels;
    nlohmann::json records = nlohmann::json::array();
};

namespace {

// Properties of a record that are the same at every noise level.
nlohmann::json properties(const Scene& scene, const InstanceInputs& inputs) {
    const Study& study = scene.study();
    nlohmann::json teeth = nlohmann::json::object();
    for (const Member member : kAllMembers) {
        if (const auto count = teeth_of(study, member)) {
            teeth[std::string(member_name(member))] = *count;
        }
    }
    const bool planetary = study.gearbox.kind == GearboxKind::planetary;
    const double mesh_Hz = 1.0 / dynamics::mesh_period_s(scene.inputs(inputs));
    return {{"gear_teeth", scene.span().planet_teeth},
            {"teeth", teeth},
            {"planets", planetary ? study.gearbox.planets : 0},
            {"samples_per_mesh", scene.samples_per_mesh()},
            {"te_samples_per_mesh", scene.te_samples_per_mesh()},
            {"carrier_meshes", scene.path_meshes()},
            {"mesh_Hz", mesh_Hz},
            {"sampling_Hz", mesh_Hz * scene.samples_per_mesh()},
            {"torque_Nm", inputs.torque_N_m},
            {"speed_rpm", inputs.speed_rad_s * 30.0 / std::numbers::pi},
            {"noise_m_s2", inputs.noise_m_s2}};
}

}  // namespace

PythonFeatures::PythonFeatures(const Scene& scene,
                               std::span<const features::Feature* const> features)
    : scene_(scene) {
    for (const features::Feature* feature : features) {
        for (const PythonFeature& one : scene.study().features.python) {
            if (one.feature == feature) {
                used_.push_back(one);
                PythonWorker::of_thread().require(one.file, one.hashes);  // starts Python early
            }
        }
    }
}

void PythonFeatures::add_record(const char* kind, const InstanceInputs& inputs,
                                const features::FeatureInput& input) {
    nlohmann::json arrays = nlohmann::json::array();
    const auto add_signal = [&](const char* name, std::span<const double> signal) {
        if (!signal.empty()) {
            arrays.push_back({name, signal.size()});
            values_.insert(values_.end(), signal.begin(), signal.end());
        }
    };
    add_signal("sensor", input.get<features::SensorSamples>().samples);
    add_signal("te", input.get<features::TeTurn>().turn);
    add_signal("tooth_rms", input.get<features::ToothRms<features::Gear::planet>>().rms);
    if (request_->levels.size() == 1) {
        request_->records.push_back({kind, properties(scene_, inputs), std::move(arrays)});
    }
}

void PythonFeatures::add(double noise_level, const InstanceInputs& inputs,
                         const features::FeatureInput& input) {
    if (!request_) {
        request_ = std::make_shared<Request>();
        values_.clear();
    }
    request_->levels.push_back(noise_level);
    add_record("record", inputs, input);
    for (int k = 0; input.baseline != nullptr && k < input.baselines; ++k) {
        add_record("baselines", inputs, input.baseline[k]);
    }
    if (input.change != nullptr) {
        add_record("change", inputs, *input.change);
    }
}

std::vector<double> PythonFeatures::compute(const std::string& work) {
    const auto request = std::exchange(request_, nullptr);
    PythonWorker& worker = PythonWorker::of_thread();
    nlohmann::json functions = nlohmann::json::array();
    for (const PythonFeature& one : used_) {
        worker.require(one.file, one.hashes);
        functions.push_back({one.file, std::string(one.feature->name)});
    }
    nlohmann::json reply;
    std::vector<double> values = worker.ask(
        {{"features", functions}, {"levels", request->levels}, {"records", request->records}},
        values_, work, reply);
    problems_.clear();
    for (const auto& error : reply.at("errors")) {
        problems_.push_back({error.at(0), error.at(1), error.at(2), error.at(3)});
    }
    values.resize(used_.size() * request->levels.size(), std::numeric_limits<double>::quiet_NaN());
    return values;
}

void print_python_problems(const std::vector<PythonProblem>& problems, const std::string& work) {
    static std::mutex mutex;
    static std::set<std::string> printed;
    const std::lock_guard lock(mutex);
    for (const PythonProblem& one : problems) {
        if (printed.insert(one.place + one.feature).second) {
            fmt::print(stderr,
                       "{}: {} ({}, {}, noise x {:g}): it has no value there; further cases at "
                       "this line are only counted\n",
                       one.place, printable(one.what), one.feature, work, one.noise_level);
        }
    }
}

}  // namespace gearpod::mc
