// Cost of a step of the classical Runge-Kutta method, by gearpod and by Boost.odeint, on the same
// grid, as a share of this core's peak of fused multiply-adds.
#pragma once

#include <functional>
#include <map>

#include "gearpod_solver.hpp"
#include "mc/numerics/pilot.hpp"
#include "tests/bench/peaks.hpp"

namespace gearpod::peers {

class StepTable {
  public:
    StepTable(GearpodSolver& own, const mc::Reference& reference);

    void measure_errors();
    void round();
    // Prints the least time of a step at the peak.
    void print_limit() const;
    // Adds its table and ratios to a part of performance.json (tests/bench/README.md).
    void add_to(nlohmann::ordered_json& part) const;

  private:
    using Way = std::function<PeerRun(const Task&, const Extent&)>;
    // Operations of a step, and the registers used by its code.
    struct Work {
        double flop = 0.0;
        bench::Width width = bench::Width::bits_512;
        bool no_sensor = false;
    };
    void add(const std::string& name, Work work, Way way);
    double peak(bench::Width width) const;  // fused multiply-adds per second
    double share(std::size_t row) const;    // of the peak

    GearpodSolver& own_;
    const mc::Reference& reference_;
    std::vector<Row> rows_;
    std::vector<Work> work_;  // for the rows
    std::vector<Way> ways_;   // for the rows except the first
    std::map<bench::Width, std::vector<double>> peaks_;
};

}  // namespace gearpod::peers
