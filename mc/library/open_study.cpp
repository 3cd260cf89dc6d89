#include "mc/library/open_study.hpp"

#include <fmt/format.h>

#include "mc/ensemble/gearbox/solution_choice.hpp"
#include "mc/files/input/problems.hpp"
#include "mc/numerics/forecast/memory.hpp"
#include "mc/numerics/numerics_choice.hpp"
#include "mc/results/result_rows.hpp"

namespace gearpod::mc {

namespace {

std::string text_of(Problems problems, bool with_lines) {
    for (Problem& problem : problems) {
        problem.line = with_lines ? problem.line : 0;
    }
    const std::string text = format(problems);
    return text.substr(0, text.empty() ? 0 : text.size() - 1);
}

}  // namespace

OpenStudy::OpenStudy(const std::string& name, const std::optional<std::string>& text,
                     const std::vector<std::string>& overrides, bool with_lines) {
    StudyReading reading = text ? read_study_text(*text, name, overrides, PythonFiles::run)
                                : read_study(name, overrides);
    if (!reading.study) {
        throw BadInput(text_of(reading.problems, with_lines));
    }
    notices_ = text_of(reading.notices, with_lines);
    modes_ = [=, study = *reading.study] {
        try {
            return make_modal_plan(study);
        } catch (const SceneError& error) {
            throw BadInput(
                text_of({{name, 0, error.key(), error.what(), error.remedy()}}, with_lines));
        }
    };
    make_plans_ = [=, reading = std::move(reading)] {
        const StudyScene made = make_scene(name, reading);
        if (!made) {
            throw BadInput(text_of(made.problems, with_lines));
        }
        return Plans{made.scene->tile(), made.scene->ensemble(), [planner = *made.planner] {
                         return planner.description(planner.facts().numerics);
                     }};
    };
}

const OpenStudy::Plans& OpenStudy::plans() {
    const std::scoped_lock lock(making_);
    if (!plans_) {
        plans_ = make_plans_();
    }
    return *plans_;
}

std::vector<DescriptionSection> OpenStudy::description() {
    const Plans& made = plans();
    const std::scoped_lock lock(making_);  // a planner serves one thread
    return made.describe();
}

Simulation simulate_row(const TilePlan& tile, const EnsemblePlan& ensemble, long row, long meshes) {
    const auto rows = static_cast<long>(ensemble.batches().rows());
    const RecordPlan& record = tile.record;
    const long simulated = meshes > 0 ? meshes : record.span.planet_teeth;
    // A record of given length begins within the span.
    const int most = record.signal_meshes - (record.length ? record.span.meshes() : 0);
    std::string problems;
    if (row < 0 || row >= rows) {
        problems =
            fmt::format("--instance {}: must be a row of the results, 0 to {}", row, rows - 1);
    }
    if (simulated > most) {
        problems += fmt::format("{}--meshes {}: must be at most {}", problems.empty() ? "" : "\n",
                                simulated, most);
    }
    if (!problems.empty()) {
        throw BadInput(problems);
    }
    // Motion of all lanes, and the columns of one with their copy in the file.
    const auto lanes = static_cast<double>(tile.solve->settings.numerics.lanes);
    const lockstep::IntegrationPlan& plan = tile.solve->integration();
    const double columns =
        1.0 + dynamics::degrees_of_freedom(plan.layout) + static_cast<double>(plan.nodes.pairs);
    const double needed = motion_bytes(tile) + 8.0 * (lanes + 2.0) * columns * tile.record.samples *
                                                   static_cast<double>(simulated);
    if (const double at_hand = available_memory_bytes(); needed > at_hand) {
        throw BadInput(
            fmt::format("--meshes {}: the signals need at least {:.2g} GB of memory, but "
                        "only {:.2g} GB are available; give fewer, or a lower "
                        "sensor.sampling_Hz or a shorter sensor.record_turns",
                        simulated, 1e-9 * needed, 1e-9 * at_hand));
    }
    return simulate(tile, tile.draw().rows.id_of(row), simulated);
}

}  // namespace gearpod::mc
