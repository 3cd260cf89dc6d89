// Length of a record, and conditions under which records can be superposed.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "mc/ensemble/gearbox/gearbox_tile.hpp"
#include "mc/plan/feature_needs.hpp"
#include "mc/plan/scene.hpp"

namespace gearpod::mc {

// Length of a record in planet turns.
struct RecordSpan {
    int turns = 0;  // whole planet turns in each recording
    // planet turns after which every tooth of a planet has met every ring tooth once
    int all_turns = 0;
    int recordings = 1;  // number of recordings averaged in a record

    // True if every recording consists of complete spans.
    bool whole() const { return turns % all_turns == 0; }
};

// Length of a record at this speed. Throws SceneError if recordings are too short.
RecordSpan record_span(const Scene& scene, double speed_rad_s);

// Description of the length of a record and of the tooth pairs in it, for example "26 turns of
// ...".
std::string record_text(const Scene& scene);

// Needs of features in lives. Unlike in compared_needs(), a change is superposed without the
// samples of the record and of the baseline.
ComparedNeeds superposed_needs(std::span<const features::Feature* const> features);

// All reasons why the study's records cannot be superposed; empty if they can.
std::vector<SceneError> superposition_problems(const Scene& scene);
// Throws the first of them.
void check_superposable(const Scene& scene);

// Superposition of signals. The signal of a record is a linear combination of the gearbox's signals
// at several crack depths and torques, and of the noise of earlier records. Its folded squares
// follow from folded products, without the samples.

class SuperposedSignals {
  public:
    // `basis`: sensor signals of equal length, which consist of whole turns of `bins` samples, and
    // averaged transmission errors of equal length, which may be empty. The samples must outlive
    // the object if add_turns() is used. Without `folds`, at() gives no folded squares.
    SuperposedSignals(std::span<const LaneSignals* const> basis, std::size_t bins, bool folds);

    // Linear combination with one coefficient per basis signal: folded squares and transmission
    // error, without samples.
    LaneSignals at(std::span<const double> coefficients) const;

    // Adds the folded squares of `turns` turns of a linear combination, computed from the samples.
    // The turns continue periodically after the last one.
    void add_turns(std::span<const double> coefficients, std::size_t first, std::size_t turns,
                   std::vector<double>& folded) const;

    // Appends the samples of such turns.
    void append_turns(std::span<const double> coefficients, std::size_t first, std::size_t turns,
                      std::vector<double>& samples) const;

  private:
    std::vector<double> turn(std::span<const double> coefficients, std::size_t number) const;

    std::vector<std::span<const double>> samples_;
    std::size_t bins_;
    std::size_t count_;
    std::vector<std::vector<double>> products_;  // folded products for k <= l, row by row
    std::vector<std::vector<double>> te_turns_;
};

}  // namespace gearpod::mc
