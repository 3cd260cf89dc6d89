// Writes the pilot of `gearpod accuracy` as matrices for another solver, and evaluates that
// solver's response like a solver setting.
// Usage: solver_settings write STUDY > problem.json
// Usage: solver_settings grade STUDY name=signals.f64 ... > peers.csv
// README.md describes the files.
#include <fmt/format.h>

#include <cstdio>
#include <cstring>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "dynamics/gearbox_matrices.hpp"
#include "lockstep/plan/fault_schedule.hpp"
#include "lockstep/steps/graded_grid.hpp"
#include "mc/numerics/pilot.hpp"
#include "mc/study/schema/schema.hpp"

using namespace gearpod;
using nlohmann::json;

namespace {

// Number of equidistant stiffness values between two transitions.
constexpr int kNodes = 257;

mc::Study study_of(const std::string& path) {
    mc::StudyReading reading = mc::read_study(path);
    if (!reading.study) {
        throw std::runtime_error(mc::format(reading.problems));
    }
    return *reading.study;
}

// Plan with steps from transition to transition.
lockstep::IntegrationPlan table_plan(const mc::Study& study, const mc::Scene& scene) {
    lockstep::IntegrationPlan plan = scene.solve().integration();
    if (plan.mesh_law != dynamics::MeshLaw::linear) {
        throw std::runtime_error("only for studies without separation and transmission errors");
    }
    plan.grid = lockstep::make_phase_grid(1, 1, scene.gearbox().stiffness->transitions());
    plan.grid.stage_nodes.clear();
    for (int i = 0; i < kNodes; ++i) {
        plan.grid.stage_nodes.push_back(i / (kNodes - 1.0));
    }
    plan.nodes = lockstep::tabulate(scene.gearbox().pairs(), plan.grid, study.effects.mesh_damping);
    return plan;
}

json rows(const Eigen::MatrixXd& matrix) {
    json all = json::array();
    for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
        const Eigen::VectorXd row = matrix.row(i);
        all.push_back(std::vector<double>(row.begin(), row.end()));
    }
    return all;
}

std::vector<double> list(const Eigen::VectorXd& row) {
    return {row.begin(), row.end()};
}

// Matrices without the meshes, which are added as k v v^T and c v v^T.
json matrices(const lockstep::IntegrationPlan& plan, const dynamics::GearboxInputs& inputs) {
    const int pairs = dynamics::pairs(plan.layout);
    const dynamics::GearboxMatrices m = dynamics::assemble(
        plan.layout, inputs, std::vector<double>(static_cast<std::size_t>(pairs), 0.0));
    json all{{"mesh_period_s", dynamics::mesh_period_s(inputs)},
             {"frame_speed_rad_s", dynamics::frame_speed_rad_s(inputs)},
             {"mass", rows(m.mass)},
             {"damping", rows(m.damping + m.gyroscopic)},
             {"stiffness", rows(m.stiffness + m.centrifugal)},
             {"force", list(m.force)},
             {"rigid_rotation", list(dynamics::rigid_rotation(plan.layout))}};
    for (int pair = 0; pair < pairs; ++pair) {
        all["mesh_rows"].push_back(list(dynamics::mesh_row(plan.layout, PairId{pair})));
        all["mesh_damping"].push_back(
            dynamics::mesh_damping_factor(plan.layout, inputs, PairId{pair}));
    }
    for (int source = 0; source < dynamics::sources(plan.layout); ++source) {
        for (const int axis : {0, 1}) {
            all["source_rows"].push_back(list(dynamics::source_row(plan.layout, source, axis)));
        }
    }
    return all;
}

std::vector<double> lane_of(const machine::AlignedVector& values, std::size_t lane) {
    std::vector<double> own;
    for (std::size_t i = lane; i < values.size(); i += lockstep::kPilotLanes) {
        own.push_back(values[i]);
    }
    return own;
}

void write_problem(const mc::Study& study) {
    const mc::Scene scene(study);
    const lockstep::IntegrationPlan plan = table_plan(study, scene);
    json all{{"samples", scene.record().samples},
             {"meshes", scene.gearbox().fault().pattern().length},
             {"low_pass_rad_s", plan.low_pass_rad_s},
             {"te_weight", plan.te_weight},
             {"nodes", kNodes},
             {"pairs", plan.nodes.pairs},
             {"mesh_damping_law", mc::choice_text(study, "effects", "mesh_damping")},
             {"stiffness", plan.nodes.stiffness}};
    for (const lockstep::Step& step : plan.grid.steps) {
        all["transitions"].push_back(step.phase);
    }
    lockstep::FaultCurves faults{&scene.gearbox().pairs(), scene.gearbox().fault().pattern(), {}};
    faults.curve.resize(static_cast<std::size_t>(scene.gearbox().fault().curves()));
    for (const mc::GearboxId& id : mc::pilot_gearboxes()) {
        const mc::InstanceInputs instance = scene.sampler().draw(id).inputs;
        all["gearboxes"].push_back(matrices(plan, scene.gearbox().inputs(instance)));
        for (int c = 0; c < scene.gearbox().fault().curves(); ++c) {
            faults.curve[static_cast<std::size_t>(c)].push_back(
                scene.gearbox().fault().mesh(c, instance.fault_size));
        }
    }
    const lockstep::FaultSchedule schedule(plan, faults);
    for (int mesh = 0; mesh < scene.gearbox().fault().pattern().length; ++mesh) {
        for (const lockstep::PairOverride& o : schedule.overrides(mesh)) {
            for (std::size_t lane = 0; lane < lockstep::kPilotLanes; ++lane) {
                all["gearboxes"][lane]["passages"].push_back(
                    {{"mesh", mesh},
                     {"pair", int{o.pair}},
                     {"first", o.first_step},
                     {"stiffness", lane_of(o.stiffness, lane)}});
            }
        }
    }
    std::cout << all.dump() << "\n";
}

