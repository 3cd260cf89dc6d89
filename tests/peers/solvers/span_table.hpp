// Cost of a realization over the whole span, for each solver at the loosest tolerance that meets
// the error.
#pragma once

#include <functional>
#include <optional>

#include "gearpod_solver.hpp"
#include "mc/numerics/pilot.hpp"

namespace gearpod::peers {

// Result at one tolerance.
struct Attempt {
    double tolerance = 0.0;
    double steps = 0.0;  // per mesh period
    mc::PilotError error;
    bool within = false;  // meets the requested error
};

class SpanTable {
  public:
    SpanTable(const Options& options, GearpodSolver& own, const mc::Pilot& pilot,
              const mc::Reference& reference);

    // Finds the tolerances of all solvers and prints progress to stderr.
    void add_all();
    void round();
    // Adds its table and ratios to a part of performance.json (tests/bench/README.md).
    void add_to(nlohmann::ordered_json& part) const;
    // Writes the file that `gearpod accuracy --peers` reads.
    void write(const std::string& path) const;

  private:
    using Way = std::function<PeerRun(const Task&, const Extent&, double tolerance)>;
    std::optional<Attempt> attempt(const std::string& name, const Way& way, double tolerance) const;
    void add_fixed(const std::string& name, Way way);
    void add_adaptive(const std::string& name, Way way);

    const Options& options_;
    GearpodSolver& own_;
    const mc::Pilot& pilot_;
    const mc::Reference& reference_;
    const ResolvedStudy resolved_;  // for the allowed error
    double span_ = 0.0;             // mesh periods
    std::vector<Row> rows_;
    std::vector<Way> ways_;  // of the rows except the first two
};

}  // namespace gearpod::peers
