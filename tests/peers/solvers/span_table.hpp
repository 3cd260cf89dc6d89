// What a gearbox costs over the whole span, each way at the loosest tolerance that keeps the error.
#pragma once

#include <functional>

#include "mc/numerics/reference.hpp"
#include "own_march.hpp"
#include "tolerance_search.hpp"

namespace gearpod::peers {

class SpanTable {
  public:
    SpanTable(const Options& options, OwnMarch& own, const mc::Pilot& pilot,
              const mc::Reference& reference);

    // Finds the tolerances of all solvers, saying so on stderr.
    void add_all();
    void round();
    void print() const;
    // As `gearpod accuracy --peers` reads it.
    void write(const std::string& path) const;

  private:
    using Way = std::function<PeerRun(const Task&, const Extent&, double tolerance)>;
    std::optional<Attempt> attempt(const std::string& name, const Way& way, double tolerance) const;
    void add_fixed(const std::string& name, Way way);
    void add_adaptive(const std::string& name, Way way);
    std::string line(const Row& row) const;

    const Options& options_;
    OwnMarch& own_;
    const mc::Pilot& pilot_;
    const mc::Reference& reference_;
    const mc::ResolvedStudy resolved_;
    const mc::Scene chosen_;  // for the error allowed
    double span_ = 0.0;       // mesh periods
    std::vector<Row> rows_;
    std::vector<Way> ways_;  // of the rows but the first two
};

}  // namespace gearpod::peers