struct Signals {
    std::string name, command;
    double integration_s = 0.0, mesh_s = 0.0;
    lockstep::TileResult tile;
};

// Layout [gearbox][mesh][sample][channel.., te] after the seconds per gearbox and mesh period.
Signals read_signals(const mc::Scene& scene, const std::string& argument) {
    const std::size_t equals = argument.find('=');
    if (equals == std::string::npos) {
        throw std::runtime_error(argument + ": name=signals.f64 expected");
    }
    Signals signals;
    signals.name = argument.substr(0, equals);
    const std::string path = argument.substr(equals + 1);
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    const auto meshes = static_cast<std::size_t>(scene.gearbox().fault().pattern().length);
    const std::size_t samples = scene.solve().integration().samples();
    const auto channels = static_cast<std::size_t>(scene.solve().integration().channels());
    constexpr std::size_t kLanes = lockstep::kPilotLanes;
    const std::size_t count = 2 + kLanes * meshes * samples * (channels + 1);
    if (bytes.size() != count * sizeof(double)) {
        throw std::runtime_error(fmt::format("{}: has {} bytes, {} expected", path, bytes.size(),
                                             count * sizeof(double)));
    }
    std::vector<double> values(count);
    std::memcpy(values.data(), bytes.data(), bytes.size());
    signals.integration_s = values[0];
    signals.mesh_s = values[1];
    const double* value = values.data() + 2;
    for (std::size_t k = 0; k < meshes; ++k) {
        signals.tile.content.push_back(static_cast<int>(k));
        signals.tile.records.push_back(
            lockstep::make_record(scene.solve().integration(), static_cast<int>(kLanes), false));
    }
    signals.tile.status.assign(kLanes, lockstep::LaneStatus::ok);
    for (std::size_t lane = 0; lane < kLanes; ++lane) {
        for (lockstep::MeshRecord& record : signals.tile.records) {
            for (std::size_t p = 0; p < samples; ++p) {
                for (std::size_t c = 0; c < channels; ++c) {
                    record.acceleration[(p * channels + c) * kLanes + lane] = *value++;
                }
                record.te[p * kLanes + lane] = *value++;
            }
        }
    }
    return signals;
}

void grade(const mc::Study& study, const std::vector<std::string>& arguments) {
    const mc::Scene scene(study);
    const mc::Pilot pilot{mc::Planner(study)};
    const mc::Reference reference = mc::converged_reference(pilot, study.numerics, {});
    fmt::print("name,command,integration_s,mesh_s,sensor,te,{}\n",
               fmt::join(study.features.use, ","));
    for (const std::string& argument : arguments) {
        const Signals signals = read_signals(scene, argument);
        const mc::PilotRecord record =
            pilot.record_of_integration([&](auto) { return signals.tile; });
        const mc::PilotError error = mc::pilot_error(record, reference.record);
        fmt::print("\"{}\",see tests/peers/solver-settings/README.md,{:.4g},{:.4g},{:.3g},{:.3g}",
                   signals.name, signals.integration_s, signals.mesh_s, error.sensor, error.te);
        for (int f = 0; f < record.features_used; ++f) {
            fmt::print(",{:.3g}", error.feature(f, record.levels));
        }
        fmt::print("\n");
    }
}

}  // namespace

int main(int argc, char** argv) {
    const std::vector<std::string> arguments(argv + 1, argv + argc);
    const bool writes = arguments.size() == 2 && arguments[0] == "write";
    if (!writes && (arguments.size() < 3 || arguments[0] != "grade")) {
        std::fputs("solver_settings write STUDY | grade STUDY name=signals.f64 ...\n", stderr);
        return 2;
    }
    try {
        const mc::Study study = study_of(arguments[1]);
        if (writes) {
            write_problem(study);
        } else {
            grade(study, {arguments.begin() + 2, arguments.end()});
        }
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 2;
    }
    return 0;
}
