#include "mc/numerics/scatter_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "lockstep/integrators/facts.hpp"
#include "mc/ensemble/batch_worker.hpp"
#include "mc/ensemble/rows_of_gearboxes.hpp"
#include "mc/numerics/numerical_error.hpp"

namespace gearpod::mc {
namespace {

constexpr std::uint64_t kHealthyPilots = 16;
constexpr int kMostTries = 6;  // of a limit of the mass scaling
// Half of normally distributed errors lie within this share of their root mean square.
constexpr double kHalf = 0.6745;

void check_free(const Study& study) {
    const auto refuse = [](const char* key, const std::string& what) {
        throw SceneError(key, what, "remove it, or numerics.scatter_tolerance");
    };
    const Numerics& n = study.numerics;
    if (study.effects.quasi_static()) {
        refuse("effects.motion", "a quasi-static gearbox has no time steps to be chosen");
    }
    if (n.integrator && !lockstep::facts(*n.integrator).scales_mass) {
        refuse("numerics.integrator",
               fmt::format("numerics.scatter_tolerance chooses steps of {}",
                           lockstep::names_of(&lockstep::IntegratorFacts::scales_mass)));
    }
    if ((n.steps_per_mesh > 0) != (n.mass_scaling_Hz > 0.0)) {
        refuse(n.steps_per_mesh > 0 ? "numerics.steps_per_mesh" : "numerics.mass_scaling_Hz",
               "is chosen by numerics.scatter_tolerance, unless both it and the other of "
               "steps_per_mesh and mass_scaling_Hz are given");
    }
    if (n.tolerance > 0.0) {
        refuse("numerics.tolerance", "chooses the steps, too");
    }
}

class ScatterChoice {
  public:
    explicit ScatterChoice(const Study& study)
        : study_(study), shape_(row_shape(study)), own_(own_study(study)) {
        for (std::uint64_t i = 0; i < kHealthyPilots; ++i) {
            ids_.push_back({Group::threshold, i});
        }
        reference_ = rows_of_gearboxes(own_, ids_);
        for (std::size_t at = 0; at < shape_.features * shape_.levels; ++at) {
            scatter_.push_back(standard_deviation(column(reference_, at)));
        }
    }

    NumericsChoice run() {
        NumericsChoice made;
        made.gearboxes = static_cast<int>(ids_.size());
        made.of_scatter = true;
        made.setting = {own_.study().numerics, {}};
        const auto keeps = [&](const Scene& scene) {
            const auto [error, feature] = error_of(scene);
            made.error = error;
            made.worst_feature = study_.features.use[feature];
            made.setting = {scene.study().numerics, {"mass_scaling_Hz"}};
            return error <= study_.numerics.scatter_tolerance;
        };
        if (study_.numerics.mass_scaling_Hz > 0.0) {
            Numerics given = study_.numerics;
            given.scatter_tolerance = 0.0;
            if (!keeps(own_.with(given))) {
                throw SceneError("numerics.scatter_tolerance",
                                 fmt::format("the steps given change {} by {:.2g} of its scatter",
                                             made.worst_feature, made.error),
                                 "remove steps_per_mesh and mass_scaling_Hz, so that they are "
                                 "chosen, or use a larger tolerance");
            }
            return made;
        }
        const NumericsChoice own = made;
        const int own_steps = steps_of(own_), samples = own_.samples_per_mesh();
        for (int a_sample = 1; a_sample * samples < own_steps; ++a_sample) {
            const auto numerics = scaled_numerics(own_, a_sample * samples);
            if (numerics && keeps(own_.with(*numerics))) {
                return made;
            }
        }
        made = own;
        return made;
    }

  private:
    static Study own_study(Study study) {
        study.numerics.integrator = lockstep::Integrator::central_difference;
        study.numerics.scatter_tolerance = study.numerics.mass_scaling_Hz = 0.0;
        study.numerics.steps_per_mesh = 0;
        return study;
    }

    static int steps_of(const Scene& scene) {
        return static_cast<int>(scene.plan().grid.steps.size());
    }

    std::vector<double> column(const BatchRows& rows, std::size_t at) const {
        std::vector<double> values;
        for (std::size_t row = 0; row < rows.count(); ++row) {
            values.push_back(rows.values[row * shape_.values() + shape_.parameters + at]);
        }
        return values;
    }

    // Largest error over all features and noise levels: the median over the gearboxes, as a root
    // mean square of normally distributed errors, over the scatter. Where a feature jumps, because
    // another tooth has the largest value, a few gearboxes do not decide.
    struct Error {
        double error = 0.0;
        std::size_t feature = 0;
    };
    Error error_of(const Scene& scene) const {
        const BatchRows rows = rows_of_gearboxes(scene, ids_);
        Error worst;
        for (std::size_t at = 0; at < scatter_.size(); ++at) {
            const std::vector<double> here = column(rows, at), there = column(reference_, at);
            std::vector<double> errors;
            for (std::size_t i = 0; i < here.size(); ++i) {
                if (std::isfinite(there[i])) {
                    errors.push_back(std::isfinite(here[i]) ? std::abs(here[i] - there[i])
                                                            : INFINITY);
                }
            }
            if (errors.empty() || !(scatter_[at] > 0.0)) {
                continue;
            }
            const auto middle = errors.begin() + static_cast<std::ptrdiff_t>(errors.size() / 2);
            std::ranges::nth_element(errors, middle);
            const double error = *middle / kHalf / scatter_[at];
            if (error > worst.error) {
                worst = {error, at / shape_.levels};
            }
        }
        return worst;
    }

    const Study& study_;
    const RowShape shape_;
    const Scene own_;
    std::vector<GearboxId> ids_;
    BatchRows reference_;
    std::vector<double> scatter_;  // by feature and noise level
};

double fastest_mode_Hz(const Scene& scene) {
    return dynamics::natural_frequencies_Hz(
               dynamics::assemble(scene.plan().layout, scene.inputs(nominal_inputs(scene.study())),
                                  scene.mean_pairs()))
        .back();
}

}  // namespace

std::optional<Numerics> scaled_numerics(const Scene& own, int steps) {
    Numerics numerics = own.study().numerics;
    numerics.steps_per_mesh = 0;
    double limit_Hz = fastest_mode_Hz(own);
    for (int i = 0; i < kMostTries && limit_Hz > own.study().sensor.low_pass_Hz + 1.0; ++i) {
        numerics.mass_scaling_Hz = limit_Hz;
        const double needed = 1.0 / own.with(numerics).longest_step();
        if (needed <= steps) {
            numerics.steps_per_mesh = steps;
            numerics.mass_scaling_Hz = std::floor(limit_Hz);
            return numerics;
        }
        limit_Hz *= 0.98 * steps / needed;
    }
    return std::nullopt;
}

NumericsChoice choose_by_scatter(const Study& study) {
    check_free(study);
    try {
        return ScatterChoice(study).run();
    } catch (const SceneError& error) {
        if (error.key() == "numerics.mass_scaling_Hz" && study.numerics.mass_scaling_Hz == 0.0) {
            throw SceneError("numerics.scatter_tolerance", error.what(), error.remedy());
        }
        throw;
    }
}

}  // namespace gearpod::mc
