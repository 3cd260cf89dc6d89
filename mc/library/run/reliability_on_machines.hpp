// Detection statistics in messages between ranks (messages.hpp), and their computation on all
// machines of a run.
#pragma once

#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "analysis/reliability.hpp"
#include "mc/ensemble/messages.hpp"
#include "mc/ensemble/ranks.hpp"
#include "mc/results/reliability_of_results.hpp"
#include "mc/results/result_rows.hpp"

namespace Eigen {

template <class Archive, class Scalar, int rows, int columns>
void serialize(Archive& archive, Matrix<Scalar, rows, columns>& matrix) {
    Index height = matrix.rows(), width = matrix.cols();
    archive(height, width);
    matrix.resize(height, width);
    archive(cereal::binary_data(matrix.data(),
                                static_cast<std::size_t>(matrix.size()) * sizeof(Scalar)));
}

}  // namespace Eigen

namespace gearpod::analysis {

using gearpod::serialize;

// Only inspections have fits by maximum likelihood and calibrated bounds, and no rank sends them.
template <class Archive, class Statistics>
void serialize(Archive&, std::shared_ptr<const Statistics>& statistics) {
    if (statistics) {
        throw std::logic_error("statistics of inspections cannot be sent to another rank");
    }
}

}  // namespace gearpod::analysis

namespace gearpod::mc {

// Assesses the features of a run on all its machines. The first rank of each machine evaluates a
// share of the pairs of a feature and a noise level, on the processors of the machine's ranks,
// which are idle after the last batch.

// Called by rank 0 while the other ranks are in assess_for_leader(). Result and errors as in
// reliability_of(), whatever the number of machines. A share that another machine could not
// evaluate is evaluated here.
std::optional<analysis::Reliability> reliability_on_machines(const Results& frame,
                                                             const RowSource& rows,
                                                             const Ranks& ranks, int threads);

// Evaluates shares until rank 0 broadcasts something else (Ranks::from_leader), and returns that.
std::string assess_for_leader(const EnsemblePlan& plan, const Ranks& ranks);

// Threads of all ranks on this machine, or its processors if there are fewer.
int threads_of_machine(const EnsemblePlan& plan, const Ranks& ranks);

}  // namespace gearpod::mc
