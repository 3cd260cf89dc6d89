// Study that is read once, with its plans, for programs that link the library.
#pragma once

#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "mc/ensemble/gearbox/simulation.hpp"
#include "mc/plan/description.hpp"
#include "mc/plan/ensemble_plan.hpp"
#include "mc/plan/gearbox_plan.hpp"

namespace gearpod::mc {

// Thread-safe.
class OpenStudy {
  public:
    // Study file `name`, or the TOML text, which messages then call `name`; overrides are those of
    // read_study(). Without `with_lines` messages have no line numbers. Throws BadInput
    // (mc/files/input/problems.hpp) with every problem.
    explicit OpenStudy(const std::string& name,
                       const std::optional<std::string>& text = std::nullopt,
                       const std::vector<std::string>& overrides = {}, bool with_lines = true);

    struct Plans {
        TilePlan tile;
        EnsemblePlan ensemble;
        std::function<std::vector<DescriptionSection>()> describe;
    };
    // Made by the first call. Throws BadInput with every problem.
    const Plans& plans();
    // Texts on gearbox and effects, as `describe` has them. Throws BadInput.
    std::vector<DescriptionSection> description();
    // Plan of the vibration modes, which a study without teeth has, too. Throws BadInput.
    ModalPlan modes() const { return modes_(); }
    // Text of accepted statements that should be written in another way; may be empty.
    const std::string& notices() const { return notices_; }

  private:
    std::string notices_;
    std::function<ModalPlan()> modes_;
    std::function<Plans()> make_plans_;
    std::mutex making_;
    std::optional<Plans> plans_;
};

// Simulates the gearbox in a row of the results of a study.

// The first `meshes` mesh periods of the gearbox; 0: one planet turn. Throws BadInput
// (mc/files/input/problems.hpp) if there is no such row or too many mesh periods are requested, and
// std::runtime_error if the gearbox fails.
Simulation simulate_row(const TilePlan& tile, const EnsemblePlan& ensemble, long row,
                        long meshes = 0);

}  // namespace gearpod::mc
